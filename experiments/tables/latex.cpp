#include "experiments/tables/latex.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace smopt::experiments {
namespace {

/// What stands for something else in LaTeX, and characters that its old fonts lack.
constexpr std::array<std::pair<std::string_view, std::string_view>, 16> kEscapes = {{{"\\", "\\textbackslash{}"},
                                                                                     {"&", "\\&"},
                                                                                     {"%", "\\%"},
                                                                                     {"$", "\\$"},
                                                                                     {"#", "\\#"},
                                                                                     {"_", "\\_"},
                                                                                     {"{", "\\{"},
                                                                                     {"}", "\\}"},
                                                                                     {"~", "\\textasciitilde{}"},
                                                                                     {"^", "\\textasciicircum{}"},
                                                                                     {"—", "---"},
                                                                                     {"–", "--"},
                                                                                     {"×", "$\\times$"},
                                                                                     {"°", "$^\\circ$"},
                                                                                     {"Å", "\\AA{}"},
                                                                                     {"\n", " "}}};

std::string escaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto* const found =
        std::find_if(kEscapes.begin(), kEscapes.end(), [&](const auto& escape) { return text.starts_with(escape.first); });
    if (found == kEscapes.end()) {
      result += text.front();
      text.remove_prefix(1);
    } else {
      result += found->second;
      text.remove_prefix(found->first.size());
    }
  }
  return result;
}

std::string alignment(const Table& table) {
  std::string letters;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    letters += std::any_of(table.rows.begin(), table.rows.end(), [i](const auto& row) { return is_text(row[i]); }) ? 'l' : 'r';
  return letters;
}

std::string line_of(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += (line.empty() ? "" : " & ") + cell;
  return line + " \\\\\n";
}

}  // namespace

std::string to_latex(const Table& table) {
  std::vector<std::string> heads;
  for (const Column& column : table.columns) heads.push_back(escaped(column.title));
  std::string text = fmt::format("\\begin{{table}}\n\\centering\n\\caption{{{}}}\n\\label{{tab:{}}}\n", escaped(table.caption), table.name);
  text += fmt::format("\\resizebox{{\\textwidth}}{{!}}{{%\n\\begin{{tabular}}{{{}}}\n\\toprule\n", alignment(table));
  text += line_of(heads) + "\\midrule\n";
  for (const std::vector<Cell>& row : table.rows) {
    std::vector<std::string> cells;
    for (const Cell& cell : row) cells.push_back(escaped(cell_text(cell, "—")));
    text += line_of(cells);
  }
  text += "\\bottomrule\n\\end{tabular}}\n";
  for (const std::string& note : table.notes) text += fmt::format("\\par\\footnotesize {}\n", escaped(note));
  return text + "\\end{table}\n";
}

}  // namespace smopt::experiments
