#include "experiments/solvation_study/study_markdown.h"

#include <fmt/format.h>

#include "experiments/solvation_study/findings.h"
#include "experiments/tables/markdown.h"

namespace smopt::experiments {
namespace {

// Decimals.
constexpr int kEnergy = 2;
constexpr int kLength = 3;
constexpr int kSeconds = 1;
constexpr int kOrder = 2;
constexpr int kPercent = 3;

constexpr const char* kIntroduction = R"(# What the Poisson–Boltzmann solver gives

AFMPB's job, done by this project's own solver: the linearised Poisson–Boltzmann equation by boundary elements on a molecule's surface, with
AFMPB's defaults (permittivities 2 and 80, 150 mM, 300 K, residual 1e-6) and the solver's own for what is not AFMPB's. Energies
in kcal/mol. *Degenerate vertices* are those whose normal AFMPB could not form: its answer would be NaN.
)";

constexpr const char* kBornText = R"(
## Born's ion

A unit charge in the middle of a sphere of 5 Å, whose energy is known, on icospheres. Kirkwood's sphere with three charges off its centre is held
against its series solution by the tests of the solver.
)";

constexpr const char* kRefinementText = R"(
A molecule's surface at three spacings, each the one before divided by the same number. *Extrapolated* is Richardson's, at the order that the three
polar energies show. *initial* has no cavities; *smopt* is improved with the defaults, which shrinks it by some per cent of its area, less the finer
it is; *volume-preserving* keeps what is enclosed; *projected* vertices lie on the level set itself.
)";

constexpr const char* kComparisonText = R"(
## Initial and improved meshes

The question of the paper's Table 1: does a boundary-element solver work on the mesh?
)";

constexpr const char* kApbsText = R"(
## Beside APBS

APBS solves the same equation by finite differences. Given the same Gaussian surface, as maps of the permittivity, it should give the energy of the
mesh as generated, cavities and all; what differs then is the method. With its own surfaces the energy differs because the surface does, and the energy
goes with the distance between charges and surface. A molecular surface is where a probe of 1.4 Å rolls over the atoms; the Gaussian one, with its decay
of 0.6 Å⁻², lies farther out, so its energy is smaller in amount. The van der Waals surface lets water of permittivity 80 into every gap between atoms,
where no molecule of water fits, which makes the energy much larger. APBS errs at first order in its spacing: *extrapolated* is the straight line through
its two energies, at no spacing.
)";

Cell counted(std::size_t n) {
  return static_cast<long>(n);
}

/// A number of a result that there may not be.
template <class Get>
Cell of_result(const Solve& solve, int decimals, const Get& get) {
  return solve.result ? decimal_cell(get(*solve.result), decimals) : Cell();
}

Cell polar_cell(const Solve& solve) {
  return of_result(solve, kEnergy, [](const auto& result) { return result.polar; });
}

Cell iterations_cell(const Solve& solve) {
  return solve.result ? Cell(static_cast<long>(solve.result->iterations)) : Cell();
}

Cell residual_cell(const Solve& solve) {
  return solve.result ? Cell(fmt::format("{:.1e}", solve.result->relative_residual)) : Cell();
}

Cell seconds_cell(const Solve& solve) {
  return of_result(solve, kSeconds, [](const auto& result) { return result.seconds; });
}

std::optional<double> hundredfold(const std::optional<double>& part) {
  return part ? std::optional(100 * *part) : std::nullopt;
}

Table born_table(const std::vector<BornSeries>& born) {
  Table table{"born",
              "Born's ion on icospheres",
              {{"kappa", "κ (Å⁻¹)"},
               {"vertices", "Vertices"},
               {"edge", "Mean edge (Å)"},
               {"exact", "Exact"},
               {"polar", "Polar"},
               {"error_percent", "Error (%)"},
               {"order", "Order"},
               {"iterations", "Iterations"},
               {"seconds", "Seconds"},
               {"status", "Status"}},
              {},
              {}};
  for (const BornSeries& series : born)
    for (const BornRow& row : series.rows)
      table.rows.push_back({Decimal{series.ion.medium.kappa(), 6}, counted(row.solve.vertices), Decimal{row.edge, kLength},
                            Decimal{series.ion.energy(), kLength}, of_result(row.solve, kLength, [](const auto& r) { return r.polar; }),
                            decimal_cell(hundredfold(row.error), kPercent), decimal_cell(row.order, kOrder), iterations_cell(row.solve),
                            seconds_cell(row.solve), describe(row.solve)});
  return table;
}

Table refinement_table(const Refinement& refinement) {
  Table table{"refinement",
              fmt::format("{}: the energy as the spacing goes down", refinement.dataset.title),
              {{"mesh", "Mesh"},
               {"spacing", "Spacing (Å)"},
               {"vertices", "Vertices"},
               {"area", "Area (Å²)"},
               {"volume", "Volume (Å³)"},
               {"polar", "Polar"},
               {"total", "Total"},
               {"iterations", "Iterations"},
               {"residual", "Residual"},
               {"degenerate", "Degenerate vertices"},
               {"seconds", "Seconds"},
               {"status", "Status"}},
              {},
              {}};
  for (const RefinementSeries& series : refinement.series) {
    for (std::size_t level = 0; level < series.solves.size(); ++level) {
      const Solve& solve = series.solves.at(level);
      table.rows.push_back({std::string(to_string(series.variant)), Decimal{refinement.spacings.at(level), kLength},
                            counted(solve.vertices), of_result(solve, 0, [](const auto& r) { return r.area; }),
                            of_result(solve, 0, [](const auto& r) { return r.volume; }), polar_cell(solve),
                            of_result(solve, kEnergy, [](const auto& r) { return r.total(); }), iterations_cell(solve),
                            residual_cell(solve), solve.result ? counted(solve.result->degenerate_vertices.size()) : Cell(),
                            seconds_cell(solve), describe(solve)});
    }
  }
  return table;
}

