#include "smopt/io/line_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "smopt/error.h"

namespace smopt {

LineReader::LineReader(std::string_view text, const std::string& name) : rest_(text), name_(name) {
  if (text.empty()) throw InvalidInput(name + ": the file is empty");
}

bool LineReader::next() {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  line_ = rest_.substr(0, end);
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++number_;
  return true;
}

void LineReader::fail(std::string_view message) const {
  throw InvalidInput(fmt::format("{}:{}: {}", name_, number_, message));
}

}  // namespace smopt
