#include "experiments/tables/csv.h"

namespace smopt::experiments {
namespace {

std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

void append(std::string& line, const std::string& text) {
  if (!line.empty()) line += ',';
  line += field(text);
}

}  // namespace

std::string to_csv(const Table& table) {
  std::string line;
  for (const Column& column : table.columns) append(line, column.id);
  std::string text = line + '\n';
  for (const std::vector<Cell>& row : table.rows) {
    line = field(cell_text(row.front(), ""));
    for (std::size_t i = 1; i < row.size(); ++i) line += ',' + field(cell_text(row[i], ""));
    text += line + '\n';
  }
  return text;
}

}  // namespace smopt::experiments
