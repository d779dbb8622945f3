#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "smopt/io/xml.h"

namespace smopt {

/// Reads the number arrays of a VTK XML file (VTK file formats, "XML file formats"): as text, as base64 in place, or as base64 or raw bytes
/// in the element AppendedData; packed with zlib or not; either byte order; either size of the header's words.
class VtkArrayReader {
 public:
  /// \param document  the whole file, which `root` (its element VTKFile) views; both must outlive the reader.
  /// \throws InvalidInput for a byte order, header type, compressor or encoding that it does not know.
  VtkArrayReader(std::string_view document, const std::string& name, const XmlElement& root);

  /// The values of a DataArray.
  /// \throws InvalidInput naming file, line and array when they cannot be read.
  [[nodiscard]] std::vector<double> reals(const XmlElement& array) const;
  [[nodiscard]] std::vector<std::int64_t> integers(const XmlElement& array) const;

  /// \throws InvalidInput "name:line of the element: message", always.
  [[noreturn]] void fail(const XmlElement& element, std::string_view message) const;

 private:
  template <class T>
  std::vector<T> values(const XmlElement& array) const;
  std::string bytes(const XmlElement& array) const;
  std::string_view appended_from(const XmlElement& array) const;
  std::string unpack(const XmlElement& array, std::string_view data) const;
  std::string inflate_blocks(const XmlElement& array, std::string_view data) const;
  std::uint64_t word(const XmlElement& array, std::string_view data, std::size_t index) const;

  std::string_view document_;
  std::string name_;
  const XmlElement* appended_ = nullptr;
  bool is_big_endian_ = false;
  bool is_packed_ = false;
  std::size_t word_size_ = 4;
};

}  // namespace smopt
