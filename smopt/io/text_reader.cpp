#include "smopt/io/text_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "smopt/error.h"

namespace smopt {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// Longest piece of a file that a message quotes.
constexpr std::size_t kQuoted = 40;

/// std::from_chars calls numbers too small for a double out of range as it does those too large; the former are (nearly) zero.
bool parse_tiny(std::string_view text, double& value) {
  value = std::strtod(std::string(text).c_str(), nullptr);
  return std::isfinite(value);
}

}  // namespace

std::string quoted(std::string_view text) {
  std::string shown = "\"";
  for (const char c : text.substr(0, kQuoted)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (text.size() > kQuoted ? "…\"" : "\"");
}

bool parse_number(std::string_view text, double& value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return false;
  return error == std::errc() || (error == std::errc::result_out_of_range && parse_tiny(text, value));
}

bool parse_integer(std::string_view text, std::int64_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return end == text.data() + text.size() && error == std::errc();
}

TextReader::TextReader(std::string_view text, std::string name)
    : name_(std::move(name)), at_(text.data()), line_end_(text.data()), next_(text.data()), end_(text.data() + text.size()) {
  if (text.empty()) throw InvalidInput(name_ + ": the file is empty");
}

bool TextReader::next_line() {
  while (next_ != end_) {
    at_ = next_;
    ++line_;
    const void* newline = std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_));
    line_end_ = newline ? static_cast<const char*>(newline) : end_;
    next_ = newline ? line_end_ + 1 : end_;
    if (has_field()) return true;
  }
  at_ = line_end_ = end_;
  return false;
}

void TextReader::require_line(std::string_view missing) {
  if (!next_line()) fail(fmt::format("the file ends before {}", missing));
}

void TextReader::require_end(std::string_view complete) {
  if (next_line()) fail(fmt::format("{} follows {}", quoted(field("field")), complete));
}

bool TextReader::has_field() {
  while (at_ != line_end_ && is_blank(*at_)) ++at_;
  return at_ != line_end_ && *at_ != '#';
}

std::string_view TextReader::field(std::string_view what) {
  if (!has_field()) fail(fmt::format("{} is missing", what));
  const char* begin = at_;
  while (at_ != line_end_ && !is_blank(*at_)) ++at_;
  return {begin, static_cast<std::size_t>(at_ - begin)};
}

std::size_t TextReader::skip_fields() {
  std::size_t n = 0;
  for (; has_field(); ++n) field("field");
  return n;
}

double TextReader::number(std::string_view what) {
  const std::string_view text = field(what);
  double value = 0;
  if (!parse_number(text, value)) fail(fmt::format("{} is {}, expected a number", what, quoted(text)));
  return value;
}

std::int64_t TextReader::integer(std::string_view what) {
  const std::string_view text = field(what);
  std::int64_t value = 0;
  if (!parse_integer(text, value)) fail(fmt::format("{} is {}, expected an integer", what, quoted(text)));
  return value;
}

Vec3 TextReader::point() {
  const double x = number("coordinate x");
  const double y = number("coordinate y");
  const double z = number("coordinate z");
  return {x, y, z};
}

std::size_t TextReader::count(std::string_view what, std::size_t bytes_each) {
  const std::int64_t n = integer(what);
  if (n < 0) fail(fmt::format("{} is {}, less than none", what, n));
  if (static_cast<std::uint64_t>(n) > kMaxMeshElements) fail(fmt::format("{} is {}, more than {}", what, n, kMaxMeshElements));
  const auto rest_bytes = static_cast<std::size_t>(end_ - at_) + 1;  // the last line may lack its newline
  if (static_cast<std::size_t>(n) > rest_bytes / bytes_each)
    fail(fmt::format("{} is {}, but the file ends after {} more bytes", what, n, rest_bytes - 1));
  return static_cast<std::size_t>(n);
}

std::uint32_t TextReader::vertex_index(std::size_t face, std::size_t vertices, std::int64_t first) {
  const std::int64_t index = integer("vertex index");
  if (index < first || index - first >= static_cast<std::int64_t>(vertices))
    fail(fmt::format("face {}: vertex index {} is out of range, there are {} vertices, counted from {}", face, index, vertices, first));
  return static_cast<std::uint32_t>(index - first);
}

void TextReader::fail(std::string_view message) const {
  throw InvalidInput(fmt::format("{}:{}: {}", name_, std::max<std::size_t>(line_, 1), message));
}

}  // namespace smopt
