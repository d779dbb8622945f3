#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "smopt/geometry/vec3.h"

namespace smopt {

/// Most vertices or triangles a mesh can have: indices are 32-bit and the last one is left free.
inline constexpr std::uint64_t kMaxMeshElements = 0xFFFFFFFEU;

/// Walks through a text in memory line by line and field by field, without copying it; every complaint names the file and the line.
///
/// Fields are separated by blanks; a field that begins with `#` begins a comment to the end of its line. Lines without fields are passed
/// over. Cost: O(bytes); numbers by std::from_chars.
class TextReader {
 public:
  /// \param text  stays the caller's and must outlive the reader.
  /// \param name  how messages call it.
  TextReader(std::string_view text, std::string name);

  /// Goes to the next line that has a field; false at the end of the text.
  bool next_line();
  /// `next_line`, or a complaint that the file ends before `missing`.
  void require_line(std::string_view missing);
  /// Complains unless nothing but comments follows; `complete` says what the header promised.
  void require_end(std::string_view complete);

  /// Whether another field stands on this line.
  bool has_field();
  /// The next field of this line; `what` names it in the complaint that it is missing.
  std::string_view field(std::string_view what);
  /// Passes over the fields that are left on this line; returns how many.
  std::size_t skip_fields();
  /// The next field as a number; nan and inf are numbers, one too large for a double is not.
  double number(std::string_view what);
  std::int64_t integer(std::string_view what);
  /// Three numbers; whatever follows on the line (normals, colours) is left.
  Vec3 point();
  /// The number of things that follow in this text, each `bytes_each` long at least: refused where it is negative, more than a mesh can
  /// have, or more than the rest of the text has room for, so that the caller may allocate that many.
  std::size_t count(std::string_view what, std::size_t bytes_each);
  /// An index of one of `vertices` vertices that are counted from `first`, as an index from 0.
  std::uint32_t vertex_index(std::size_t face, std::size_t vertices, std::int64_t first);

  /// What follows the current line.
  [[nodiscard]] std::string_view rest() const { return {next_, static_cast<std::size_t>(end_ - next_)}; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::size_t line() const { return line_; }
  /// \throws InvalidInput "name:line: message", always.
  [[noreturn]] void fail(std::string_view message) const;

 private:
  std::string name_;
  const char* at_;
  const char* line_end_;
  const char* next_;
  const char* end_;
  std::size_t line_ = 0;
};

/// Reads a whole text as a number, `+1.5` included; false where it is none.
bool parse_number(std::string_view text, double& value);
bool parse_integer(std::string_view text, std::int64_t& value);

/// A piece of a file as a message shows it: in quotation marks, cut where it is long, a question mark for what is not printable ASCII.
std::string quoted(std::string_view text);

}  // namespace smopt
