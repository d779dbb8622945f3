#include "smopt/io/xml.h"

#include <fmt/format.h>

#include <algorithm>

#include "smopt/error.h"

namespace smopt {
namespace {

/// Deeper nesting than any VTK file has is refused, as the parser recurses.
constexpr int kMaxDepth = 32;
constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::string_view kRawElement = "AppendedData";

class Parser {
 public:
  Parser(std::string_view document, const std::string& name) : document_(document), name_(name) {}

  XmlElement parse() {
    skip_between_elements();
    if (!looking_at("<")) fail("not an XML file: it does not begin with <");
    XmlElement root = element(0);
    skip_between_elements();
    if (at_ != document_.size()) fail("something follows the root element");
    return root;
  }

 private:
  XmlElement element(int depth) {
    if (depth > kMaxDepth) fail(fmt::format("more than {} elements inside one another", kMaxDepth));
    XmlElement result;
    result.offset = at_;
    expect("<");
    result.name = word();
    read_attributes(result);
    if (skip("/>")) return result;
    expect(">");
    if (result.name == kRawElement)
      read_raw(result);
    else
      read_content(result, depth);
    read_end_tag(result);
    return result;
  }

  void read_attributes(XmlElement& element) {
    for (skip_blanks(); !looking_at(">") && !looking_at("/>"); skip_blanks()) {
      const std::string_view key = word();
      skip_blanks();
      expect("=");
      skip_blanks();
      element.attributes.emplace_back(key, quoted());
    }
  }

  void read_content(XmlElement& element, int depth) {
    while (true) {
      const std::size_t tag = document_.find('<', at_);
      if (tag == std::string_view::npos) fail_at_end(element.name);
      const std::string_view run = take(tag - at_);
      if (element.text.empty() && run.find_first_not_of(kBlanks) != std::string_view::npos) element.text = run;
      if (skip_comment()) continue;
      if (looking_at("</")) break;
      element.children.push_back(this->element(depth + 1));
    }
  }

  void read_raw(XmlElement& element) {
    const std::size_t end = document_.rfind("</AppendedData");
    if (end == std::string_view::npos || end < at_) fail_at_end(element.name);
    element.text = document_.substr(at_, end - at_);
    at_ = end;
  }

  void read_end_tag(const XmlElement& element) {
    expect("</");
    if (const std::string_view name = word(); name != element.name) fail(fmt::format("</{}> where </{}> is expected", name, element.name));
    skip_blanks();
    expect(">");
  }

  std::string_view word() {
    const std::size_t end = std::min(document_.find_first_of(" \t\r\n=/<>\"'", at_), document_.size());
    if (end == at_) fail("a name is expected");
    return take(end - at_);
  }

  std::string_view quoted() {
    if (!looking_at("\"") && !looking_at("'")) fail("a quoted value is expected");
    const char quote = document_[at_++];
    const std::size_t end = document_.find(quote, at_);
    if (end == std::string_view::npos) fail("the value's closing quote is missing");
    const std::string_view value = take(end - at_);
    ++at_;
    return value;
  }

  void skip_between_elements() {
    do skip_blanks();
    while (skip_declaration() || skip_comment());
  }
  bool skip_declaration() { return looking_at("<?") && skip_past("?>"); }
  bool skip_comment() { return looking_at("<!--") && skip_past("-->"); }

  bool skip_past(std::string_view end) {
    const std::size_t found = document_.find(end, at_);
    if (found == std::string_view::npos) fail(fmt::format("the closing {} is missing", end));
    at_ = found + end.size();
    return true;
  }

  void skip_blanks() { at_ = std::min(document_.find_first_not_of(kBlanks, at_), document_.size()); }
  [[nodiscard]] bool looking_at(std::string_view text) const { return document_.substr(at_).starts_with(text); }
  bool skip(std::string_view text) {
    if (!looking_at(text)) return false;
    at_ += text.size();
    return true;
  }
  void expect(std::string_view text) {
    if (!skip(text)) fail(fmt::format("{} is expected", text));
  }
  std::string_view take(std::size_t n) {
    const std::string_view taken = document_.substr(at_, n);
    at_ += n;
    return taken;
  }

  [[noreturn]] void fail_at_end(std::string_view element) {
    at_ = document_.size();
    fail(fmt::format("the file ends before </{}>", element));
  }
  [[noreturn]] void fail(std::string_view message) const {
    throw InvalidInput(fmt::format("{}:{}: {}", name_, line_of(document_, at_), message));
  }

  std::string_view document_;
  const std::string& name_;
  std::size_t at_ = 0;
};

}  // namespace

std::string_view XmlElement::attribute(std::string_view key) const {
  const auto found = std::ranges::find(attributes, key, &std::pair<std::string_view, std::string_view>::first);
  return found == attributes.end() ? std::string_view() : found->second;
}

const XmlElement* XmlElement::child(std::string_view child_name) const {
  const auto found = std::ranges::find(children, child_name, &XmlElement::name);
  return found == children.end() ? nullptr : &*found;
}

XmlElement parse_xml(std::string_view document, const std::string& name) {
  if (document.empty()) throw InvalidInput(name + ": the file is empty");
  return Parser(document, name).parse();
}

std::size_t line_of(std::string_view document, std::size_t offset) {
  return 1 + static_cast<std::size_t>(std::ranges::count(document.substr(0, offset), '\n'));
}

}  // namespace smopt
