#include "baselines/external/external_mmgs.h"

#include <fmt/format.h>

#include "baselines/external/external_tool.h"
#include "baselines/external/medit_mesh.h"
#include "smopt/error.h"
#include "smopt/io/file.h"
#include "smopt/io/scratch_folder.h"

namespace smopt::baselines {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "external:mmgs";
constexpr const char* kHowToGet = "from https://www.mmgtools.org";

/// Options that are handed on as `-name value`; 0 leaves MMG its own default.
constexpr const char* kLengths[] = {"hausd", "hmin", "hmax", "hsiz"};

constexpr const char* kNoGradation = "-1";  ///< MMG's value of -hgrad for none

fs::path require_mmgs() {
  const std::optional<fs::path> optimised = find_program("mmgs_O3");
  return optimised ? *optimised : require_program(kName, "mmgs", kHowToGet);
}

std::vector<std::string> arguments_of(const OptionValues& values) {
  std::vector<std::string> arguments;
  for (const std::string name : kLengths)
    if (values.number(name, 0) > 0) arguments.insert(arguments.end(), {"-" + name, values.text(name)});
  const bool has_gradation = values.number("hgrad", 0) > 0;
  arguments.insert(arguments.end(), {"-hgrad", has_gradation ? values.text("hgrad") : kNoGradation});
  const bool has_ridges = values.number("ridge-angle", 0) > 0;
  if (has_ridges) arguments.insert(arguments.end(), {"-ar", values.text("ridge-angle")});
  if (!has_ridges) arguments.emplace_back("-nr");
  return arguments;
}

MethodReport run_mmgs(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  const ProcessLimits limits = limits_of(values);
  const std::vector<std::string> arguments = arguments_of(values);
  std::vector<std::string> command = {require_mmgs().string()};

  const ScratchFolder folder("mmgs");
  const fs::path in = folder / "in.mesh", out = folder / "out.mesh";
  write_file(in, format_medit(mesh));
  command.insert(command.end(), {"-in", in.string(), "-out", out.string()});
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run_tool({kName, command, limits, {{}, folder / ""}, out, read_medit}, mesh, progress);
}

}  // namespace

Method external_mmgs_method() {
  using Kind = MethodOption::Kind;
  return {
      kName,
      "MMG's remeshing of surfaces, by mmgs where it is installed",
      "Dapogny, Dobrzynski & Frey, J. Comput. Phys. 262:358, 2014; MMG 5",
      CavityPolicy::keep,
      with_limit_options({{"hausd", Kind::number, "0", "Å", "largest distance to the input surface; 0: MMG's own, 0.01", {}},
                          {"hmin", Kind::number, "0", "Å", "shortest edge; 0: MMG's own", {}},
                          {"hmax", Kind::number, "0", "Å", "longest edge; 0: MMG's own", {}},
                          {"hsiz", Kind::number, "0", "Å", "constant edge length; 0: none", {}},
                          {"hgrad", Kind::number, "1.3", "", "largest ratio of the lengths of neighbouring edges; 0: any", {}},
                          {"ridge-angle", Kind::number, "45", "degrees", "sharper edges are kept as ridges; 0: none are looked for", {}}}),
      run_mmgs,
      "needs mmgs_O3 or mmgs, which Debian 12 does not have; only its remeshing, neither level sets nor size maps"};
}

}  // namespace smopt::baselines
