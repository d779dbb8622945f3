#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace smopt::experiments {

/// One of the paper's tables (Liu et al. 2017), its values as they are printed there.
class PaperTable {
 public:
  /// Reads comma-separated values without quotes; the first column names the rows. \throws InvalidInput naming the line.
  explicit PaperTable(std::string_view csv);

  /// The value of a row in a column; nothing when `row` is empty or the table has none such. \throws InvalidOption for an unknown column.
  [[nodiscard]] std::optional<std::string> value(const std::optional<std::string>& row, const std::string& column) const;

 private:
  std::map<std::string, std::size_t> columns_;
  std::map<std::string, std::vector<std::string>> rows_;
};

/// Tables 1, 2 and 3.
const PaperTable& paper_table(int number);

}  // namespace smopt::experiments
