#include "experiments/tables/molecule_table.h"

#include <fmt/format.h>

#include <charconv>

#include "experiments/datasets.h"
#include "experiments/method_cases.h"
#include "experiments/paper_table.h"

namespace smopt::experiments {
namespace {

template <class Number>
std::optional<Number> parsed(const std::string& text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// As printed: a number with as many decimals as it has there, anything else as text.
Cell printed_cell(const std::string& text) {
  if (text == "nan") return "NaN";
  if (const auto count = parsed<long>(text)) return *count;
  const std::size_t point = text.find('.');
  const auto number = parsed<double>(text);
  if (!number || point == std::string::npos || text.find('e') != std::string::npos) return text;
  return Decimal{*number, static_cast<int>(text.size() - point - 1)};
}

/// "Molecules that are called a stand-in …" for the roles that stand for a molecule of the paper without being it.
std::vector<std::string> stand_ins(const RecordSet& records) {
  std::vector<std::string> sentences;
  for (const MoleculeRow& row : molecule_rows(records)) {
    const RecordSet::Json& record = records.any_of(row.name);
    const auto role = text_at(&record, "/molecule/role");
    if (role != to_string(Role::stand_in) && role != to_string(Role::near_copy)) continue;
    sentences.push_back(fmt::format("{}: {}.", row.title, text_at(&record, "/molecule/about").value_or("another molecule")));
  }
  return sentences;
}

/// "hca-coarse: SMOPT (guard=none)": cases of other options than their names stand for.
std::vector<std::string> overridden(const RecordSet& records) {
  std::vector<std::string> sentences;
  for (const MoleculeRow& row : molecule_rows(records)) {
    for (const MethodCase& method_case : all_method_cases()) {
      const auto title = text_at(row.record(method_case.name), "/method_title");
      if (title && *title != method_case.title)
        sentences.push_back(fmt::format("{}: {} in place of {}.", row.title, *title, method_case.title));
    }
  }
  return sentences;
}

}  // namespace

std::vector<MoleculeRow> molecule_rows(const RecordSet& records) {
  std::vector<MoleculeRow> rows;
  for (const std::string& name : records.molecules()) {
    const RecordSet::Json& record = records.any_of(name);
    const std::string title = text_at(&record, "/molecule/title").value_or(name);
    rows.push_back(
        {&records, name, labelled_title(title, text_at(&record, "/molecule/role").value_or("")), text_at(&record, "/molecule/paper_row")});
  }
  return rows;
}

Table molecule_table(const RecordSet& records, std::string name, std::string caption, const std::vector<MoleculeColumn>& columns) {
  Table table{std::move(name), std::move(caption), {{"molecule", "Molecule"}}, {}, common_notes(records)};
  for (const MoleculeColumn& column : columns) table.columns.push_back(column.head);
  for (const MoleculeRow& row : molecule_rows(records)) {
    std::vector<Cell>& cells = table.rows.emplace_back();
    cells.emplace_back(row.title);
    for (const MoleculeColumn& column : columns) cells.push_back(column.cell(row));
  }
  return table;
}

MoleculeColumn paper_column(int number, const std::string& paper_id, std::string title) {
  return {{"paper_" + paper_id, std::move(title)}, [number, paper_id](const MoleculeRow& row) {
            const auto text = paper_table(number).value(row.paper_row, paper_id);
            return text ? printed_cell(*text) : Cell();
          }};
}

Cell count_of(const RecordSet::Json* record, const std::string& pointer) {
  return is_done(record) ? count_cell(number_at(record, pointer)) : Cell();
}

Cell count_or_reason(const RecordSet::Json* record, const std::string& pointer) {
  if (record == nullptr) return "not run";
  if (text_at(record, "/status") == "not installed") return "not installed";
  if (!is_done(record)) return "failed: " + text_at(record, "/reason").value_or("no reason given");
  return count_cell(number_at(record, pointer));
}

std::vector<std::string> common_notes(const RecordSet& records) {
  std::vector<std::string> notes = overridden(records);
  for (std::string& note : stand_ins(records)) notes.push_back(std::move(note));
  notes.push_back(
      "\"paper\" is Liu et al., PLoS ONE 12(9): e0184206, 2017, as printed there; \"—\" where the paper has no such molecule or there is "
      "no "
      "such number.");
  return notes;
}

}  // namespace smopt::experiments
