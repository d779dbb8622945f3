#include "smopt/io/vtk_array.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "smopt/error.h"
#include "smopt/io/base64.h"
#include "smopt/io/bytes.h"
#include "smopt/io/text_reader.h"

namespace smopt {
namespace {

/// zlib packs at most 1032 to 1: a header that promises more is wrong, and is refused before memory is taken.
constexpr std::uint64_t kMaxInflation = 1032;

template <class To>
using Convert = void (*)(std::string_view bytes, std::endian order, std::vector<To>& out);

template <class From, class To>
void convert(std::string_view bytes, std::endian order, std::vector<To>& out) {
  out.reserve(bytes.size() / sizeof(From));
  for (std::size_t i = 0; i + sizeof(From) <= bytes.size(); i += sizeof(From))
    out.push_back(static_cast<To>(load<From>(bytes.data() + i, order)));
}

template <class To>
struct ValueType {
  std::string_view name;
  std::size_t size;
  Convert<To> convert;
};

constexpr std::array<ValueType<double>, 2> kRealTypes = {{{"Float32", 4, convert<float, double>}, {"Float64", 8, convert<double, double>}}};
constexpr std::array<ValueType<std::int64_t>, 8> kIntegerTypes = {{{"Int8", 1, convert<std::int8_t, std::int64_t>},
                                                                   {"UInt8", 1, convert<std::uint8_t, std::int64_t>},
                                                                   {"Int16", 2, convert<std::int16_t, std::int64_t>},
                                                                   {"UInt16", 2, convert<std::uint16_t, std::int64_t>},
                                                                   {"Int32", 4, convert<std::int32_t, std::int64_t>},
                                                                   {"UInt32", 4, convert<std::uint32_t, std::int64_t>},
                                                                   {"Int64", 8, convert<std::int64_t, std::int64_t>},
                                                                   {"UInt64", 8, convert<std::uint64_t, std::int64_t>}}};

template <class T>
constexpr const auto& types_of() {
  if constexpr (std::is_same_v<T, double>)
    return kRealTypes;
  else
    return kIntegerTypes;
}

bool parse(std::string_view text, double& value) {
  return parse_number(text, value);
}
bool parse(std::string_view text, std::int64_t& value) {
  return parse_integer(text, value);
}

/// The values of a text; `bad` is the first that is none.
template <class T>
std::vector<T> parse_all(std::string_view text, std::string_view& bad) {
  constexpr std::string_view blanks = " \t\r\n";
  std::vector<T> values;
  for (std::size_t at = text.find_first_not_of(blanks); at < text.size(); at = text.find_first_not_of(blanks, at)) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    T value{};
    if (!parse(text.substr(at, end - at), value)) {
      bad = text.substr(at, end - at);
      break;
    }
    values.push_back(value);
    at = end;
  }
  return values;
}

/// Appends what a block is unpacked; false unless that is `size` bytes.
bool append_inflated(std::string_view packed, std::uint64_t size, std::string& out) {
  if (size > (packed.size() + 1) * kMaxInflation) return false;
  const std::size_t before = out.size();
  out.resize(before + size);
  uLongf inflated = size;
  const auto* source = reinterpret_cast<const Bytef*>(packed.data());
  return uncompress(reinterpret_cast<Bytef*>(out.data() + before), &inflated, source, packed.size()) == Z_OK && inflated == size;
}

}  // namespace

VtkArrayReader::VtkArrayReader(std::string_view document, const std::string& name, const XmlElement& root)
    : document_(document), name_(name), appended_(root.child("AppendedData")) {
  const std::string_view order = root.attribute("byte_order");
  const std::string_view header = root.attribute("header_type");
  const std::string_view compressor = root.attribute("compressor");
  if (!order.empty() && order != "LittleEndian" && order != "BigEndian")
    fail(root, fmt::format("byte_order \"{}\" is not LittleEndian or BigEndian", order));
  if (!header.empty() && header != "UInt32" && header != "UInt64")
    fail(root, fmt::format("header_type \"{}\" is not UInt32 or UInt64", header));
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
    fail(root, fmt::format("compressor \"{}\" is not supported", compressor));
  is_big_endian_ = order == "BigEndian";
  is_packed_ = !compressor.empty();
  word_size_ = header == "UInt64" ? 8 : 4;
}

std::vector<double> VtkArrayReader::reals(const XmlElement& array) const {
  return values<double>(array);
}
std::vector<std::int64_t> VtkArrayReader::integers(const XmlElement& array) const {
  return values<std::int64_t>(array);
}

