#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace smopt {

/// What stands next in a CIF.
enum class CifKind {
  end,    ///< of the file
  data,   ///< `data_name`: a data block begins
  loop,   ///< `loop_`
  frame,  ///< `save_name` or `save_`: a save frame begins or ends
  tag,    ///< `_name`
  value,  ///< a word, a quoted text or a text field
};

struct CifToken {
  CifKind kind = CifKind::end;
  std::string_view text;  ///< a view of the file; of a value without quotes or semicolons
  bool is_quoted = false;
  std::size_t line = 1;  ///< where it begins

  /// Whether it is a value that is not given: `.` (does not apply) or `?` (not known).
  [[nodiscard]] bool is_null() const { return !is_quoted && (text == "." || text == "?"); }
};

/// Cuts a CIF (version 1.1: Hall, Allen, Brown 1991; IUCr, "CIF syntax") into tokens without copying it: words, texts in single or double
/// quotes (which end at a quote before a blank), text fields between lines that begin with a semicolon, comments passed over. Cost:
/// O(bytes).
class CifReader {
 public:
  /// \param text  stays the caller's and must outlive the reader and its tokens.
  /// \param name  how messages call it; as `text`.
  /// \throws InvalidInput when the text is empty.
  CifReader(std::string_view text, const std::string& name);

  /// The next token; `end` again and again at the end.
  /// \throws InvalidInput "name:line: …" for a quoted text or a text field without an end.
  CifToken next();

  /// \throws InvalidInput "name:line: message", always.
  [[noreturn]] void fail(std::size_t line, std::string_view message) const;

 private:
  void skip_blanks();
  CifToken quoted_text();
  CifToken text_field();
  CifToken word();
  [[nodiscard]] CifToken token(CifKind kind, std::size_t begin, std::size_t end) const;

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

}  // namespace smopt
