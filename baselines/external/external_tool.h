#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "smopt/improve/method.h"
#include "smopt/io/child_process.h"
#include "smopt/io/mesh_io.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::baselines {

/// The first executable file of this name in the folders of PATH.
std::optional<std::filesystem::path> find_program(std::string_view name);

/// \throws NotInstalled "`method`: `name` is not installed (`how_to_get`)" when there is none.
std::filesystem::path require_program(std::string_view method, std::string_view name, std::string_view how_to_get);

/// `options`, and after them those that every external tool has: `time-limit` and `memory-limit`.
std::vector<MethodOption> with_limit_options(std::vector<MethodOption> options);
/// Their values. \throws InvalidOption.
ProcessLimits limits_of(const OptionValues& values);

/// One run of an external tool.
struct ToolRun {
  std::string method;                ///< as messages name it
  std::vector<std::string> command;  ///< the program's file and its arguments
  ProcessLimits limits;
  ProcessSurroundings surroundings;
  std::filesystem::path result;                                                ///< the file in which the tool leaves the mesh
  std::function<TriangleMesh(const std::filesystem::path&)> read = read_mesh;  ///< reads it
  int rounds = 0;                                                              ///< that it was asked for; 0 where it has none
};

/// Runs the tool and puts its mesh, whatever its number of vertices, in the place of `mesh`; the files it reads are the caller's business.
/// \return `seconds.smoothing` is the tool's: wall, and processor by wait4, its start, its reading and its writing included.
/// `stopped_because` is "done", or "diverged" where the result is out of the bounds of `DivergenceWatch`: at which step nobody can say.
/// \throws MethodFailed with the reason: exit status or signal with the last line of output, out of time, no mesh; `mesh` is then as it was.
/// \throws Cancelled. Everything the tool started is gone in any case.
MethodReport run_tool(const ToolRun& run, TriangleMesh& mesh, const ProgressCallback& progress);

}  // namespace smopt::baselines
