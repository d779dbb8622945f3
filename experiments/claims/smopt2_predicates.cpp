#include <fmt/format.h>

#include <cmath>

#include "experiments/claims/predicates.h"
#include "experiments/method_cases.h"
#include "experiments/tetgen_trials.h"

namespace smopt::experiments {
namespace {

/// What smopt2 aims at; a tenth of a degree is for meshes on which nothing helps any more.
constexpr double kSmallestAngle = 29.9, kLargestAngle = 110.1;
constexpr double kValence = 0.995;
constexpr double kVolume = 1e-5;
constexpr double kArea = 0.015;
constexpr double kLevelSet = 1.1;

using FindNumber = std::function<std::optional<Finding>(const MoleculeRow&, std::string_view method)>;

/// Ours beside SMOPT's: "30.00° (SMOPT 7.38°)".
FindInRow beside_smopt(const FindNumber& find) {
  return [find](const MoleculeRow& row) -> std::optional<Finding> {
    std::optional<Finding> finding = find(row, kSmopt2);
    const std::optional<Finding> smopt = is_done(row.record(kSmopt)) ? find(row, kSmopt) : std::nullopt;
    if (finding && smopt) finding->text += fmt::format(" (SMOPT {})", smopt->text);
    return finding;
  };
}

FindNumber number_at_place(const std::string& pointer, int decimals, const std::string& unit) {
  return [=](const MoleculeRow& row, std::string_view method) -> std::optional<Finding> {
    const auto value = number_of(row, method, pointer);
    return value ? std::optional(number_finding(*value, decimals, unit)) : std::nullopt;
  };
}

FindNumber relative_change(const std::string& pointer_before, const std::string& pointer_after, int decimals) {
  return [=](const MoleculeRow& row, std::string_view method) -> std::optional<Finding> {
    const auto before = number_of(row, method, pointer_before), after = number_of(row, method, pointer_after);
    return before && after && *before != 0 ? std::optional(percent_finding(*after / *before - 1, decimals)) : std::nullopt;
  };
}

Evidence no_pairs(const RecordSet& records) {
  return judge_each(records, kSmopt2, beside_smopt(number_at_place("/metrics/after/intersecting_pairs", 0, "")),
                    [](double count) { return count == 0; });
}

Evidence smallest_angle(const RecordSet& records) {
  return judge_each(records, kSmopt2, beside_smopt(number_at_place("/metrics/after/angle_deg/min", 2, "°")),
                    [](double angle) { return angle >= kSmallestAngle; });
}

Evidence largest_angle(const RecordSet& records) {
  return judge_each(records, kSmopt2, beside_smopt(number_at_place("/metrics/after/angle_deg/max", 1, "°")),
                    [](double angle) { return angle <= kLargestAngle; });
}

Evidence valence(const RecordSet& records) {
  const auto share = [](const MoleculeRow& row, std::string_view method) -> std::optional<Finding> {
    const auto value = number_of(row, method, "/metrics/after/valence/share_5_6_7");
    return value ? std::optional(percent_finding(*value, 1)) : std::nullopt;
  };
  return judge_each(records, kSmopt2, beside_smopt(share), [](double value) { return value >= kValence; });
}

Evidence volume(const RecordSet& records) {
  return judge_each(records, kSmopt2, beside_smopt(relative_change("/metrics/before/volume", "/metrics/after/volume", 4)),
                    [](double change) { return std::abs(change) <= kVolume; });
}

Evidence area(const RecordSet& records) {
  return judge_each(records, kSmopt2, beside_smopt(relative_change("/metrics/before/area", "/metrics/after/area", 2)),
                    [](double change) { return std::abs(change) <= kArea; });
}

Evidence level_set(const RecordSet& records) {
  const auto ratio = [](const MoleculeRow& row, std::string_view method) -> std::optional<Finding> {
    const auto before = number_of(row, method, "/level_set_distance/before/mean"),
               after = number_of(row, method, "/level_set_distance/after/mean");
    return before && after && *before > 0 ? std::optional(number_finding(*after / *before, 2, " times")) : std::nullopt;
  };
  return judge_each(records, kSmopt2, beside_smopt(ratio), [](double value) { return value <= kLevelSet; });
}

Evidence tetgen(const RecordSet& records) {
  const auto failures = [](const MoleculeRow& row, std::string_view method) -> std::optional<Finding> {
    double failed = 0, tried = 0;
    for (const std::string& switches : {std::string("p"), std::string("pY"), std::string(kQualitySwitches)}) {
      const auto status = text_at(row.record(method), "/tetgen/" + switches + "/status");
      if (!status || *status == "not computed") continue;
      tried += 1;
      failed += *status == "success" ? 0 : 1;
    }
    return tried > 0 ? std::optional(Finding{failed, fmt::format("{:.0f} of {:.0f}", tried - failed, tried)}) : std::nullopt;
  };
  return judge_each(records, kSmopt2, beside_smopt(failures), [](double failed) { return failed == 0; });
}

Evidence cost(const RecordSet& records) {
  const auto seconds = [](const MoleculeRow& row, std::string_view method) -> std::optional<Finding> {
    const auto value = number_of(row, method, "/cpu_seconds/total");
    return value ? std::optional(number_finding(*value, 2, " s")) : std::nullopt;
  };
  const auto ratio = [seconds](const MoleculeRow& row) -> std::optional<Finding> {
    const auto smopt2 = seconds(row, kSmopt2), smopt = is_done(row.record(kSmopt)) ? seconds(row, kSmopt) : std::nullopt;
    if (!smopt2 || !smopt || smopt->value <= 0) return std::nullopt;
    return Finding{smopt2->value / smopt->value,
                   fmt::format("{}, {:.0f} times SMOPT's {}", smopt2->text, smopt2->value / smopt->value, smopt->text)};
  };
  return judge_each(records, kSmopt2, ratio, [](double value) { return value > 1; });
}

}  // namespace

std::vector<Predicate> smopt2_predicates() {
  return {{"smopt2-no-pairs", no_pairs},
          {"smopt2-smallest-angle", smallest_angle},
          {"smopt2-largest-angle", largest_angle},
          {"smopt2-valence", valence},
          {"smopt2-volume", volume},
          {"smopt2-area", area},
          {"smopt2-level-set", level_set},
          {"smopt2-tetgen", tetgen},
          {"smopt2-cost", cost}};
}

}  // namespace smopt::experiments
