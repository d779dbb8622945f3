#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "smopt/geometry/vec3.h"

namespace smopt {

/// Builds a text of numbers in memory.
class TextWriter {
 public:
  /// \param digits  significant digits of numbers, 1..17; 0: the shortest text that reads back as the same double.
  /// \throws InvalidOption when `digits` is none of these.
  explicit TextWriter(int digits = 0);

  TextWriter& text(std::string_view text);
  TextWriter& number(double value);
  TextWriter& integer(std::uint64_t value);
  /// Three numbers with a blank between them.
  TextWriter& point(const Vec3& point);

  /// Makes room for that many points and triangles, as far as can be told: longer text grows, shorter costs no memory.
  void reserve(std::size_t points, std::size_t triangles);
  [[nodiscard]] std::string take();

 private:
  int digits_;
  std::string text_;
};

}  // namespace smopt
