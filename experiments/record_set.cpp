#include "experiments/record_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "experiments/datasets.h"
#include "experiments/method_cases.h"
#include "experiments/record.h"
#include "smopt/error.h"
#include "smopt/io/file.h"

namespace smopt::experiments {
namespace {

namespace fs = std::filesystem;

/// The names of `first` that are among `names`, in that order, then the others by name.
std::vector<std::string> ordered(std::set<std::string> names, const std::vector<std::string>& first) {
  std::vector<std::string> result;
  for (const std::string& name : first)
    if (names.erase(name) > 0) result.push_back(name);
  result.insert(result.end(), names.begin(), names.end());
  return result;
}

/// Sorted, so that the first fault that is told is always the same.
std::vector<fs::path> record_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, missing))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

const nlohmann::ordered_json* at(const nlohmann::ordered_json* record, const std::string& pointer) {
  const nlohmann::ordered_json::json_pointer path(pointer);
  return record != nullptr && record->contains(path) ? &record->at(path) : nullptr;
}

}  // namespace

RecordSet RecordSet::load(const fs::path& directory) {
  RecordSet records;
  const std::vector<fs::path> files = record_files(directory / "records");
  if (files.empty()) throw InvalidInput(fmt::format("{}: no records", (directory / "records").string()));
  for (const fs::path& file : files) {
    const Json record = Json::parse(read_file(file), nullptr, false);
    if (record.is_discarded()) throw InvalidInput(fmt::format("{}: not JSON", file.string()));
    records.add(record, file.string());
  }
  return records;
}

void RecordSet::add(Json record, const std::string& source) {
  const auto molecule = text_at(&record, "/molecule/name");
  const auto method = text_at(&record, "/method");
  if (!molecule || !method || !text_at(&record, "/status")) throw InvalidInput(fmt::format("{}: not the record of a case", source));
  const auto schema = number_at(&record, "/schema_version");
  if (schema != static_cast<double>(kRecordSchema))
    throw InvalidInput(fmt::format("{}: records of schema {} are needed; run the experiments again", source, kRecordSchema));
  records_[*molecule].insert_or_assign(*method, std::move(record));
}

RecordSet RecordSet::of_molecules(const std::vector<std::string>& names) const {
  RecordSet some;
  for (const std::string& name : names)
    if (const auto found = records_.find(name); found != records_.end()) some.records_.insert(*found);
  return some;
}

std::size_t RecordSet::size() const {
  std::size_t size = 0;
  for (const auto& [name, methods] : records_) size += methods.size();
  return size;
}

std::vector<std::string> RecordSet::molecules() const {
  std::set<std::string> names;
  for (const auto& [name, methods] : records_) names.insert(name);
  std::vector<std::string> first;
  for (const bool is_of_paper : {true, false})
    for (const Dataset& dataset : all_datasets())
      if (dataset.paper_row.has_value() == is_of_paper) first.push_back(dataset.name);
  return ordered(std::move(names), first);
}

std::vector<std::string> RecordSet::methods() const {
  std::set<std::string> names;
  for (const auto& [molecule, methods] : records_)
    for (const auto& [name, record] : methods) names.insert(name);
  std::vector<std::string> first = {std::string(kInitial)};
  for (const MethodCase& method : all_method_cases()) first.push_back(method.name);
  return ordered(std::move(names), first);
}

const RecordSet::Json* RecordSet::find(std::string_view molecule, std::string_view method) const {
  const auto methods = records_.find(molecule);
  if (methods == records_.end()) return nullptr;
  const auto record = methods->second.find(method);
  return record == methods->second.end() ? nullptr : &record->second;
}

const RecordSet::Json& RecordSet::any_of(std::string_view molecule) const {
  return records_.find(molecule)->second.begin()->second;
}

std::vector<std::string> paper_methods(const RecordSet& records) {
  std::vector<std::string> methods = records.methods();
  std::erase_if(methods, [](const std::string& name) { return name != kInitial && !find_method_case(name).is_in_paper_tables; });
  return methods;
}

std::string method_title(const RecordSet& records, std::string_view method) {
  for (const std::string& molecule : records.molecules())
    if (const auto title = text_at(records.find(molecule, method), "/method_title")) return *title;
  return find_method_case(method).title;
}

bool is_done(const nlohmann::ordered_json* record) {
  return text_at(record, "/status") == "done";
}

std::optional<double> number_at(const nlohmann::ordered_json* record, const std::string& pointer) {
  const auto* const value = at(record, pointer);
  return value != nullptr && value->is_number() ? std::optional(value->get<double>()) : std::nullopt;
}

std::optional<std::string> text_at(const nlohmann::ordered_json* record, const std::string& pointer) {
  const auto* const value = at(record, pointer);
  return value != nullptr && value->is_string() ? std::optional(value->get<std::string>()) : std::nullopt;
}

}  // namespace smopt::experiments
