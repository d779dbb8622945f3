#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiments/apbs/apbs.h"
#include "experiments/datasets.h"
#include "experiments/solvation_study/born_study.h"
#include "experiments/solvation_study/observed_limit.h"
#include "experiments/solvation_study/surface_variant.h"

namespace smopt::experiments {

struct SolvationStudyOptions {
  std::vector<int> sphere_divisions = {3, 4, 5, 6};
  double coarsest_spacing = 1;        ///< Å, of the refined molecule's three grids
  double refinement = 1.41421356237;  ///< from each spacing to the next: √2
  bool with_apbs = false;
};

/// One variant of a molecule's surface at three spacings.
struct RefinementSeries {
  SurfaceVariant variant = SurfaceVariant::initial;
  std::array<Solve, 3> solves;         ///< from coarse to fine
  std::optional<ObservedLimit> limit;  ///< of the polar energy; nothing where a solve failed or the energies show no convergence
};

struct Refinement {
  Dataset dataset;
  std::array<double, 3> spacings{};  ///< Å
  std::vector<RefinementSeries> series;
};

/// One variant of a molecule's surface at the dataset's spacing.
struct MeshSolve {
  SurfaceVariant variant = SurfaceVariant::initial;
  Solve solve;
};

/// One run of APBS.
struct ApbsRow {
  ApbsSurface surface = ApbsSurface::molecular;
  double spacing = 0;  ///< asked for, Å
  std::optional<ApbsResult> result;
  std::string failure;  ///< why there is no result
};

struct MoleculeComparison {
  Dataset dataset;
  std::size_t atoms = 0;
  std::vector<MeshSolve> meshes;
  std::vector<ApbsRow> apbs;  ///< empty: not asked for

  /// The solve on a variant; null where there is none.
  [[nodiscard]] const Solve* find(SurfaceVariant variant) const;
  /// What APBS's energies with a surface tend to, on the straight line through those of the two finest grids, kcal/mol: its error is of first order.
  /// Nothing where there are not two.
  [[nodiscard]] std::optional<double> apbs_limit(ApbsSurface surface) const;
};

struct SolvationStudy {
  std::vector<BornSeries> born;
  std::vector<Refinement> refinements;
  std::vector<MoleculeComparison> comparisons;
};

/// The molecule as the generator gets it: small radii are raised. \throws InvalidInput
Molecule molecule_of(const Dataset& dataset);

/// Solves on every variant but the generated one at spacings h, h/r and h/r².
Refinement study_refinement(const Dataset& dataset, const SolvationStudyOptions& options, const StudyLog& log);

/// Solves on the initial mesh and the improved one;
/// with APBS where asked for, on the same radii.
MoleculeComparison compare_meshes(const Dataset& dataset, const SolvationStudyOptions& options, const StudyLog& log);

}  // namespace smopt::experiments
