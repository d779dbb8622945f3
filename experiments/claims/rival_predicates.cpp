#include <fmt/format.h>

#include <cmath>

#include "experiments/claims/predicates.h"
#include "experiments/method_cases.h"
#include "experiments/paper_table.h"

namespace smopt::experiments {
namespace {

constexpr std::string_view kIso2mesh = "iso2mesh";
constexpr std::string_view kMeshlab = "meshlab";

/// "close to those from SMOPT": Table 3's are within 1.5 % of them.
constexpr double kCloseVertices = 0.015;

/// "preserves both": as near as the paper calls "almost preserved" of SMOPT's volume.
constexpr double kPreserved = 0.03;

/// TMSmesh 2.0 "succeeds to generate manifold surface meshes for biomolecules comprised of more than one million atoms".
constexpr double kManyAtoms = 1e6;

Evidence iso2mesh_pairs(const RecordSet& records) {
  const auto pairs = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto count = number_of(row, kIso2mesh, "/metrics/after/intersecting_pairs");
    if (!count) return std::nullopt;
    const auto paper = paper_table(3).value(row.paper_row, "intersecting_pairs_iso2mesh");
    return Finding{*count, paper ? fmt::format("{:.0f} (paper {})", *count, *paper) : fmt::format("{:.0f}", *count)};
  };
  return judge_each(records, kIso2mesh, pairs, [](double count) { return count > 0; });
}

Evidence iso2mesh_vertices(const RecordSet& records) {
  const auto ratio = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto ours = number_of(row, kSmopt, "/metrics/after/vertices"), theirs = number_of(row, kIso2mesh, "/metrics/after/vertices");
    return ours && theirs && *ours > 0 ? std::optional(percent_finding(*theirs / *ours - 1, 2)) : std::nullopt;
  };
  return judge_each(records, kIso2mesh, ratio, [](double value) { return std::abs(value) <= kCloseVertices; });
}

Evidence change_of_iso2mesh(const RecordSet& records, const std::string& quantity) {
  const auto change = [&](const MoleculeRow& row) -> std::optional<Finding> {
    const auto before = number_of(row, kIso2mesh, "/metrics/before/" + quantity),
               after = number_of(row, kIso2mesh, "/metrics/after/" + quantity);
    return before && after && *before != 0 ? std::optional(percent_finding(*after / *before - 1, 1)) : std::nullopt;
  };
  return judge_each(records, kIso2mesh, change, [](double value) { return std::abs(value) <= kPreserved; });
}

Evidence iso2mesh_preserves(const RecordSet& records) {
  return combined("Area", change_of_iso2mesh(records, "area"), "Volume", change_of_iso2mesh(records, "volume"));
}

Evidence meshlab_diverges(const RecordSet& records) {
  const auto step = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto at = number_of(row, kMeshlab, "/diverged_at_step");
    return at ? Finding{1, fmt::format("diverged at step {:.0f}", *at)} : Finding{0, "did not diverge"};
  };
  return judge_each(records, kMeshlab, step, [](double diverged) { return diverged > 0; });
}

/// The cases of SMOPT that were run with this option, whatever they are called, judged by their pairs.
Evidence pairs_with_option(const RecordSet& records, const std::string& option, const std::string& value, bool expects_pairs) {
  Evidence evidence;
  for (const std::string& method : records.methods()) {
    const auto pairs = [&](const MoleculeRow& row) -> std::optional<Finding> {
      const RecordSet::Json* const record = row.record(method);
      if (text_at(record, "/registered_method") != kSmopt || text_at(record, "/options/" + option) != value) return std::nullopt;
      const auto count = number_at(record, "/metrics/after/intersecting_pairs");
      return count ? std::optional(number_finding(*count, 0, " pairs")) : std::nullopt;
    };
    const Evidence found = judge_each(records, method, pairs, [expects_pairs](double count) { return (count > 0) == expects_pairs; });
    if (found.verdict != ClaimVerdict::cannot_be_told && !found.ours.empty() && found.ours.find("pairs") != std::string::npos)
      evidence = combined("and", evidence, method, found);
  }
  return evidence;
}

Evidence vicinity_suffices(const RecordSet& records) {
  return pairs_with_option(records, "guard", "paper", false);
}

Evidence kept_cavities_collapse(const RecordSet& records) {
  return pairs_with_option(records, "cavities", "keep", true);
}

Evidence million_atoms(const RecordSet& records) {
  const auto manifold = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto atoms = number_of(row, kInitial, "/molecule/atoms");
    if (!atoms || *atoms < kManyAtoms) return std::nullopt;
    const RecordSet::Json& metrics = row.record(kInitial)->at("metrics").at("after");
    const bool is_manifold =
        metrics.value("edge_manifold", false) && metrics.value("vertex_manifold", false) && metrics.value("closed", false);
    return Finding{is_manifold ? 1.0 : 0.0, fmt::format("{:.0f} atoms, {}", *atoms, is_manifold ? "manifold" : "not manifold")};
  };
  return judge_each(records, kInitial, manifold, [](double is_manifold) { return is_manifold > 0; });
}

}  // namespace

std::vector<Predicate> rival_predicates() {
  return {
      {"iso2mesh-pairs", iso2mesh_pairs},     {"iso2mesh-vertices", iso2mesh_vertices}, {"iso2mesh-preserves", iso2mesh_preserves},
      {"meshlab-diverges", meshlab_diverges}, {"vicinity-suffices", vicinity_suffices}, {"kept-cavities-collapse", kept_cavities_collapse},
      {"million-atoms", million_atoms}};
}

}  // namespace smopt::experiments
