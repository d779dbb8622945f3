#include "experiments/ablation/quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace smopt::experiments {
namespace {

using Json = RecordSet::Json;

constexpr double kPerCent = 100;

/// Anything: a pair is a pair.
constexpr double kOnePair = 1;
/// Shares, angles and changes as the tables show them, a few of the last digit.
constexpr double kNoticeableDegrees = 0.1;
constexpr double kNoticeablePercent = 0.05;
/// Of times: what repeats on a busy machine may differ by; of moves, which do not differ: a tenth.
constexpr double kNoticeableTimeFactor = 1.5;
constexpr double kNoticeableMovesFactor = 1.1;

/// A metric of the mesh, times a factor.
Quantity metric(Quantity quantity, const std::string& pointer, double factor) {
  const auto scaled = [factor](std::optional<double> value) { return value ? std::optional(factor * *value) : std::nullopt; };
  quantity.of_case = [=](const Json& record, const Json*) { return scaled(number_at(&record, "/metrics/after" + pointer)); };
  quantity.of_given = [=](const Json& given) { return scaled(number_at(&given, pointer)); };
  return quantity;
}

/// The change of a metric in per cent of the given mesh's.
Quantity change(Quantity quantity, const std::string& pointer) {
  quantity.of_case = [pointer](const Json& record, const Json* given) -> std::optional<double> {
    const auto before = number_at(given, pointer), after = number_at(&record, "/metrics/after" + pointer);
    if (!before || !after || *before == 0) return std::nullopt;
    return kPerCent * (*after / *before - 1);
  };
  quantity.of_given = [pointer](const Json& given) { return number_at(&given, pointer) ? std::optional(0.0) : std::nullopt; };
  return quantity;
}

/// What is known of a case only.
Quantity of_run(Quantity quantity, std::function<std::optional<double>(const Json&)> value) {
  quantity.of_case = [value = std::move(value)](const Json& record, const Json*) { return value(record); };
  quantity.of_given = [](const Json&) { return std::nullopt; };
  return quantity;
}

/// Of all that the method does to a mesh that has been read.
std::optional<double> cpu_seconds(const Json& record) {
  if (!number_at(&record, "/cpu_seconds/smoothing")) return std::nullopt;
  double sum = 0;
  for (const char* stage : {"validity", "cavities", "redundant", "smoothing"})
    sum += number_at(&record, std::string("/cpu_seconds/") + stage).value_or(0);
  return sum;
}

std::vector<Quantity> make_quantities() {
  using enum QuantityScale;
  return {
      metric({"intersecting_pairs", "Intersecting pairs", "intersecting pairs", "", 0, symmetric, 1, kOnePair, {}, {}},
             "/intersecting_pairs", 1),
      metric({"min_angle_deg", "Smallest angle (°)", "the smallest angle", "°", 2, linear, 1, kNoticeableDegrees, {}, {}}, "/angle_deg/min",
             1),
      metric({"below_10_percent",
              "Triangles below 10° (%)",
              "the triangles with an angle below 10°",
              " %",
              2,
              symmetric,
              0.1,
              kNoticeablePercent,
              {},
              {}},
             "/min_angle_share/below_10", kPerCent),
      metric({"below_20_percent",
              "Triangles below 20° (%)",
              "the triangles with an angle below 20°",
              " %",
              2,
              symmetric,
              1,
              kNoticeablePercent,
              {},
              {}},
             "/min_angle_share/below_20", kPerCent),
      change({"volume_change_percent", "Volume change (%)", "the change of the volume", " %", 2, symmetric, 1, kNoticeablePercent, {}, {}},
             "/volume"),
      change({"area_change_percent", "Area change (%)", "the change of the area", " %", 2, symmetric, 10, kNoticeablePercent, {}, {}},
             "/area"),
      of_run({"cpu_s", "CPU time (s)", "processor time", " s", 3, logarithmic, 1, kNoticeableTimeFactor, {}, {}}, cpu_seconds),
      of_run({"moves", "Moves", "moves", "", 0, logarithmic, 1, kNoticeableMovesFactor, {}, {}},
             [](const Json& record) { return number_at(&record, "/moves/accepted"); }),
  };
}

}  // namespace

std::string_view to_string(QuantityScale scale) {
  switch (scale) {
    case QuantityScale::linear:
      return "linear";
    case QuantityScale::symmetric:
      return "symmetric";
    case QuantityScale::logarithmic:
      break;
  }
  return "logarithmic";
}

const std::vector<Quantity>& ablation_quantities() {
  static const std::vector<Quantity> quantities = make_quantities();
  return quantities;
}

const Quantity& find_quantity(std::string_view id) {
  const std::vector<Quantity>& all = ablation_quantities();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Quantity& quantity) { return quantity.id == id; });
  if (found == all.end()) throw std::out_of_range(fmt::format("no quantity {}", id));
  return *found;
}

double change_size(const Quantity& quantity, double value, double reference) {
  if (quantity.scale != QuantityScale::logarithmic) return std::abs(value - reference) / quantity.noticeable;
  if (value == reference) return 0;
  if (!(value > 0 && reference > 0)) return HUGE_VAL;
  return std::abs(std::log(value / reference)) / std::log(quantity.noticeable);
}

bool is_noticeable(const Quantity& quantity, double value, double reference) {
  return change_size(quantity, value, reference) >= 1;
}

double rounded(double value, int decimals) {
  constexpr int kBase = 10;
  const double scale = std::pow(kBase, decimals);
  return std::round(value * scale) / scale + 0.0;
}

int mean_decimals(const Quantity& quantity) {
  return std::max(quantity.decimals, 1);
}

std::string mean_in_words(const Quantity& quantity, double mean) {
  return fmt::format("{:.{}f}{}", rounded(mean, mean_decimals(quantity)), mean_decimals(quantity), quantity.unit);
}

std::string in_words(const Quantity& quantity, const std::optional<double>& value) {
  return value ? fmt::format("{:.{}f}{}", rounded(*value, quantity.decimals), quantity.decimals, quantity.unit) : "none";
}

}  // namespace smopt::experiments