void VtkArrayReader::fail(const XmlElement& element, std::string_view message) const {
  const std::string_view label = element.attribute("Name");
  throw InvalidInput(
      fmt::format("{}:{}: {}{}{}: {}", name_, line_of(document_, element.offset), element.name, label.empty() ? "" : " ", label, message));
}

template <class T>
std::vector<T> VtkArrayReader::values(const XmlElement& array) const {
  const auto& types = types_of<T>();
  const auto type = std::ranges::find(types, array.attribute("type"), &ValueType<T>::name);
  if (type == types.end()) fail(array, fmt::format("type \"{}\" is not one of its kind", array.attribute("type")));
  if (array.attribute("format") == "ascii") {
    std::string_view bad;
    std::vector<T> result = parse_all<T>(array.text, bad);
    if (!bad.empty()) fail(array, fmt::format("value {} is \"{}\", expected a number", result.size(), bad.substr(0, 40)));
    return result;
  }
  const std::string data = bytes(array);
  if (data.size() % type->size != 0) fail(array, fmt::format("{} bytes are not a whole number of {}", data.size(), type->name));
  std::vector<T> result;
  type->convert(data, is_big_endian_ ? std::endian::big : std::endian::little, result);
  return result;
}

std::string VtkArrayReader::bytes(const XmlElement& array) const {
  const std::string_view format = array.attribute("format");
  if (format != "binary" && format != "appended") fail(array, fmt::format("format \"{}\" is not ascii, binary or appended", format));
  const std::string_view stored = format == "binary" ? array.text : appended_from(array);
  if (format == "appended" && appended_->attribute("encoding") == "raw") return unpack(array, stored);
  const std::optional<std::string> decoded = decode_base64(stored);
  if (!decoded) fail(array, "its data are not base64");
  return unpack(array, *decoded);
}

/// Everything in AppendedData from the array's offset on, counted from behind the underscore.
std::string_view VtkArrayReader::appended_from(const XmlElement& array) const {
  if (!appended_) fail(array, "the file ends without its AppendedData");
  const std::size_t begin = appended_->text.find('_');
  std::int64_t offset = -1;
  if (begin == std::string_view::npos || !parse_integer(array.attribute("offset"), offset) || offset < 0 ||
      static_cast<std::uint64_t>(offset) > appended_->text.size() - begin - 1)
    fail(array, "its offset is not in AppendedData");
  return appended_->text.substr(begin + 1 + static_cast<std::size_t>(offset));
}

std::uint64_t VtkArrayReader::word(const XmlElement& array, std::string_view data, std::size_t index) const {
  if (index >= data.size() / word_size_) fail(array, "its data are truncated");
  const std::endian order = is_big_endian_ ? std::endian::big : std::endian::little;
  const char* at = data.data() + index * word_size_;
  return word_size_ == 8 ? load<std::uint64_t>(at, order) : load<std::uint32_t>(at, order);
}

/// What the header in front of the data says belongs to the array: [bytes] data.
std::string VtkArrayReader::unpack(const XmlElement& array, std::string_view data) const {
  if (is_packed_) return inflate_blocks(array, data);
  const std::uint64_t size = word(array, data, 0);
  if (size > data.size() - word_size_) fail(array, fmt::format("its data are truncated: {} of {} bytes", data.size() - word_size_, size));
  return std::string(data.substr(word_size_, size));
}

/// [blocks][block size][last block's size, 0: as the others][packed size of each block] data.
std::string VtkArrayReader::inflate_blocks(const XmlElement& array, std::string_view data) const {
  const std::uint64_t blocks = word(array, data, 0);
  if (blocks == 0) return {};
  if (blocks > data.size() / word_size_ - 1) fail(array, "its data are truncated");
  std::string_view packed = data.substr(std::min<std::size_t>((3 + blocks) * word_size_, data.size()));
  std::string out;
  for (std::uint64_t block = 0; block < blocks; ++block) {
    const std::uint64_t last_size = block + 1 == blocks ? word(array, data, 2) : 0;
    const std::uint64_t packed_size = word(array, data, 3 + block);
    if (packed_size > packed.size()) fail(array, "its data are truncated");
    if (!append_inflated(packed.substr(0, packed_size), last_size != 0 ? last_size : word(array, data, 1), out))
      fail(array, fmt::format("block {} is damaged", block));
    packed.remove_prefix(packed_size);
  }
  return out;
}

}  // namespace smopt
