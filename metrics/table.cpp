#include "metrics/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "metrics/registry.h"

namespace smopt::metrics {
namespace {

/// A heading or a metric, the meshes' values, each as text.
using Row = std::vector<std::string>;

constexpr int kSignificantDigits = 6;  ///< enough to tell volumes of neighbouring meshes apart, few enough to read

std::string cell(const Metric& metric, const Measurement& measurement) {
  const std::optional<double> value = metric.value(measurement);
  if (!value) return "–";
  if (metric.unit == "yes/no") return *value != 0 ? "yes" : "no";
  if (metric.unit == "count" || metric.name == "euler_characteristic") return fmt::format("{:.0f}", *value);
  return fmt::format("{:.{}g}", *value, kSignificantDigits);
}

std::string heading(const Metric& metric) {
  const bool plain = metric.unit == "count" || metric.unit == "1" || metric.unit == "yes/no";
  return plain ? std::string(metric.title) : fmt::format("{} [{}]", metric.title, metric.unit);
}

bool is_shown(const Metric& metric, std::span<const NamedMeasurement> meshes) {
  if (!metric.name.starts_with("distance.")) return true;
  return std::any_of(meshes.begin(), meshes.end(), [](const NamedMeasurement& m) { return m.measurement.distance.has_value(); });
}

std::vector<Row> rows_of(std::span<const NamedMeasurement> meshes) {
  std::vector<Row> rows = {{""}};
  for (const NamedMeasurement& mesh : meshes) rows.front().push_back(mesh.name);
  for (const Metric& metric : metric_registry()) {
    if (!is_shown(metric, meshes)) continue;
    Row& row = rows.emplace_back(Row{heading(metric)});
    for (const NamedMeasurement& mesh : meshes) row.push_back(cell(metric, mesh.measurement));
  }
  return rows;
}

/// Characters on the screen: the bytes of UTF-8 that do not continue a character.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::vector<std::size_t> column_widths(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  return widths;
}

std::string line_of(const Row& row, const std::vector<std::size_t>& widths) {
  std::string line = row.front() + std::string(widths.front() - width_of(row.front()), ' ');
  for (std::size_t i = 1; i < row.size(); ++i) line += std::string(2 + widths[i] - width_of(row[i]), ' ') + row[i];
  return line + "\n";
}

}  // namespace

std::string format_table(std::span<const NamedMeasurement> meshes) {
  const std::vector<Row> rows = rows_of(meshes);
  const std::vector<std::size_t> widths = column_widths(rows);
  std::string text;
  for (const Row& row : rows) text += line_of(row, widths);
  for (const NamedMeasurement& mesh : meshes)
    for (const std::string& note : mesh.measurement.notes) text += fmt::format("{}: {}\n", mesh.name, note);
  return text;
}

}  // namespace smopt::metrics
