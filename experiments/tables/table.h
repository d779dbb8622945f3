#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace smopt::experiments {

/// A number and how many decimals of it are shown.
struct Decimal {
  double value = 0;
  int decimals = 0;
};

/// What stands in a table's cell: nothing (shown as a dash), text, or a number.
using Cell = std::variant<std::monostate, std::string, long, Decimal>;

struct Column {
  std::string id;     ///< the column's name in comma-separated values, with the unit
  std::string title;  ///< its head elsewhere
};

/// A table, before it is written in one form or another.
struct Table {
  std::string name;     ///< file name without ending, and label: "table1"
  std::string caption;  ///< one sentence
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;  ///< as many cells as there are columns
  std::vector<std::string> notes;       ///< sentences below the table
};

/// The cell's text; `missing` when there is nothing in it.
std::string cell_text(const Cell& cell, const std::string& missing);

/// Whether the cell is text, which is set flush left.
bool is_text(const Cell& cell);

/// A cell with the number rounded to `decimals`, or with nothing.
Cell decimal_cell(const std::optional<double>& value, int decimals);
Cell count_cell(const std::optional<double>& value);
Cell text_cell(const std::optional<std::string>& value);

}  // namespace smopt::experiments
