#include "experiments/solvation_study/study.h"

#include <fmt/format.h>

#include <algorithm>

#include "smopt/error.h"
#include "smopt/io/small_radii.h"

namespace smopt::experiments {
namespace {

constexpr std::array kRefined = {SurfaceVariant::initial, SurfaceVariant::projected, SurfaceVariant::smopt,
                                 SurfaceVariant::volume_preserving, SurfaceVariant::improved_projected};
constexpr std::array kCompared = {SurfaceVariant::generated, SurfaceVariant::initial, SurfaceVariant::smopt};
constexpr std::array kApbsSurfaces = {ApbsSurface::gaussian, ApbsSurface::molecular, ApbsSurface::smoothed_molecular,
                                      ApbsSurface::van_der_waals};

/// Two grids, so that the spacing's influence is seen: the finer is what 4 GB hold of the AChE monomer.
constexpr std::array kApbsSpacings = {0.6, 0.42};

std::string energy_text(const Solve& solve) {
  return solve.is_success() ? fmt::format("polar {:.2f} kcal/mol, {} iterations, {:.1f} s", solve.result->polar, solve.result->iterations,
                                          solve.result->seconds)
                            : describe(solve);
}

Solve solve_variant(const TriangleMesh& generated, SurfaceVariant variant, const Molecule& molecule,
                    const GaussianSurfaceOptions& surface) {
  try {
    return solve(variant_of(generated, variant, molecule, surface), molecule);
  } catch (const std::exception& error) {
    Solve failed;
    failed.failure = error.what();
    return failed;
  }
}

std::optional<ObservedLimit> limit_of(const std::array<Solve, 3>& solves, double ratio) {
  if (!std::ranges::all_of(solves, &Solve::is_success)) return std::nullopt;
  return observed_limit(solves[0].result->polar, solves[1].result->polar, solves[2].result->polar, ratio);
}

ApbsRow run_row(const Molecule& molecule, const GaussianSurfaceOptions& gaussian, ApbsSurface surface, double spacing) {
  ApbsRow row{surface, spacing, {}, {}};
  ApbsOptions options;
  options.surface = surface;
  options.spacing = spacing;
  options.gaussian = gaussian;
  try {
    row.result = run_apbs(molecule, options);
  } catch (const MethodFailed& error) {
    row.failure = error.what();
  }
  return row;
}

std::vector<ApbsRow> run_apbs_rows(const Dataset& dataset, const Molecule& molecule, const StudyLog& log) {
  std::vector<ApbsRow> rows;
  for (const ApbsSurface surface : kApbsSurfaces) {
    for (const double spacing : kApbsSpacings) {
      const ApbsRow& row = rows.emplace_back(run_row(molecule, dataset.surface, surface, spacing));
      log(fmt::format("{}, APBS, {}, {} Å: {}", dataset.name, to_string(surface), spacing,
                      row.result ? fmt::format("{:.2f} kcal/mol", row.result->polar) : row.failure));
    }
  }
  return rows;
}

}  // namespace

const Solve* MoleculeComparison::find(SurfaceVariant variant) const {
  const auto found = std::ranges::find(meshes, variant, &MeshSolve::variant);
  return found == meshes.end() ? nullptr : &found->solve;
}

std::optional<double> MoleculeComparison::apbs_limit(ApbsSurface surface) const {
  std::vector<const ApbsRow*> rows;
  for (const ApbsRow& row : apbs)
    if (row.surface == surface && row.result) rows.push_back(&row);
  std::ranges::sort(rows, {}, &ApbsRow::spacing);
  if (rows.size() < 2 || rows[0]->spacing == rows[1]->spacing) return std::nullopt;
  const double fine = rows[0]->result->polar, coarse = rows[1]->result->polar;
  return fine + (fine - coarse) * rows[0]->spacing / (rows[1]->spacing - rows[0]->spacing);
}

Molecule molecule_of(const Dataset& dataset) {
  Molecule molecule = read_molecule(dataset.path);
  raise_small_radii(molecule);
  return molecule;
}

Refinement study_refinement(const Dataset& dataset, const SolvationStudyOptions& options, const StudyLog& log) {
  const Molecule molecule = molecule_of(dataset);
  Refinement refinement;
  refinement.dataset = dataset;
  for (const SurfaceVariant variant : kRefined) refinement.series.push_back({variant, {}, {}});
  GaussianSurfaceOptions surface = dataset.surface;
  surface.spacing = options.coarsest_spacing;
  for (std::size_t level = 0; level < refinement.spacings.size(); ++level, surface.spacing /= options.refinement) {
    refinement.spacings.at(level) = surface.spacing;
    const TriangleMesh generated = gaussian_surface(molecule, surface);
    for (RefinementSeries& series : refinement.series) {
      Solve& solve = series.solves.at(level) = solve_variant(generated, series.variant, molecule, surface);
      log(fmt::format("{}, {}, {:.3f} Å: {}", dataset.name, to_string(series.variant), surface.spacing, energy_text(solve)));
    }
  }
  for (RefinementSeries& series : refinement.series) series.limit = limit_of(series.solves, options.refinement);
  return refinement;
}

MoleculeComparison compare_meshes(const Dataset& dataset, const SolvationStudyOptions& options, const StudyLog& log) {
  const Molecule molecule = molecule_of(dataset);
  MoleculeComparison comparison;
  comparison.dataset = dataset;
  comparison.atoms = molecule.atom_count();
  const TriangleMesh generated = gaussian_surface(molecule, dataset.surface);
  for (const SurfaceVariant variant : kCompared) {
    comparison.meshes.push_back({variant, solve_variant(generated, variant, molecule, dataset.surface)});
    log(fmt::format("{}, {}: {}", dataset.name, to_string(variant), energy_text(comparison.meshes.back().solve)));
  }
  if (options.with_apbs) comparison.apbs = run_apbs_rows(dataset, molecule, log);
  return comparison;
}

}  // namespace smopt::experiments
