#include "experiments/page/page_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "experiments/datasets.h"
#include "experiments/record.h"
#include "experiments/tables/methods_table.h"
#include "experiments/tables/table1.h"
#include "experiments/tables/table2.h"
#include "experiments/tables/table3.h"

namespace smopt::experiments {
namespace {

/// What of a record the page shows.
constexpr std::array kCaseKeys = {"status",      "reason",          "method_title", "metrics", "level_set_distance",
                                  "cpu_seconds", "tetgen",          "solvation",    "notes",   "diverged_at_step",
                                  "threads",     "stopped_because", "removed",      "rounds",  "peak_memory_mb"};
/// What it does not show of them.
constexpr std::array kLeftOut = {"/metrics/before/edge_ratio/histogram", "/metrics/before/angle_deg/histogram", "/solvation/options",
                                 "/solvation/degenerate_vertex_ids"};

struct CellJson {
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(const std::string& text) const { return text; }
  Json operator()(long count) const { return count; }
  Json operator()(const Decimal& number) const { return Json::array({number.value, number.decimals}); }
};

void erase_at(Json& json, const std::string& pointer) {
  const Json::json_pointer place(pointer);
  if (json.contains(place)) json.at(place.parent_pointer()).erase(place.back());
}

Json case_json(const Json& record) {
  Json result;
  for (const char* key : kCaseKeys)
    if (record.contains(key)) result[key] = record.at(key);
  for (const char* pointer : kLeftOut) erase_at(result, pointer);
  return result;
}

Json molecule_json(const RecordSet& records, const std::string& name) {
  Json molecule = records.any_of(name).at("molecule");
  molecule["title"] = labelled_title(molecule.value("title", name), molecule.value("role", ""));
  return molecule;
}

Json molecules_json(const RecordSet& records) {
  Json result = Json::array();
  for (const std::string& name : records.molecules()) result.push_back(molecule_json(records, name));
  return result;
}

Json methods_json(const RecordSet& records) {
  const std::vector<std::string> in_paper = paper_methods(records);
  Json result = Json::array();
  for (const std::string& name : records.methods())
    result.push_back({{"name", name}, {"title", method_title(records, name)}, {"in_paper", std::ranges::count(in_paper, name) > 0}});
  return result;
}

/// Calls `visit` with every record, molecule by molecule.
template <typename Visitor>
void for_each_record(const RecordSet& records, Visitor visit) {
  for (const std::string& molecule : records.molecules()) {
    for (const std::string& method : records.methods())
      if (const Json* record = records.find(molecule, method)) visit(molecule, method, *record);
  }
}

Json cases_json(const RecordSet& records) {
  Json result = Json::object();
  for_each_record(records, [&](const std::string& molecule, const std::string& method, const Json& record) {
    result[molecule][method] = case_json(record);
  });
  return result;
}

std::string machine_text(const Json& machine) {
  if (!machine.is_object()) return machine.dump();
  std::vector<std::string> parts;
  if (machine.contains("cpu") && machine.at("cpu").is_string()) parts.push_back(machine.at("cpu").get<std::string>());
  if (machine.contains("cores") && machine.at("cores").is_number())
    parts.push_back(fmt::format("{} cores", machine.at("cores").get<int>()));
  if (machine.contains("memory_mb") && machine.at("memory_mb").is_number())
    parts.push_back(fmt::format("{:.0f} GiB", machine.at("memory_mb").get<double>() / 1024));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string provenance_text(const std::string& key, const Json& value) {
  if (key == "machine") return machine_text(value);
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// The different values of a run whose records were not all made in one go.
Json provenance_json(const RecordSet& records) {
  Json result = {{"version", Json::array()}, {"compiler", Json::array()}, {"machine", Json::array()}, {"threads", Json::array()}};
  for_each_record(records, [&](const std::string&, const std::string&, const Json& record) {
    for (auto& [key, values] : result.items()) {
      if (!record.contains(key) || record.at(key).is_null()) continue;
      Json text = provenance_text(key, record.at(key));
      if (std::ranges::find(values, text) == values.end()) values.push_back(std::move(text));
    }
  });
  return result;
}

}  // namespace

Json table_json(const Table& table) {
  Json columns = Json::array();
  for (const Column& column : table.columns) columns.push_back({{"id", column.id}, {"title", column.title}});
  Json rows = Json::array();
  for (const std::vector<Cell>& row : table.rows) {
    Json cells = Json::array();
    for (const Cell& cell : row) cells.push_back(std::visit(CellJson{}, cell));
    rows.push_back(std::move(cells));
  }
  return {{"name", table.name}, {"caption", table.caption}, {"columns", columns}, {"rows", rows}, {"notes", table.notes}};
}

Json page_data(const RecordSet& records, const std::string& run_name) {
  Json tables = Json::array();
  for (const Table& table : {table1(records), table2(records), table3(records), methods_table(records)})
    tables.push_back(table_json(table));
  return {{"name", run_name},
          {"provenance", provenance_json(records)},
          {"tables", std::move(tables)},
          {"molecules", molecules_json(records)},
          {"methods", methods_json(records)},
          {"cases", cases_json(records)}};
}

}  // namespace smopt::experiments
