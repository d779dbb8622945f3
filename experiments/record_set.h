#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace smopt::experiments {

/// The records of a run: all that tables and figures know.
class RecordSet {
 public:
  using Json = nlohmann::ordered_json;

  /// Reads `directory`/records/<molecule>/<method>.json. \throws InvalidInput naming the file when there is none or one is no record of the
  /// schema that this program writes.
  static RecordSet load(const std::filesystem::path& directory);

  /// Adds a record, in place of one of the same case. \throws InvalidInput naming `source` when it is none.
  void add(Json record, const std::string& source);

  /// The records of these molecules, as far as there are any.
  [[nodiscard]] RecordSet of_molecules(const std::vector<std::string>& names) const;

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] bool has(std::string_view molecule) const { return records_.contains(molecule); }

  /// Names in the order in which tables and figures show them: the paper's molecules, the others of datasets.json, then by name; methods: initial, as in
  /// methods.json, then by name.
  [[nodiscard]] std::vector<std::string> molecules() const;
  [[nodiscard]] std::vector<std::string> methods() const;

  /// The record of a case, or null when there is none.
  [[nodiscard]] const Json* find(std::string_view molecule, std::string_view method) const;
  /// Any record of the molecule. \pre there is one
  [[nodiscard]] const Json& any_of(std::string_view molecule) const;

 private:
  std::map<std::string, std::map<std::string, Json, std::less<>>, std::less<>> records_;
};

/// The methods of the records that belong beside the paper's in its tables and figures: the initial mesh, and the cases that methods.json
/// says so of.
std::vector<std::string> paper_methods(const RecordSet& records);

/// How tables and figures call a case, "SMOPT" for `smopt`: as its records say, or methods.json where there is none.
std::string method_title(const RecordSet& records, std::string_view method);

/// Whether there is a record and its case ended well.
bool is_done(const nlohmann::ordered_json* record);

/// The value at a JSON pointer ("/metrics/after/area") of a record; nothing when there is no record, no such key, or it is null or of
/// another kind.
std::optional<double> number_at(const nlohmann::ordered_json* record, const std::string& pointer);
std::optional<std::string> text_at(const nlohmann::ordered_json* record, const std::string& pointer);

}  // namespace smopt::experiments
