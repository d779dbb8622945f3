#include "experiments/paper_table.h"

#include <fmt/format.h>

#include <array>

#include "experiments/embedded.h"
#include "smopt/error.h"

namespace smopt::experiments {
namespace {

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

}  // namespace

PaperTable::PaperTable(std::string_view csv) {
  std::size_t line_number = 0;
  for (const std::string& line : split(csv, '\n')) {
    ++line_number;
    if (line.empty()) continue;
    const std::vector<std::string> cells = split(line, ',');
    if (line_number == 1) {
      for (std::size_t i = 0; i < cells.size(); ++i) columns_[cells[i]] = i;
    } else if (cells.size() != columns_.size()) {
      throw InvalidInput(fmt::format("paper's table, line {}: {} cells, expected {}", line_number, cells.size(), columns_.size()));
    } else {
      rows_[cells.front()] = cells;
    }
  }
}

std::optional<std::string> PaperTable::value(const std::optional<std::string>& row, const std::string& column) const {
  const auto at = columns_.find(column);
  if (at == columns_.end()) throw InvalidOption(fmt::format("the paper's table has no column '{}'", column));
  const auto cells = row ? rows_.find(*row) : rows_.end();
  return cells == rows_.end() ? std::nullopt : std::optional(cells->second[at->second]);
}

const PaperTable& paper_table(int number) {
  static const std::array<PaperTable, 3> tables = {PaperTable(embedded::paper_table1()), PaperTable(embedded::paper_table2()),
                                                   PaperTable(embedded::paper_table3())};
  return tables.at(static_cast<std::size_t>(number - 1));
}

}  // namespace smopt::experiments
