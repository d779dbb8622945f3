#include "experiments/convergence/molecule_study.h"

#include <fmt/format.h>

#include "smopt/io/molecule.h"
#include "smopt/io/small_radii.h"
#include "smopt/surface/adaptive_surface.h"

namespace smopt::experiments {
namespace {

/// Spacings of the uniform grids, in units of the default one: what Richardson's extrapolation needs.
constexpr double kSpacings[] = {1, 0.5, 0.25};

/// In the same units: below it the grids serve the extrapolation only, and have millions of vertices.
constexpr double kLeastSpacingWithDistances = 0.5;

class Study {
 public:
  Study(const Molecule& molecule, MoleculeStudy& study, const StudyLog& log)
      : molecule_(molecule), surface_(study.dataset.surface), field_(molecule, gaussian_field_options(surface_)), study_(study), log_(log) {}

  void add_adaptive(const std::vector<double>& errors) {
    std::optional<AdaptiveMesh> coarser;
    for (const double error : errors) {
      AdaptiveMesh finer = mesh_for(error);
      study_.adaptive.push_back(row_of(finer));
      if (coarser) study_.steps.push_back({coarser->error, error, explained_changes(field_, surface_.isovalue, *coarser, finer)});
      coarser = std::move(finer);
    }
  }

  void add_uniform() {
    for (const double factor : kSpacings) {
      GaussianSurfaceOptions options = surface_;
      options.spacing *= factor;
      const TriangleMesh mesh = gaussian_surface(molecule_, options);
      UniformRow row{options.spacing, summarise(mesh), {}};
      if (factor >= kLeastSpacingWithDistances) row.nearness = nearness_of(mesh, field_, surface_.isovalue, options.spacing);
      tell(fmt::format("uniform grid, {} Å", options.spacing), row.surface);
      study_.uniform.push_back(std::move(row));
    }
  }

  void add_limits() {
    study_.area = limit_of([](const SurfaceSummary& surface) { return surface.all.area; });
    study_.volume = limit_of([](const SurfaceSummary& surface) { return surface.all.volume; });
    study_.main_area = limit_of([](const SurfaceSummary& surface) { return surface.main.area; });
    study_.main_volume = limit_of([](const SurfaceSummary& surface) { return surface.main.volume; });
  }

  void add_published() {
    for (const PublishedMesh& mesh : published_figures().meshes) {
      if (mesh.molecule == study_.dataset.name) study_.published.push_back({mesh, row_of(mesh_for(mesh.our_error))});
    }
  }

 private:
  [[nodiscard]] AdaptiveMesh mesh_for(double error) const {
    AdaptiveMesh mesh;
    mesh.error = error;
    mesh.partition = partition_space(field_, surface_.isovalue, error);
    AdaptiveSurfaceReport report;
    mesh.mesh = adaptive_surface(mesh.partition, &report);
    mesh.finest_edge = report.finest_edge;
    return mesh;
  }

  [[nodiscard]] AdaptiveRow row_of(const AdaptiveMesh& mesh) const {
    AdaptiveRow row{mesh.error, mesh.finest_edge, summarise(mesh.mesh), nearness_of(mesh.mesh, field_, surface_.isovalue, mesh.error)};
    tell(fmt::format("error {} Å", mesh.error), row.surface);
    return row;
  }

  template <class Quantity>
  [[nodiscard]] Limit limit_of(const Quantity& quantity) const {
    return richardson_limit(quantity(study_.uniform[0].surface), quantity(study_.uniform[1].surface), quantity(study_.uniform[2].surface));
  }

  void tell(const std::string& what, const SurfaceSummary& surface) const {
    log_(fmt::format("{}, {}: {} vertices", study_.dataset.name, what, surface.all.vertices));
  }

  const Molecule& molecule_;
  GaussianSurfaceOptions surface_;
  GaussianField field_;
  MoleculeStudy& study_;
  const StudyLog& log_;
};

}  // namespace

MoleculeStudy study_molecule(const Dataset& dataset, const StudyOptions& options, const StudyLog& log) {
  MoleculeStudy result;
  result.dataset = dataset;
  Molecule molecule = read_molecule(dataset.path);
  result.atoms = molecule.atom_count();
  result.raised_radii = raise_small_radii(molecule);
  Study study(molecule, result, log);
  study.add_adaptive(options.errors);
  study.add_uniform();
  study.add_limits();
  study.add_published();
  return result;
}

}  // namespace smopt::experiments
