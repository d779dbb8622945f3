#include "experiments/surface_stage.h"

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include "experiments/generate_run.h"
#include "experiments/machine.h"
#include "smopt/error.h"
#include "smopt/io/molecule.h"
#include "smopt/io/sha256.h"
#include "smopt/peak_memory.h"

namespace smopt::experiments {
namespace {

void require_file(const Dataset& dataset) {
  if (std::filesystem::exists(dataset.path)) return;
  const std::string hint = dataset.package.empty() ? "" : fmt::format("; the Debian package {} brings it", dataset.package);
  throw InvalidInput(fmt::format("{}: no such file{}", dataset.path.string(), hint));
}

StageTimes generate_once(const Dataset& dataset, GeneratedSurface& surface, const ProgressCallback& progress) {
  StageTimes times;
  surface.molecule = timed(times, "read", [&] {
    Molecule read = read_molecule(dataset.path);
    raise_radii(read, GenerateRun().min_radius);  // as `smopt generate` does
    return read;
  });
  surface.mesh = timed(times, "generate", [&] { return gaussian_surface(surface.molecule, dataset.surface, &surface.report, progress); });
  return times;
}

}  // namespace

GeneratedSurface generate_surface(const Dataset& dataset, int repeats, const ProgressCallback& progress) {
  require_file(dataset);
  GeneratedSurface surface;
  surface.molecule_sha256 = sha256_of_file(dataset.path);
  reset_peak_memory();
  tbb::task_arena one_thread(1);
  for (int i = 0; i < repeats; ++i)
    surface.repeats.push_back(one_thread.execute([&] { return generate_once(dataset, surface, progress); }));
  surface.peak_memory_mb = peak_memory_mb();
  return surface;
}

}  // namespace smopt::experiments
