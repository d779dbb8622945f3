#include "experiments/tables/table.h"

#include <fmt/format.h>

#include <cmath>

namespace smopt::experiments {
namespace {

struct CellText {
  const std::string& missing;
  std::string operator()(std::monostate) const { return missing; }
  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(long count) const { return fmt::format("{}", count); }
  std::string operator()(const Decimal& number) const { return fmt::format("{:.{}f}", number.value, number.decimals); }
};

}  // namespace

std::string cell_text(const Cell& cell, const std::string& missing) {
  return std::visit(CellText{missing}, cell);
}

bool is_text(const Cell& cell) {
  return std::holds_alternative<std::string>(cell);
}

Cell decimal_cell(const std::optional<double>& value, int decimals) {
  return value ? Cell(Decimal{*value, decimals}) : Cell();
}

Cell count_cell(const std::optional<double>& value) {
  return value ? Cell(std::lround(*value)) : Cell();
}

Cell text_cell(const std::optional<std::string>& value) {
  return value ? Cell(*value) : Cell();
}

}  // namespace smopt::experiments