Table limit_table(const Refinement& refinement) {
  Table table{
      "limits",
      fmt::format("{}: what the polar energies tend to", refinement.dataset.title),
      {{"mesh", "Mesh"}, {"finest", "Finest"}, {"limit", "Extrapolated"}, {"order", "Observed order"}, {"distance", "Finest from it (%)"}},
      {},
      {}};
  for (const RefinementSeries& series : refinement.series) {
    std::vector<Cell>& row = table.rows.emplace_back();
    row = {std::string(to_string(series.variant)), polar_cell(series.solves.back())};
    if (!series.limit)
      row.insert(row.end(), {"not shown by the three", Cell(), Cell()});
    else
      row.insert(row.end(), {Decimal{series.limit->value, kEnergy}, Decimal{series.limit->order, kOrder},
                             Decimal{100 * series.limit->distance, kPercent}});
  }
  return table;
}

Table comparison_table(const std::vector<MoleculeComparison>& comparisons) {
  Table table{"initial_and_improved",
              "Our solver on initial and improved meshes",
              {{"molecule", "Molecule"},
               {"mesh", "Mesh"},
               {"vertices", "Vertices"},
               {"status", "Status"},
               {"iterations", "Iterations"},
               {"residual", "Residual"},
               {"polar", "Polar"},
               {"nonpolar", "Nonpolar"},
               {"total", "Total"},
               {"degenerate", "Degenerate vertices"},
               {"outside", "Charges outside"},
               {"seconds", "Seconds"}},
              {},
              {}};
  for (const MoleculeComparison& comparison : comparisons)
    for (const auto& [variant, solve] : comparison.meshes)
      table.rows.push_back({comparison.dataset.title, std::string(to_string(variant)), counted(solve.vertices), describe(solve),
                            iterations_cell(solve), residual_cell(solve), polar_cell(solve),
                            of_result(solve, kEnergy, [](const auto& r) { return r.nonpolar; }),
                            of_result(solve, kEnergy, [](const auto& r) { return r.total(); }),
                            solve.result ? counted(solve.result->degenerate_vertices.size()) : Cell(),
                            solve.result ? counted(solve.result->charges_outside) : Cell(), seconds_cell(solve)});
  return table;
}

std::vector<Cell> apbs_row(const ApbsRow& row, const MoleculeComparison& comparison) {
  const std::string surface = fmt::format("APBS, {}", to_string(row.surface));
  if (!row.result) return {Cell(), surface, Decimal{row.spacing, kLength}, Cell(), Cell(), Cell(), Cell(), row.failure};
  const ApbsResult& result = *row.result;
  return {Cell(),
          surface,
          Decimal{row.spacing, kLength},
          fmt::format("{} × {} × {}", result.grid.nodes[0], result.grid.nodes[1], result.grid.nodes[2]),
          Decimal{result.polar, kEnergy},
          decimal_cell(comparison.apbs_limit(row.surface), kEnergy),
          Decimal{result.seconds, kSeconds},
          "success"};
}

Table apbs_table(const std::vector<MoleculeComparison>& comparisons) {
  Table table{"apbs",
              "Polar energies by finite differences and by boundary elements",
              {{"molecule", "Molecule"},
               {"surface", "Surface"},
               {"spacing", "Spacing (Å)"},
               {"nodes", "Nodes or vertices"},
               {"polar", "Polar"},
               {"limit", "Extrapolated"},
               {"seconds", "Seconds"},
               {"status", "Status"}},
              {},
              {}};
  for (const MoleculeComparison& comparison : comparisons) {
    for (const auto& [variant, solve] : comparison.meshes)
      table.rows.push_back({Cell(), fmt::format("ours, {}", to_string(variant)), Decimal{comparison.dataset.surface.spacing, kLength},
                            counted(solve.vertices), polar_cell(solve), Cell(), seconds_cell(solve), describe(solve)});
    for (const ApbsRow& row : comparison.apbs) table.rows.push_back(apbs_row(row, comparison));
    table.rows[table.rows.size() - comparison.meshes.size() - comparison.apbs.size()].front() = comparison.dataset.title;
  }
  return table;
}

bool has_apbs_rows(const SolvationStudy& study) {
  for (const MoleculeComparison& comparison : study.comparisons)
    if (!comparison.apbs.empty()) return true;
  return false;
}

std::string findings_text(const SolvationStudy& study) {
  std::string text = "\n## What this shows\n\n";
  for (const std::string& sentence : findings(study)) text += fmt::format("- {}\n", sentence);
  return text;
}

}  // namespace

std::string study_markdown(const SolvationStudy& study, const std::string& command) {
  std::string page = kIntroduction;
  if (!study.born.empty()) page += fmt::format("{}\n{}", kBornText, to_markdown(born_table(study.born)));
  for (const Refinement& refinement : study.refinements)
    page += fmt::format("\n## {} refined\n{}\n{}\n{}", refinement.dataset.title, kRefinementText, to_markdown(limit_table(refinement)),
                        to_markdown(refinement_table(refinement)));
  if (!study.comparisons.empty()) page += fmt::format("{}\n{}", kComparisonText, to_markdown(comparison_table(study.comparisons)));
  if (has_apbs_rows(study)) page += fmt::format("{}\n{}", kApbsText, to_markdown(apbs_table(study.comparisons)));
  return page + findings_text(study) + fmt::format("\nMade by `{}`.\n", command);
}

}  // namespace smopt::experiments
