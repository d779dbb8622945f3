#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/convergence/change_explanation.h"
#include "experiments/convergence/published.h"
#include "experiments/convergence/richardson.h"
#include "experiments/convergence/surface_summary.h"
#include "experiments/datasets.h"

namespace smopt::experiments {

struct StudyOptions {
  /// Ångström, each half the one before: the errors of the adaptive meshes.
  std::vector<double> errors = {1, 0.5, 0.25, 0.125, 0.0625};
};

struct AdaptiveRow {
  double error = 0;        ///< ångström
  double finest_edge = 0;  ///< of the smallest cell that the surface crosses, ångström
  SurfaceSummary surface;
  Nearness nearness;
};

struct UniformRow {
  double spacing = 0;  ///< ångström
  SurfaceSummary surface;
  std::optional<Nearness> nearness;  ///< not of the finest grid
};

/// From one error to the next.
struct ChangeStep {
  double coarser_error = 0;  ///< ångström
  double finer_error = 0;    ///< ångström
  std::vector<ExplainedChange> changes;
};

/// One of the published program's meshes and ours of about as many vertices.
struct PublishedComparison {
  PublishedMesh published;
  AdaptiveRow ours;
};

struct MoleculeStudy {
  Dataset dataset;
  std::size_t atoms = 0;
  std::size_t raised_radii = 0;  ///< of atoms whose radius was below 0.5 Å, raised to 0.6 Å as TMSmesh does
  std::vector<AdaptiveRow> adaptive;
  std::vector<ChangeStep> steps;
  std::vector<UniformRow> uniform;  ///< at the default spacing, half and a quarter of it
  Limit area, volume, main_area, main_volume;
  std::vector<PublishedComparison> published;
};

/// Told what was just done, in a few words.
using StudyLog = std::function<void(const std::string&)>;

/// Meshes a molecule at every error and spacing and compares. \throws InvalidInput as the readers and generators do.
/// Cost: some ten seconds for ten thousand atoms, half of it for the distances of millions of vertices.
MoleculeStudy study_molecule(const Dataset& dataset, const StudyOptions& options, const StudyLog& log);

}  // namespace smopt::experiments
