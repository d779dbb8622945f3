#include <fmt/format.h>

#include <cmath>

#include "experiments/claims/predicates.h"
#include "experiments/datasets.h"
#include "experiments/method_cases.h"
#include "experiments/paper_table.h"

namespace smopt::experiments {
namespace {

/// How far an energy may be from the paper's to be called the same: meshes of this size give it to a per cent or two.
constexpr double kSameEnergy = 0.05;

/// 1 for a success, 0 for a failure; the reason stays in Table 1.
Finding outcome(bool is_success) {
  return {is_success ? 1.0 : 0.0, is_success ? "success" : "failed"};
}

Evidence tetgen(const RecordSet& records, std::string_view method, const std::string& switches, bool expected) {
  const auto status = [&](const MoleculeRow& row) -> std::optional<Finding> {
    const auto text = text_at(row.record(method), "/tetgen/" + switches + "/status");
    return text ? std::optional(outcome(*text == "success")) : std::nullopt;
  };
  return judge_each(records, method, status, [expected](double success) { return (success > 0) == expected; });
}

Evidence initial_fails_in_tetgen(const RecordSet& records) {
  return combined("-p", tetgen(records, kInitial, "p", false), "-pY", tetgen(records, kInitial, "pY", false));
}

Evidence improved_succeeds_in_tetgen(const RecordSet& records) {
  return combined("-p", tetgen(records, kSmopt, "p", true), "-pY", tetgen(records, kSmopt, "pY", true));
}

/// Nothing where it was not asked for, or did not fit into the memory.
std::optional<Finding> solvation_outcome(const MoleculeRow& row, std::string_view method) {
  const auto status = text_at(row.record(method), "/solvation/status");
  if (!status || *status == "not computed" || *status == "over limit" || *status == "no_charges") return std::nullopt;
  const auto iterations = number_of(row, method, "/solvation/iterations");
  const std::string after = iterations ? fmt::format(" after {:.0f} iterations", *iterations) : "";
  return Finding{*status == "success" ? 1.0 : 0.0, *status == "not_converged" ? "not converged" + after : *status + after};
}

Evidence initial_fails_in_afmpb(const RecordSet& records) {
  return judge_each(
      records, kInitial, [](const MoleculeRow& row) { return solvation_outcome(row, kInitial); },
      [](double success) { return success == 0; });
}

Evidence improved_succeeds_in_afmpb(const RecordSet& records) {
  return judge_each(
      records, kSmopt, [](const MoleculeRow& row) { return solvation_outcome(row, kSmopt); }, [](double success) { return success > 0; });
}

/// The ratio to the paper's energy; a stand-in has another.
Evidence energies(const RecordSet& records) {
  const auto ratio = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto paper = paper_table(1).value(row.paper_row, "afmpb_improved_kcal_per_mol");
    const auto total = number_of(row, kSmopt, "/solvation/total_kcal_per_mol"),
               polar = number_of(row, kSmopt, "/solvation/polar_kcal_per_mol");
    const bool is_stand_in = text_at(row.record(kSmopt), "/molecule/role") == to_string(Role::stand_in);
    if (!paper || !total || !polar || is_stand_in) return std::nullopt;
    return Finding{*total / std::stod(*paper),
                   fmt::format("total {:.1f}, of it polar {:.1f} (paper {:.1f})", *total, *polar, std::stod(*paper))};
  };
  return judge_each(records, kSmopt, ratio, [](double value) { return std::abs(value - 1) <= kSameEnergy; });
}

}  // namespace

std::vector<Predicate> simulation_predicates() {
  return {{"initial-fails-in-tetgen", initial_fails_in_tetgen},
          {"improved-succeeds-in-tetgen", improved_succeeds_in_tetgen},
          {"initial-fails-in-afmpb", initial_fails_in_afmpb},
          {"improved-succeeds-in-afmpb", improved_succeeds_in_afmpb},
          {"energies", energies}};
}

}  // namespace smopt::experiments
