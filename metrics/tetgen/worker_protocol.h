#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "metrics/tetgen/tet_mesh.h"
#include "smopt/mesh/triangle_mesh.h"

/// What the program and its TetGen worker say to each other: two binary files in a folder of their own, in the machine's byte order, since
/// both ends are the same build on the same machine.
namespace smopt::metrics::worker {

struct Task {
  std::string switches;  ///< as TetGen takes them
  TriangleMesh surface;
};

/// How far the worker got.
struct Answer {
  /// TetGen's exit code: 0 done, otherwise the argument of terminatetetgen(). Empty: the worker was still at work when it wrote this.
  std::optional<int> code;
  std::string tetgen_version;  ///< of the library that is loaded
  double peak_memory_mb = 0;   ///< resident, of the worker alone
  TetMesh mesh;                ///< when code is 0
};

/// The bytes of a task or an answer, and back.
/// \throws InvalidInput when the bytes are not those of a whole one.
std::string encode(const Task& task);
std::string encode(const Answer& answer);
Task decode_task(const std::string& bytes);
Answer decode_answer(const std::string& bytes);

/// Plain reading and writing of a file (no gzip, no renaming: the folder is ours).
/// \throws InvalidInput when that fails.
std::string read_bytes(const std::filesystem::path& path);
void write_bytes(const std::filesystem::path& path, const std::string& bytes);

}  // namespace smopt::metrics::worker
