#include "smopt/io/cif_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "smopt/error.h"

namespace smopt {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// `lower` is in lower case.
bool begins_as(std::string_view word, std::string_view lower) {
  const auto is_same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; };
  return word.size() >= lower.size() && std::equal(lower.begin(), lower.end(), word.begin(), [&](char b, char a) { return is_same(a, b); });
}

/// Reserved words are reserved in whatever case, and only where they are not quoted.
CifKind kind_of(std::string_view word) {
  if (word.front() == '_') return CifKind::tag;
  if (begins_as(word, "data_")) return CifKind::data;
  if (begins_as(word, "save_")) return CifKind::frame;
  if (begins_as(word, "loop_") && word.size() == 5) return CifKind::loop;
  return CifKind::value;
}

}  // namespace

CifReader::CifReader(std::string_view text, const std::string& name) : text_(text), name_(name) {
  if (text.empty()) throw InvalidInput(name + ": the file is empty");
}

CifToken CifReader::next() {
  skip_blanks();
  if (at_ == text_.size()) return token(CifKind::end, at_, at_);
  const char first = text_[at_];
  if (first == '\'' || first == '"') return quoted_text();
  if (first == ';' && (at_ == 0 || text_[at_ - 1] == '\n')) return text_field();
  return word();
}

void CifReader::skip_blanks() {
  for (; at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '#'); ++at_) {
    if (text_[at_] == '#') at_ = std::min(text_.find('\n', at_), text_.size() - 1);
    if (text_[at_] == '\n') ++line_;
  }
}

CifToken CifReader::quoted_text() {
  const char quote = text_[at_];
  const std::size_t begin = at_ + 1;
  for (std::size_t end = begin; end < text_.size() && text_[end] != '\n'; ++end) {
    if (text_[end] != quote || (end + 1 < text_.size() && !is_blank(text_[end + 1]))) continue;
    at_ = end + 1;
    CifToken result = token(CifKind::value, begin, end);
    result.is_quoted = true;
    return result;
  }
  fail(line_, "the quoted text has no end on its line");
}

CifToken CifReader::text_field() {
  const std::size_t begin = at_ + 1;
  const std::size_t end = text_.find("\n;", begin);
  if (end == std::string_view::npos) fail(line_, "the text field has no end (a line that begins with a semicolon)");
  CifToken result = token(CifKind::value, begin, end);
  result.is_quoted = true;
  line_ += static_cast<std::size_t>(
      std::count(text_.begin() + static_cast<std::ptrdiff_t>(begin), text_.begin() + static_cast<std::ptrdiff_t>(end) + 1, '\n'));
  at_ = end + 2;
  return result;
}

CifToken CifReader::word() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
  return token(kind_of(text_.substr(begin, at_ - begin)), begin, at_);
}

CifToken CifReader::token(CifKind kind, std::size_t begin, std::size_t end) const {
  return {kind, text_.substr(begin, end - begin), false, line_};
}

void CifReader::fail(std::size_t line, std::string_view message) const {
  throw InvalidInput(fmt::format("{}:{}: {}", name_, line, message));
}

}  // namespace smopt
