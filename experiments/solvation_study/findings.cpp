#include "experiments/solvation_study/findings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>

namespace smopt::experiments {
namespace {

// What is asked of the solver.
constexpr double kBornError = 0.005;           ///< at about 10 000 vertices
constexpr std::size_t kBornVertices = 10000;   ///< from this on
constexpr double kBornOrder = 1;               ///< at least, in the edge length
constexpr double kRichardsonDistance = 0.02;   ///< of the finest resolution's energy from the extrapolated one
constexpr double kMonomerSeconds = 90;         ///< on the improved mesh of the AChE monomer
constexpr double kMonomerMemoryMb = 3 * 1024;  ///< there
constexpr std::array kApbsSurfaces = {ApbsSurface::gaussian, ApbsSurface::molecular, ApbsSurface::smoothed_molecular,
                                      ApbsSurface::van_der_waals};
constexpr std::string_view kMonomer = "ache-monomer";

const char* verdict(bool holds) {
  return holds ? "Holds" : "Does not hold";
}

std::string percent(double part, int decimals = 2) {
  return fmt::format("{:.{}f} %", 100 * part, decimals);
}

/// The coarsest row that must be within kBornError; null where there is none.
const BornRow* judged_row(const BornSeries& series) {
  for (const BornRow& row : series.rows)
    if (row.solve.vertices >= kBornVertices) return &row;
  return nullptr;
}

double least_order(const BornSeries& series) {
  double least = HUGE_VAL;
  for (const BornRow& row : series.rows) least = std::min(least, row.order.value_or(HUGE_VAL));
  return least;
}

std::string born_finding(const BornSeries& series) {
  const double kappa = series.ion.medium.kappa();
  const BornRow* row = judged_row(series);
  if (row == nullptr || !row->error) return fmt::format("Not shown: Born's ion, κ = {:.6f} Å⁻¹: no error.", kappa);
  const double order = least_order(series);
  const std::string falls = std::isfinite(order)
                                ? fmt::format("falls at order {:.2f} or better down to {}", order, percent(kErrorOfSums, 3))
                                : fmt::format("is below {} on every mesh", percent(kErrorOfSums, 3));
  return fmt::format("{}: Born's ion, κ = {:.6f} Å⁻¹: the energy's error {}, and is {} at {} vertices (asked for: order {}, {}).",
                     verdict(order >= kBornOrder && *row->error < kBornError), kappa, falls, percent(*row->error, 4), row->solve.vertices,
                     kBornOrder, percent(kBornError));
}

std::string refinement_finding(const Refinement& refinement, const RefinementSeries& series) {
  const std::string what = fmt::format("{}, {}", refinement.dataset.title, to_string(series.variant));
  if (!series.limit) return fmt::format("Not shown: {}: the three energies do not show what they tend to.", what);
  return fmt::format(
      "{}: {}: at {:.3f} Å the polar energy is {} from its extrapolation, {:.1f} kcal/mol, of observed order {:.2f} (asked for: {:.0f} %).",
      verdict(series.limit->distance <= kRichardsonDistance), what, refinement.spacings.back(), percent(series.limit->distance),
      series.limit->value, series.limit->order, 100 * kRichardsonDistance);
}

std::string mesh_text(const MoleculeComparison& comparison, SurfaceVariant variant) {
  const Solve* solve = comparison.find(variant);
  if (solve == nullptr || !solve->result)
    return fmt::format("{}: {}", to_string(variant), solve == nullptr ? "not solved" : describe(*solve));
  return fmt::format("{}: {} after {} iterations, total {:.1f} kcal/mol, {} degenerate vertices", to_string(variant),
                     to_string(solve->result->status), solve->result->iterations, solve->result->total(),
                     solve->result->degenerate_vertices.size());
}

/// The paper's question: does the solver work on the one and not on the other?
std::string comparison_finding(const MoleculeComparison& comparison) {
  const Solve* initial = comparison.find(SurfaceVariant::generated);
  const Solve* improved = comparison.find(SurfaceVariant::smopt);
  const bool initial_works = initial != nullptr && initial->is_success(), improved_works = improved != nullptr && improved->is_success();
  const char* outcome = initial_works && improved_works ? "the solver converges on the initial mesh too"
                        : improved_works ? "the solver converges on the improved mesh, not on the initial one, as in the paper"
                        : initial_works  ? "the solver converges on the initial mesh, not on the improved one"
                                         : "the solver converges on neither mesh";
  return fmt::format("{}: {} ({}; {}).", comparison.dataset.title, outcome, mesh_text(comparison, SurfaceVariant::generated),
                     mesh_text(comparison, SurfaceVariant::smopt));
}

std::string cost_finding(const MoleculeComparison& comparison) {
  const Solve* improved = comparison.find(SurfaceVariant::smopt);
  if (improved == nullptr || !improved->result)
    return fmt::format("Not shown: {}: time and memory on the improved mesh.", comparison.dataset.title);
  const metrics::Solvation& result = *improved->result;
  return fmt::format("{}: {}, improved, {} vertices: {:.1f} s and {:.0f} MB by the estimate made beforehand (asked for: {} s, {} MB).",
                     verdict(result.seconds <= kMonomerSeconds && result.predicted_memory_mb <= kMonomerMemoryMb), comparison.dataset.title,
                     improved->vertices, result.seconds, result.predicted_memory_mb, kMonomerSeconds, kMonomerMemoryMb);
}

/// The mesh as generated, cavities and all, or the improved one where the solver does not converge on that.
SurfaceVariant compared_variant(const MoleculeComparison& comparison) {
  const Solve* generated = comparison.find(SurfaceVariant::generated);
  return generated != nullptr && generated->is_success() ? SurfaceVariant::generated : SurfaceVariant::smopt;
}

std::string apbs_finding(const MoleculeComparison& comparison, ApbsSurface surface) {
  const std::string what = fmt::format("{}, APBS with the {} surface", comparison.dataset.title, to_string(surface));
  const SurfaceVariant variant = compared_variant(comparison);
  const Solve* ours = comparison.find(variant);
  const auto theirs = comparison.apbs_limit(surface);
  if (!theirs || ours == nullptr || !ours->is_success()) return fmt::format("Not shown: {}: no two energies to compare.", what);
  const double ratio = ours->result->polar / *theirs;
  return fmt::format("{}: {:.1f} kcal/mol, extrapolated to no spacing; ours ({}): {:.1f} kcal/mol, {} sign, {:.3f} times as much.", what,
                     *theirs, to_string(variant), ours->result->polar, ratio > 0 ? "the same" : "another", ratio);
}

}  // namespace

std::vector<std::string> findings(const SolvationStudy& study) {
  std::vector<std::string> sentences;
  for (const BornSeries& series : study.born) sentences.push_back(born_finding(series));
  for (const Refinement& refinement : study.refinements)
    for (const RefinementSeries& series : refinement.series) sentences.push_back(refinement_finding(refinement, series));
  for (const MoleculeComparison& comparison : study.comparisons) {
    sentences.push_back(comparison_finding(comparison));
    if (comparison.dataset.name == kMonomer) sentences.push_back(cost_finding(comparison));
    if (!comparison.apbs.empty())
      for (const ApbsSurface surface : kApbsSurfaces) sentences.push_back(apbs_finding(comparison, surface));
  }
  return sentences;
}

}  // namespace smopt::experiments
