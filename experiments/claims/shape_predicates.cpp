#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/claims/predicates.h"
#include "experiments/method_cases.h"

namespace smopt::experiments {
namespace {

using Json = RecordSet::Json;

/// "small deviations" of the area: the paper gives no number; Figure 5's two bars look alike up to about so much.
constexpr double kSmallAreaChange = 0.05;
/// "keeps a deviation within 3%".
constexpr double kVolumeBound = 0.03;
/// "uniform distributed between (0, 0.8)": the shares below any ratio may be off by as much as an eye sees in a histogram.
constexpr double kUniformEnd = 0.8, kUniformDeviation = 0.1;
/// "clustered around 0.7".
constexpr double kClusterLow = 0.65, kClusterHigh = 0.75;
/// "clustered around 40° to 80°": more than half of the angles, where 22 % would be if all were as frequent.
constexpr double kAnglesLow = 40, kAnglesHigh = 80, kClustered = 0.5;
/// "a small portion are close to 0° or 180°".
constexpr double kSharp = 10, kFlat = 170, kSmallPortion = 0.01;
/// "greatly improved": a tenth of the bad triangles are left, or fewer.
constexpr double kGreatly = 0.1;

/// A histogram of a record: bins between increasing edges.
struct Histogram {
  std::vector<double> edges, counts;

  [[nodiscard]] double total() const {
    double sum = 0;
    for (const double count : counts) sum += count;
    return sum;
  }

  /// The share below `x`, a bin that `x` cuts taken in proportion.
  [[nodiscard]] double share_below(double x) const {
    double below = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) below += counts[i] * std::clamp((x - edges[i]) / (edges[i + 1] - edges[i]), 0.0, 1.0);
    return below / total();
  }

  [[nodiscard]] double standard_deviation() const {
    double mean = 0, variance = 0;
    const auto middle = [this](std::size_t i) { return (edges[i] + edges[i + 1]) / 2; };
    for (std::size_t i = 0; i < counts.size(); ++i) mean += counts[i] * middle(i) / total();
    for (std::size_t i = 0; i < counts.size(); ++i) variance += counts[i] * (middle(i) - mean) * (middle(i) - mean) / total();
    return std::sqrt(variance);
  }
};

std::optional<Histogram> histogram_of(const MoleculeRow& row, std::string_view method, const std::string& metric) {
  const Json* const record = row.record(method);
  const Json::json_pointer pointer("/metrics/after/" + metric + "/histogram");
  if (!is_done(record) || !record->contains(pointer)) return std::nullopt;
  Histogram histogram{record->at(pointer).at("edges").get<std::vector<double>>(),
                      record->at(pointer).at("counts").get<std::vector<double>>()};
  return histogram.total() > 0 ? std::optional(histogram) : std::nullopt;
}

FindInRow change_of(std::string_view method, const std::string& quantity) {
  return [method, quantity](const MoleculeRow& row) -> std::optional<Finding> {
    const auto before = number_of(row, method, "/metrics/before/" + quantity), after = number_of(row, method, "/metrics/after/" + quantity);
    return before && after && *before != 0 ? std::optional(percent_finding(*after / *before - 1, 2)) : std::nullopt;
  };
}

FindInRow share_at(std::string_view method, const std::string& pointer) {
  return [method, pointer](const MoleculeRow& row) -> std::optional<Finding> {
    const auto share = number_of(row, method, pointer);
    return share ? std::optional(percent_finding(*share, 3)) : std::nullopt;
  };
}

Evidence area_hardly_changes(const RecordSet& records) {
  return judge_each(records, kSmopt, change_of(kSmopt, "area"), [](double change) { return std::abs(change) <= kSmallAreaChange; });
}

Evidence area_shrinks(const RecordSet& records) {
  return judge_each(records, kSmopt, change_of(kSmopt, "area"), [](double change) { return change < 0; });
}

Evidence volume_kept(const RecordSet& records) {
  return judge_each(records, kSmopt, change_of(kSmopt, "volume"), [](double change) { return std::abs(change) <= kVolumeBound; });
}

/// The largest difference between the share below a ratio and what it is where all ratios below 0.8 are as frequent.
Evidence initial_ratios_uniform(const RecordSet& records) {
  const auto deviation = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto histogram = histogram_of(row, kInitial, "edge_ratio");
    if (!histogram) return std::nullopt;
    double largest = 0;
    for (const double edge : histogram->edges)
      largest = std::max(largest, std::abs(histogram->share_below(edge) - std::min(edge / kUniformEnd, 1.0)));
    return Finding{largest, fmt::format("off by up to {}, {} above 0.8", percent_finding(largest, 0).text,
                                        percent_finding(1 - histogram->share_below(kUniformEnd), 0).text)};
  };
  return judge_each(records, kInitial, deviation, [](double value) { return value <= kUniformDeviation; });
}

