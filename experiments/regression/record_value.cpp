#include "experiments/regression/record_value.h"

#include <fmt/format.h>

namespace smopt::experiments {
namespace {

using Json = RecordSet::Json;

constexpr double kPerCent = 100;

RecordValue value_at(const Json& record, const std::string& pointer) {
  const Json::json_pointer path(pointer);
  if (!record.contains(path)) return {};
  const Json& value = record.at(path);
  if (value.is_boolean()) return value.get<bool>() ? 1.0 : 0.0;
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) return value.get<std::string>();
  return {};
}

}  // namespace

RecordValue value_of(const Json& record, const Tolerance& tolerance) {
  const RecordValue value = value_at(record, tolerance.pointer);
  if (tolerance.change_from.empty()) return value;
  const auto before = number_at(&record, tolerance.change_from);
  const double* const after = std::get_if<double>(&value);
  if (!before || *before == 0 || after == nullptr) return {};
  return *after / *before - 1;
}

std::string text_of(const RecordValue& value, const std::string& unit) {
  if (const auto* const word = std::get_if<std::string>(&value)) return *word;
  if (std::holds_alternative<std::monostate>(value)) return "nothing";
  const double number = std::get<double>(value);
  if (unit == "yes/no") return number != 0 ? "yes" : "no";
  if (unit == "share") return fmt::format("{:.4g} %", kPerCent * number);
  if (unit == "change") return fmt::format("{:+.4g} %", kPerCent * number);
  if (unit == "count") return fmt::format("{:.0f}", number);
  return fmt::format("{:.6g}{}", number, unit == "1" ? "" : unit == "°" ? unit : " " + unit);
}

}  // namespace smopt::experiments
