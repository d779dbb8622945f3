#include "baselines/external/external_meshlab.h"

#include <fmt/format.h>

#include "baselines/external/external_tool.h"
#include "baselines/meshlab.h"
#include "smopt/io/file.h"
#include "smopt/io/mesh_io.h"
#include "smopt/io/scratch_folder.h"

namespace smopt::baselines {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "external:meshlab";
constexpr const char* kHowToGet = "Debian: apt install meshlab xvfb xauth";

std::string filter_script(int rounds, bool has_cotangent_weights) {
  return fmt::format(R"(<!DOCTYPE FilterScript>
<FilterScript>
 <filter name="Laplacian Smooth">
  <Param type="RichInt" name="stepSmoothNum" value="{}"/>
  <Param type="RichBool" name="Boundary" value="true"/>
  <Param type="RichBool" name="cotangentWeight" value="{}"/>
  <Param type="RichBool" name="Selected" value="false"/>
 </filter>
</FilterScript>
)",
                     rounds, has_cotangent_weights);
}

/// What lets it run without a screen, in any language, and leaves the user's own settings and folders alone.
ProcessSurroundings surroundings_in(const ScratchFolder& folder) {
  const std::string here = (folder / "").string();
  return {{{"LIBGL_ALWAYS_SOFTWARE", "1"},
           {"QT_QPA_PLATFORM", "xcb"},
           {"LC_ALL", "C"},
           {"TMPDIR", here},
           {"XDG_RUNTIME_DIR", here},
           {"XDG_CONFIG_HOME", here}},
          here};
}

MethodReport run_external_meshlab(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  const ProcessLimits limits = limits_of(values);
  const int rounds = values.integer("rounds", 0);
  const std::string script = filter_script(rounds, values.text("weights") == "cotangent");
  const fs::path server = require_program(kName, "meshlabserver", kHowToGet);
  const fs::path screen = require_program(kName, "xvfb-run", kHowToGet);
  require_program(kName, "xauth", kHowToGet);

  const ScratchFolder folder("meshlab");
  const fs::path in = folder / "in.ply", out = folder / "out.ply", filter = folder / "filter.mlx";
  write_mesh(in, mesh);
  write_file(filter, script);
  return run_tool({kName,
                   {screen.string(), "-a", server.string(), "-i", in.string(), "-o", out.string(), "-s", filter.string()},
                   limits,
                   surroundings_in(folder),
                   out,
                   read_mesh,
                   rounds},
                  mesh, progress);
}

}  // namespace

Method external_meshlab_method() {
  using Kind = MethodOption::Kind;
  return {kName,
          "MeshLab's own Laplacian Smooth, by meshlabserver where it is installed",
          "MeshLab (Cignoni et al., Eurographics Italian Chapter Conference, 2008); Debian 12 has 2020.09",
          CavityPolicy::keep,
          with_limit_options({{"rounds", Kind::integer, fmt::format("{}", MeshlabOptions().rounds), "", "its stepSmoothNum", {}},
                              {"weights", Kind::choice, "cotangent", "", "its cotangentWeight", {"cotangent", "uniform"}}}),
          run_external_meshlab,
          "needs meshlabserver, xvfb-run and xauth (Debian: apt install meshlab xvfb xauth); positions are rounded to float32, in which "
          "MeshLab computes, on the way in"};
}

}  // namespace smopt::baselines
