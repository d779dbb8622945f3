#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace smopt {

/// Walks through a text in memory line by line, as its lines stand (columns, blanks and all); complaints name the file and the line.
///
/// For formats in columns, and for those that pass over most lines; what is fields between blanks is `TextReader`'s. Cost: O(bytes),
/// nothing is copied.
class LineReader {
 public:
  /// \param text  stays the caller's and must outlive the reader.
  /// \param name  how messages call it; as `text`.
  /// \throws InvalidInput when the text is empty.
  LineReader(std::string_view text, const std::string& name);

  /// Goes to the next line; false at the end of the text.
  bool next();
  /// The current line without its end (`\n` or `\r\n`).
  [[nodiscard]] std::string_view line() const { return line_; }
  /// Its number, counted from 1.
  [[nodiscard]] std::size_t number() const { return number_; }
  /// \throws InvalidInput "name:line: message", always.
  [[noreturn]] void fail(std::string_view message) const;

 private:
  std::string_view rest_;
  const std::string& name_;
  std::string_view line_;
  std::size_t number_ = 0;
};

}  // namespace smopt
