#include "experiments/tables/markdown.h"

#include <fmt/format.h>

#include <algorithm>

namespace smopt::experiments {
namespace {

using Row = std::vector<std::string>;

/// A bar would end the cell, a line break the row.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result;
}

/// Characters of a UTF-8 text: bytes that do not continue one.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::vector<Row> texts_of(const Table& table) {
  std::vector<Row> rows(1);
  for (const Column& column : table.columns) rows.front().push_back(escaped(column.title));
  for (const std::vector<Cell>& cells : table.rows) {
    Row& row = rows.emplace_back();
    for (const Cell& cell : cells) row.push_back(escaped(cell_text(cell, "—")));
  }
  return rows;
}

std::vector<std::size_t> widths_of(const std::vector<Row>& rows) {
  constexpr std::size_t kLeast = 3;  // a rule of a column has at least three characters
  std::vector<std::size_t> widths(rows.front().size(), kLeast);
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  return widths;
}

/// Columns with text are set flush left, those of numbers flush right.
std::vector<bool> text_columns(const Table& table) {
  std::vector<bool> result(table.columns.size());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = std::any_of(table.rows.begin(), table.rows.end(), [i](const auto& row) { return is_text(row[i]); });
  return result;
}

std::string line_of(const Row& row, const std::vector<std::size_t>& widths, const std::vector<bool>& is_left) {
  std::string line = "|";
  for (std::size_t i = 0; i < row.size(); ++i) {
    const std::string padding(widths[i] - width(row[i]), ' ');
    line += is_left[i] ? fmt::format(" {}{} |", row[i], padding) : fmt::format(" {}{} |", padding, row[i]);
  }
  return line + "\n";
}

std::string rule_of(const std::vector<std::size_t>& widths, const std::vector<bool>& is_left) {
  std::string line = "|";
  for (std::size_t i = 0; i < widths.size(); ++i)
    line += is_left[i] ? " " + std::string(widths[i], '-') + " |" : " " + std::string(widths[i] - 1, '-') + ": |";
  return line + "\n";
}

}  // namespace

std::string to_markdown(const Table& table) {
  const std::vector<Row> rows = texts_of(table);
  const std::vector<std::size_t> widths = widths_of(rows);
  const std::vector<bool> is_left = text_columns(table);
  std::string text = fmt::format("**{}**\n\n", table.caption);
  text += line_of(rows.front(), widths, is_left) + rule_of(widths, is_left);
  for (std::size_t i = 1; i < rows.size(); ++i) text += line_of(rows[i], widths, is_left);
  for (const std::string& note : table.notes) text += fmt::format("\n{}\n", note);
  return text;
}

}  // namespace smopt::experiments
