#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace smopt {

/// An element of an XML document; all text is that of the document, not copied.
struct XmlElement {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string_view>> attributes;
  std::vector<XmlElement> children;
  std::string_view text;   ///< the first text between its tags and its children's that is not blank
  std::size_t offset = 0;  ///< of the tag in the document

  /// The value of an attribute, as it is written; empty when there is none.
  [[nodiscard]] std::string_view attribute(std::string_view name) const;
  /// The first child of that name, or none.
  [[nodiscard]] const XmlElement* child(std::string_view name) const;
};

/// The part of XML that VTK's files use: elements, attributes, text, comments and the declaration. Entities are left as they are, a
/// document type is refused. It exists because VTK puts raw bytes into the element `AppendedData`, which no XML parser accepts: that
/// element's text is everything up to the last `</AppendedData>`. \param name  how messages call the document. \return the root element,
/// which views `document`. \throws InvalidInput "name:line: what is wrong". Cost: O(bytes), none of it copied.
XmlElement parse_xml(std::string_view document, const std::string& name);

/// The line, from 1, of a byte of the document: for messages.
std::size_t line_of(std::string_view document, std::size_t offset);

}  // namespace smopt
