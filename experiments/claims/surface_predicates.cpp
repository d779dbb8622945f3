#include <fmt/format.h>

#include <array>
#include <cmath>

#include "experiments/claims/predicates.h"
#include "experiments/method_cases.h"
#include "experiments/paper_table.h"

namespace smopt::experiments {
namespace {

using Json = RecordSet::Json;

/// Table 1: from 1.2 % (70S ribosome) to 6.8 % (AChE monomer) of the vertices.
constexpr double kLeastRemoved = 0.01, kMostRemoved = 0.07;

/// How far our number of cavities may be from the paper's to be called the same.
constexpr double kSameCavities = 0.1;

bool is_zero(double value) {
  return value == 0;
}

std::optional<Finding> count_at(const MoleculeRow& row, std::string_view method, const std::string& pointer) {
  const auto value = number_of(row, method, pointer);
  return value ? std::optional(number_finding(*value, 0, "")) : std::nullopt;
}

Evidence no_pairs(const RecordSet& records) {
  return judge_each(
      records, kSmopt, [](const MoleculeRow& row) { return count_at(row, kSmopt, "/metrics/after/intersecting_pairs"); }, is_zero);
}

/// How many of the things that a manifold has are missing, and how many triangles intersect or are degenerate.
std::optional<Finding> faults(const MoleculeRow& row, std::string_view method) {
  const Json& metrics = row.record(method)->at("metrics").at("after");
  double count = 0;
  for (const char* flag : {"closed", "edge_manifold", "vertex_manifold", "oriented"}) count += metrics.value(flag, true) ? 0 : 1;
  for (const char* number : {"intersecting_pairs", "degenerate_triangles"})
    count += number_at(&metrics, fmt::format("/{}", number)).value_or(0);
  return number_finding(count, 0, count == 1 ? " fault" : " faults");
}

Evidence initial_is_manifold(const RecordSet& records) {
  return judge_each(
      records, kInitial, [](const MoleculeRow& row) { return faults(row, kInitial); }, is_zero);
}

Evidence manifoldness_kept(const RecordSet& records) {
  return judge_each(
      records, kSmopt, [](const MoleculeRow& row) { return faults(row, kSmopt); }, is_zero);
}

Evidence topology_kept(const RecordSet& records) {
  const auto change = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto before = number_of(row, kSmopt, "/metrics/before/euler_characteristic");
    const auto after = number_of(row, kSmopt, "/metrics/after/euler_characteristic");
    if (!before || !after) return std::nullopt;
    return Finding{*after - *before, fmt::format("χ {:.0f} → {:.0f}", *before, *after)};
  };
  return judge_each(records, kSmopt, change, is_zero);
}

Evidence redundant_points(const RecordSet& records) {
  const auto removed = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto three = number_of(row, kSmopt, "/removed/redundant_valence3"), four = number_of(row, kSmopt, "/removed/redundant_valence4");
    if (!three || !four) return std::nullopt;
    return Finding{*three + *four, fmt::format("{:.0f} of valence 3, {:.0f} of valence 4", *three, *four)};
  };
  return judge_each(records, kSmopt, removed, [](double count) { return count > 0; });
}

Evidence fewer_vertices(const RecordSet& records) {
  const auto removed = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto initial = number_of(row, kInitial, "/metrics/after/vertices"), improved = number_of(row, kSmopt, "/metrics/after/vertices");
    const auto in_cavities = number_of(row, kSmopt, "/removed/cavity_vertices");
    if (!initial || !improved || *initial == 0) return std::nullopt;
    Finding finding = percent_finding(1 - *improved / *initial, 1);
    finding.text += in_cavities ? fmt::format(" ({:.0f} vertices, {:.0f} of them in cavities)", *initial - *improved, *in_cavities) : "";
    return finding;
  };
  return judge_each(records, kSmopt, removed, [](double share) { return share >= kLeastRemoved && share <= kMostRemoved; });
}

/// How many sphere-like components the paper's numbers of vertices and triangles say were deleted: half of what χ = V − F/2 drops by.
std::optional<double> paper_cavities(const MoleculeRow& row) {
  std::array<double, 4> numbers{};
  constexpr std::array<const char*, 4> kColumns = {"vertices_initial", "triangles_initial", "vertices_improved", "triangles_improved"};
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    const auto text = paper_table(1).value(row.paper_row, kColumns[i]);
    if (!text) return std::nullopt;
    numbers[i] = std::stod(*text);
  }
  return ((numbers[0] - numbers[1] / 2) - (numbers[2] - numbers[3] / 2)) / 2;
}

Evidence cavities(const RecordSet& records) {
  const auto ratio = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto paper = paper_cavities(row), ours = number_of(row, kSmopt, "/removed/cavities");
    if (!paper || !ours) return std::nullopt;
    return Finding{*ours / *paper, fmt::format("{:.0f} (paper {:.0f})", *ours, *paper)};
  };
  return judge_each(records, kSmopt, ratio, [](double value) { return std::abs(value - 1) <= kSameCavities; });
}

Evidence any_mesh(const RecordSet& records) {
  return judge_each(
      records, kSmopt,
      [](const MoleculeRow& row) -> std::optional<Finding> {
        const auto vertices = number_of(row, kSmopt, "/metrics/after/vertices");
        return vertices ? std::optional(number_finding(*vertices, 0, " vertices")) : std::nullopt;
      },
      [](double) { return true; });
}

Evidence closer_to_the_surface_of(const RecordSet& records, std::string_view method) {
  const auto ratio = [method](const MoleculeRow& row) -> std::optional<Finding> {
    const auto before = number_of(row, method, "/level_set_distance/before/mean"),
               after = number_of(row, method, "/level_set_distance/after/mean");
    if (!before || !after || *before <= 0) return std::nullopt;
    return Finding{*after / *before, fmt::format("{:.3f} → {:.3f} Å", *before, *after)};
  };
  return judge_each(records, method, ratio, [](double value) { return value < 1; });
}

Evidence closer_to_the_surface(const RecordSet& records) {
  return combined("SMOPT", closer_to_the_surface_of(records, kSmopt), "ISO2mesh", closer_to_the_surface_of(records, "iso2mesh"));
}

}  // namespace

std::vector<Predicate> surface_predicates() {
  return {{"no-pairs", no_pairs},
          {"initial-is-manifold", initial_is_manifold},
          {"manifoldness-kept", manifoldness_kept},
          {"topology-kept", topology_kept},
          {"redundant-points", redundant_points},
          {"fewer-vertices", fewer_vertices},
          {"cavities", cavities},
          {"any-mesh", any_mesh},
          {"closer-to-the-surface", closer_to_the_surface}};
}

}  // namespace smopt::experiments