Evidence median_ratio(const RecordSet& records, std::string_view method) {
  const auto median = [method](const MoleculeRow& row) -> std::optional<Finding> {
    const auto value = number_of(row, method, "/metrics/after/edge_ratio/median");
    return value ? std::optional(number_finding(*value, 2, "")) : std::nullopt;
  };
  return judge_each(records, method, median, [](double value) { return value >= kClusterLow && value <= kClusterHigh; });
}

Evidence ratios_clustered(const RecordSet& records) {
  return combined("Median of SMOPT", median_ratio(records, kSmopt), "of ISO2mesh", median_ratio(records, "iso2mesh"));
}

Evidence more_concentrated(const RecordSet& records) {
  const auto ratio = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto smopt = histogram_of(row, kSmopt, "edge_ratio"), iso2mesh = histogram_of(row, "iso2mesh", "edge_ratio");
    if (!smopt || !iso2mesh) return std::nullopt;
    const double ours = smopt->standard_deviation(), theirs = iso2mesh->standard_deviation();
    return Finding{ours / theirs, fmt::format("standard deviation {:.3f}, ISO2mesh {:.3f}", ours, theirs)};
  };
  return judge_each(records, kSmopt, ratio, [](double value) { return value < 1; });
}

Evidence no_low_ratio(const RecordSet& records) {
  return judge_each(records, kSmopt, share_at(kSmopt, "/metrics/after/edge_ratio/below_0.1"), [](double share) { return share == 0; });
}

Evidence angles_clustered(const RecordSet& records) {
  const auto share = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto before = histogram_of(row, kInitial, "angle_deg"), after = histogram_of(row, kSmopt, "angle_deg");
    if (!before || !after) return std::nullopt;
    const auto clustered = [](const Histogram& h) { return h.share_below(kAnglesHigh) - h.share_below(kAnglesLow); };
    return Finding{clustered(*after) > clustered(*before) ? clustered(*after) : 0,
                   fmt::format("{} (initial {})", percent_finding(clustered(*after), 0).text, percent_finding(clustered(*before), 0).text)};
  };
  return judge_each(records, kSmopt, share, [](double value) { return value > kClustered; });
}

Evidence few_sharp_angles(const RecordSet& records) {
  const auto share = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto histogram = histogram_of(row, kSmopt, "angle_deg");
    if (!histogram) return std::nullopt;
    return percent_finding(histogram->share_below(kSharp) + 1 - histogram->share_below(kFlat), 3);
  };
  return judge_each(records, kSmopt, share, [](double value) { return value <= kSmallPortion; });
}

Evidence greatly_improved(const RecordSet& records) {
  const auto ratio = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto before = number_of(row, kSmopt, "/metrics/before/min_angle_share/below_10");
    const auto after = number_of(row, kSmopt, "/metrics/after/min_angle_share/below_10");
    if (!before || !after || *before <= 0) return std::nullopt;
    return Finding{*after / *before, fmt::format("{} → {}", percent_finding(*before, 1).text, percent_finding(*after, 3).text)};
  };
  return judge_each(records, kSmopt, ratio, [](double value) { return value <= kGreatly; });
}

}  // namespace

std::vector<Predicate> shape_predicates() {
  return {{"area-hardly-changes", area_hardly_changes},
          {"area-shrinks", area_shrinks},
          {"volume-kept", volume_kept},
          {"initial-ratios-uniform", initial_ratios_uniform},
          {"ratios-clustered", ratios_clustered},
          {"more-concentrated", more_concentrated},
          {"no-low-ratio", no_low_ratio},
          {"angles-clustered", angles_clustered},
          {"few-sharp-angles", few_sharp_angles},
          {"greatly-improved", greatly_improved}};
}

}  // namespace smopt::experiments
