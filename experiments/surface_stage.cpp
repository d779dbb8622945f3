#include "experiments/surface_stage.h"

#include <fmt/format.h>

#include "experiments/generate_run.h"
#include "smopt/error.h"
#include "smopt/surface/gaussian_surface.h"

namespace smopt::experiments {
namespace {

void require_file(const Dataset& dataset) {
  if (std::filesystem::exists(dataset.path)) return;
  const std::string hint = dataset.package.empty() ? "" : fmt::format("; the Debian package {} brings it", dataset.package);
  throw InvalidInput(fmt::format("{}: no such file{}", dataset.path.string(), hint));
}

}  // namespace

GeneratedSurface generate_surface(const Dataset& dataset, const ProgressCallback& progress) {
  require_file(dataset);
  GeneratedSurface surface;
  surface.molecule = read_molecule(dataset.path);
  raise_radii(surface.molecule, GenerateRun().min_radius);
  surface.mesh = gaussian_surface(surface.molecule, dataset.surface, nullptr, progress);
  return surface;
}

}  // namespace smopt::experiments
