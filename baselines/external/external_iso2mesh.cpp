#include "baselines/external/external_iso2mesh.h"

#include <fmt/format.h>

#include <cstdlib>

#include "baselines/external/external_tool.h"
#include "smopt/error.h"
#include "smopt/io/file.h"
#include "smopt/io/scratch_folder.h"
#include "smopt/io/text_writer.h"

namespace smopt::baselines {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "external:iso2mesh";
constexpr const char* kVariable = "ISO2MESH";

/// Reads in.txt and writes out.off in its working directory.
constexpr std::string_view kOctaveProgram = R"(
args = argv();
addpath(args{1});
[smoother, rounds, alpha, keep_ratio] = deal(args{2}, str2double(args{3}), str2double(args{4}), str2double(args{5}));
in = fopen('in.txt', 'r');
counts = fscanf(in, '%d', 2);
node = fscanf(in, '%lf', [3, counts(1)])';
elem = fscanf(in, '%d', [3, counts(2)])';
fclose(in);
if (keep_ratio < 1)
  [node, elem] = meshresample(node, elem, keep_ratio);
end
node = smoothsurf(node, [], meshconn(elem, size(node, 1)), rounds, alpha, smoother);
out = fopen('out.off', 'w');
fprintf(out, 'OFF\n%d %d 0\n', size(node, 1), size(elem, 1));
fprintf(out, '%.17g %.17g %.17g\n', node');
fprintf(out, '3 %d %d %d\n', elem' - 1);
fclose(out);
)";

fs::path require_iso2mesh(const std::string& given) {
  const char* variable = std::getenv(kVariable);
  const std::string folder = !given.empty() || variable == nullptr ? given : variable;
  if (folder.empty())
    throw NotInstalled(fmt::format(
        "{}: say where ISO2mesh is, by --iso2mesh DIR or the environment variable {} (from https://iso2mesh.sf.net)", kName, kVariable));
  std::error_code ignored;
  if (!fs::exists(fs::path(folder) / "smoothsurf.m", ignored))
    throw NotInstalled(fmt::format("{}: there is no smoothsurf.m in {}: no folder of ISO2mesh", kName, folder));
  return fs::absolute(folder);
}

/// The numbers of vertices and triangles, the positions, and the triangles counted from 1.
std::string format_for_octave(const TriangleMesh& mesh) {
  TextWriter out;
  out.integer(mesh.vertex_count()).text(" ").integer(mesh.triangle_count()).text("\n");
  for (const Vec3& p : mesh.points) out.point(p).text("\n");
  for (const auto& [a, b, c] : mesh.triangles)
    out.integer(std::uint64_t{a} + 1).text(" ").integer(std::uint64_t{b} + 1).text(" ").integer(std::uint64_t{c} + 1).text("\n");
  return out.take();
}

double keep_ratio_of(const OptionValues& values) {
  const double ratio = values.number("keep-ratio", 0);
  if (ratio == 0 || ratio > 1) throw InvalidOption("--keep-ratio: expected a number above 0, and at most 1");
  return ratio;
}

MethodReport run_external_iso2mesh(TriangleMesh& mesh, const OptionValues& values, const ProgressCallback& progress) {
  const ProcessLimits limits = limits_of(values);
  const std::vector<std::string> settings = {values.text("smoother"), fmt::format("{}", values.integer("rounds", 0)),
                                             fmt::format("{}", values.number("alpha", 0)), fmt::format("{}", keep_ratio_of(values))};
  const fs::path octave = require_program(kName, "octave-cli", "Debian: apt install octave");
  const fs::path iso2mesh = require_iso2mesh(values.text("iso2mesh"));

  const ScratchFolder folder("iso2mesh");
  const fs::path program = folder / "run_smoothsurf.m";
  write_file(program, kOctaveProgram);
  write_file(folder / "in.txt", format_for_octave(mesh));
  std::vector<std::string> command = {octave.string(), "--no-gui", "--no-history", "--no-init-file", program.string(), iso2mesh.string()};
  command.insert(command.end(), settings.begin(), settings.end());
  const std::string here = (folder / "").string();
  return run_tool(
      {kName, command, limits, {{{"LC_ALL", "C"}, {"TMPDIR", here}}, here}, folder / "out.off", read_mesh, values.integer("rounds", 0)},
      mesh, progress);
}

}  // namespace

Method external_iso2mesh_method() {
  using Kind = MethodOption::Kind;
  return {
      kName,
      "ISO2mesh's own meshresample and smoothsurf, by GNU Octave, from a folder of yours",
      "Fang & Boas, Proc. IEEE ISBI 2009, 1142",
      CavityPolicy::keep,
      with_limit_options({{"iso2mesh", Kind::text, "", "", "folder of ISO2mesh; empty: the environment variable ISO2MESH", {}},
                          {"smoother", Kind::choice, "laplacian", "", "smoothsurf's method", {"laplacian", "lowpass", "laplacianhc"}},
                          {"rounds", Kind::integer, "100", "", "smoothsurf's iterations", {}},
                          {"alpha", Kind::number, "0.5", "", "smoothsurf's alpha", {}},
                          {"keep-ratio", Kind::number, "1", "", "meshresample's: part of the edges that is left; 1: it is not run", {}}}),
      run_external_iso2mesh,
      "needs octave-cli (Debian: apt install octave) and a folder of ISO2mesh, by --iso2mesh or the environment variable ISO2MESH; "
      "meshresample starts ISO2mesh's own program cgalsimp2, which rounds to 6 digits"};
}

}  // namespace smopt::baselines
