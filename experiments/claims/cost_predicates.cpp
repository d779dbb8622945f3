#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/claims/predicates.h"
#include "experiments/method_cases.h"
#include "experiments/paper_table.h"

namespace smopt::experiments {
namespace {

using Json = RecordSet::Json;
using Stages = std::vector<const char*>;

const Stages kCheck = {"validity", "cavities"};
const Stages kSmoothing = {"redundant", "smoothing"};

/// The exponent up to which time counts as growing in proportion to the vertices: ten times the vertices, at most 1.4 times the time of each.
constexpr double kLinearExponent = 1.15;

/// An exponent is told from at least so many molecules, the largest so many times the smallest.
constexpr std::size_t kLeastMolecules = 3;
constexpr double kLeastSpan = 4;

/// Of the moves that all vertices in every round would be: fewer is "greatly reduced".
constexpr double kGreatlyReduced = 0.5;

std::optional<double> seconds_of(const MoleculeRow& row, const Stages& stages) {
  double sum = 0;
  for (const char* stage : stages) {
    const auto seconds = number_of(row, kSmopt, fmt::format("/cpu_seconds/{}", stage));
    if (!seconds) return std::nullopt;
    sum += *seconds;
  }
  return sum;
}

Evidence not_slower_than_the_paper(const RecordSet& records, const Stages& stages, const std::string& column) {
  const auto ratio = [&](const MoleculeRow& row) -> std::optional<Finding> {
    const auto paper = paper_table(2).value(row.paper_row, column);
    const auto seconds = seconds_of(row, stages);
    if (!paper || !seconds) return std::nullopt;
    return Finding{*seconds / std::stod(*paper), fmt::format("{:.3f} s (paper {} s)", *seconds, *paper)};
  };
  return judge_each(records, kSmopt, ratio, [](double value) { return value <= 1; });
}

Evidence check_seconds(const RecordSet& records) {
  return not_slower_than_the_paper(records, kCheck, "cpu_s_manifold_and_cavities");
}

Evidence smoothing_seconds(const RecordSet& records) {
  return not_slower_than_the_paper(records, kSmoothing, "cpu_s_redundant_points_and_smoothing");
}

struct Point {
  double x, y;
};

/// Of the straight line with the least squares. \pre not all x are the same
double slope_of(const std::vector<Point>& points) {
  Point mean{0, 0};
  for (const Point& p : points)
    mean = {mean.x + p.x / static_cast<double>(points.size()), mean.y + p.y / static_cast<double>(points.size())};
  double above = 0, below = 0;
  for (const Point& p : points) {
    above += (p.x - mean.x) * (p.y - mean.y);
    below += (p.x - mean.x) * (p.x - mean.x);
  }
  return above / below;
}

/// The e of seconds ~ vertices^e; nothing where the molecules are too few or too much alike.
std::optional<double> exponent(const RecordSet& records, const Stages& stages) {
  std::vector<Point> points;
  for (const MoleculeRow& row : molecule_rows(records)) {
    const auto vertices = number_of(row, kInitial, "/metrics/after/vertices"), seconds = seconds_of(row, stages);
    if (vertices && seconds && *vertices > 0 && *seconds > 0) points.push_back({std::log(*vertices), std::log(*seconds)});
  }
  if (points.size() < kLeastMolecules) return std::nullopt;
  const auto [least, most] = std::minmax_element(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
  return most->x - least->x < std::log(kLeastSpan) ? std::nullopt : std::optional(slope_of(points));
}

Evidence judge_exponent(const RecordSet& records, const Stages& stages, bool expects_linear) {
  const auto e = exponent(records, stages);
  if (!e) return {};
  return {(*e <= kLinearExponent) == expects_linear ? ClaimVerdict::holds : ClaimVerdict::does_not_hold,
          fmt::format("seconds grow as vertices to the power of {:.2f}", *e)};
}

Evidence smoothing_is_linear(const RecordSet& records) {
  return judge_exponent(records, kSmoothing, true);
}

Evidence check_is_not_linear(const RecordSet& records) {
  return judge_exponent(records, kCheck, false);
}

Evidence smoothing_dominates(const RecordSet& records) {
  const auto share = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto check = seconds_of(row, kCheck), smoothing = seconds_of(row, kSmoothing);
    if (!check || !smoothing || *check + *smoothing <= 0) return std::nullopt;
    return Finding{*smoothing / (*check + *smoothing), percent_finding(*smoothing / (*check + *smoothing), 0).text};
  };
  return judge_each(records, kSmopt, share, [](double value) { return value > 0.5; });
}

/// How many vertices were looked at in each round.
std::vector<double> active_vertices(const MoleculeRow& row) {
  std::vector<double> active;
  const Json* const record = row.record(kSmopt);
  if (!record->contains("each_round")) return active;
  for (const Json& round : record->at("each_round")) active.push_back(number_at(&round, "/active").value_or(0));
  return active;
}

Evidence screening(const RecordSet& records) {
  const auto share = [](const MoleculeRow& row) -> std::optional<Finding> {
    const std::vector<double> active = active_vertices(row);
    if (active.size() < 2 || active.front() <= 0) return std::nullopt;
    double sum = 0;
    for (const double count : active) sum += count;
    const double part = sum / (active.front() * static_cast<double>(active.size()));
    return Finding{part, fmt::format("{} of what {} full rounds are", percent_finding(part, 1).text, active.size())};
  };
  return judge_each(records, kSmopt, share, [](double value) { return value <= kGreatlyReduced; });
}

Evidence fewer_and_fewer(const RecordSet& records) {
  const auto growth = [](const MoleculeRow& row) -> std::optional<Finding> {
    const std::vector<double> active = active_vertices(row);
    if (active.size() < 2) return std::nullopt;
    double largest = 0;
    for (std::size_t i = 1; i < active.size(); ++i) largest = std::max(largest, active[i] - active[i - 1]);
    return Finding{largest, fmt::format("{:.0f} → {:.0f}{}", active.front(), active.back(),
                                        largest > 0 ? fmt::format(", once {:.0f} more than before", largest) : "")};
  };
  return judge_each(records, kSmopt, growth, [](double value) { return value <= 0; });
}

Evidence converges(const RecordSet& records) {
  const auto share = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto rounds = number_of(row, kSmopt, "/rounds"), most = number_of(row, kSmopt, "/options/rounds");
    if (!rounds || !most || *most <= 0) return std::nullopt;
    return Finding{*rounds / *most, fmt::format("{:.0f} rounds", *rounds)};
  };
  return judge_each(records, kSmopt, share, [](double value) { return value < 1; });
}

Evidence halving_always_ends(const RecordSet& records) {
  const auto refused = [](const MoleculeRow& row) -> std::optional<Finding> {
    const auto accepted = number_of(row, kSmopt, "/moves/accepted"), count = number_of(row, kSmopt, "/moves/refused");
    if (!accepted || !count) return std::nullopt;
    return Finding{*count, fmt::format("{:.0f} of {:.0f} moves refused", *count, *accepted + *count)};
  };
  return judge_each(records, kSmopt, refused, [](double value) { return value == 0; });
}

}  // namespace

std::vector<Predicate> cost_predicates() {
  return {{"check-seconds", check_seconds},
          {"smoothing-seconds", smoothing_seconds},
          {"smoothing-is-linear", smoothing_is_linear},
          {"check-is-not-linear", check_is_not_linear},
          {"smoothing-dominates", smoothing_dominates},
          {"screening", screening},
          {"fewer-and-fewer", fewer_and_fewer},
          {"converges", converges},
          {"halving-always-ends", halving_always_ends}};
}

}  // namespace smopt::experiments
