#include "smopt/io/text_writer.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <utility>

#include "smopt/error.h"

namespace smopt {
namespace {

/// Longest text of a double with 17 digits is 24 bytes (-2.2250738585072014e-308), of a 64-bit integer 20.
constexpr std::size_t kLongestNumber = 32;
/// Usual lengths of a line, a little on the long side.
constexpr std::size_t kPointLine = 64;
constexpr std::size_t kTriangleLine = 36;

}  // namespace

TextWriter::TextWriter(int digits) : digits_(digits) {
  if (digits < 0 || digits > std::numeric_limits<double>::max_digits10)
    throw InvalidOption(fmt::format("digits is {}, expected 0 to {}", digits, std::numeric_limits<double>::max_digits10));
}

TextWriter& TextWriter::text(std::string_view text) {
  text_ += text;
  return *this;
}

TextWriter& TextWriter::number(double value) {
  char buffer[kLongestNumber];
  char* const end = buffer + kLongestNumber;
  const auto result =
      digits_ == 0 ? std::to_chars(buffer, end, value) : std::to_chars(buffer, end, value, std::chars_format::general, digits_);
  text_.append(buffer, result.ptr);
  return *this;
}

TextWriter& TextWriter::integer(std::uint64_t value) {
  char buffer[kLongestNumber];
  text_.append(buffer, std::to_chars(buffer, buffer + kLongestNumber, value).ptr);
  return *this;
}

TextWriter& TextWriter::point(const Vec3& point) {
  return number(point.x()).text(" ").number(point.y()).text(" ").number(point.z());
}

void TextWriter::reserve(std::size_t points, std::size_t triangles) {
  text_.reserve(points * kPointLine + triangles * kTriangleLine);
}

std::string TextWriter::take() {
  return std::move(text_);
}

}  // namespace smopt
