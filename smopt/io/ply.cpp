#include "smopt/io/ply.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "smopt/error.h"
#include "smopt/io/bytes.h"
#include "smopt/io/text_reader.h"

namespace smopt {
namespace {

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

struct ScalarName {
  std::string_view name;
  Scalar type;
};

constexpr std::array<ScalarName, 16> kScalarNames = {{{"char", Scalar::kInt8},
                                                      {"int8", Scalar::kInt8},
                                                      {"uchar", Scalar::kUint8},
                                                      {"uint8", Scalar::kUint8},
                                                      {"short", Scalar::kInt16},
                                                      {"int16", Scalar::kInt16},
                                                      {"ushort", Scalar::kUint16},
                                                      {"uint16", Scalar::kUint16},
                                                      {"int", Scalar::kInt32},
                                                      {"int32", Scalar::kInt32},
                                                      {"uint", Scalar::kUint32},
                                                      {"uint32", Scalar::kUint32},
                                                      {"float", Scalar::kFloat32},
                                                      {"float32", Scalar::kFloat32},
                                                      {"double", Scalar::kFloat64},
                                                      {"float64", Scalar::kFloat64}}};

constexpr std::size_t size_of(Scalar type) {
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

constexpr bool is_integer(Scalar type) {
  return type < Scalar::kFloat32;
}

/// What a property is to us.
enum class Role { kX, kY, kZ, kCorners, kOther };

struct Property {
  Role role = Role::kOther;
  Scalar type = Scalar::kFloat64;
  std::optional<Scalar> count_type;  ///< of a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { kText, kLittleEndian, kBigEndian };

struct Header {
  Encoding encoding = Encoding::kText;
  std::vector<Element> elements;

  [[nodiscard]] const Element* find(std::string_view name) const {
    for (const Element& e : elements)
      if (e.name == name) return &e;
    return nullptr;
  }
};

// The header.

Scalar read_type(TextReader& in) {
  const std::string_view word = in.field("type");
  for (const auto& [name, type] : kScalarNames)
    if (name == word) return type;
  in.fail(fmt::format("\"{}\" is not a PLY type", word));
}

Scalar read_integer_type(TextReader& in) {
  const Scalar type = read_type(in);
  if (!is_integer(type)) in.fail("the length of a list is not of an integer type");
  return type;
}

Encoding read_encoding(TextReader& in) {
  const std::string_view word = in.field("format");
  if (in.field("format's version") != "1.0") in.fail("the format's version is not 1.0");
  if (word == "ascii") return Encoding::kText;
  if (word == "binary_little_endian") return Encoding::kLittleEndian;
  if (word == "binary_big_endian") return Encoding::kBigEndian;
  in.fail(fmt::format("format \"{}\" is not ascii, binary_little_endian or binary_big_endian", word));
}

Element read_element(TextReader& in) {
  Element element;
  element.name = in.field("element's name");
  const std::int64_t count = in.integer("element's count");
  if (count < 0) in.fail(fmt::format("element {} is counted {}, less than none", element.name, count));
  if (static_cast<std::uint64_t>(count) > kMaxMeshElements)
    in.fail(fmt::format("element {} is counted {}, more than {}", element.name, count, kMaxMeshElements));
  element.count = static_cast<std::uint64_t>(count);
  return element;
}

Role role_of(std::string_view element, std::string_view property, bool is_list) {
  if (element == "vertex" && !is_list && property == "x") return Role::kX;
  if (element == "vertex" && !is_list && property == "y") return Role::kY;
  if (element == "vertex" && !is_list && property == "z") return Role::kZ;
  if (element == "face" && is_list && (property == "vertex_indices" || property == "vertex_index")) return Role::kCorners;
  return Role::kOther;
}

Property read_property(TextReader& in, const Element& element) {
  Property property;
  TextReader ahead = in;
  const bool is_list = ahead.field("property's type") == "list";
  if (is_list) {
    in = ahead;
    property.count_type = read_integer_type(in);
  }
  property.type = read_type(in);
  property.role = role_of(element.name, in.field("property's name"), is_list);
  if (property.role == Role::kCorners && !is_integer(property.type)) in.fail("the faces' vertex indices are not of an integer type");
  return property;
}

int count_role(const Element& element, Role role) {
  int n = 0;
  for (const Property& p : element.properties) n += p.role == role ? 1 : 0;
  return n;
}

void require_mesh(const TextReader& in, const Header& header) {
  const Element* vertex = header.find("vertex");
  const Element* face = header.find("face");
  if (!vertex) in.fail("the header has no element vertex");
  for (const Role role : {Role::kX, Role::kY, Role::kZ})
    if (count_role(*vertex, role) != 1) in.fail("element vertex does not have one x, one y and one z");
  if (face && count_role(*face, Role::kCorners) != 1) in.fail("element face does not have one list vertex_indices");
  if (header.find("tristrips")) in.fail("triangle strips are not supported");
  for (const Element& e : header.elements) {
    if (e.properties.empty()) in.fail(fmt::format("element {} has no property", e.name));
    if (header.find(e.name) != &e) in.fail(fmt::format("element {} is declared twice", e.name));
  }
}

/// Reads up to and with the line `end_header`.
Header read_header(TextReader& in) {
  if (!in.next_line() || in.field("keyword") != "ply" || in.has_field()) in.fail("not a PLY file: its first line is not ply");
  Header header;
  bool has_format = false;
  while (true) {
    in.require_line("end_header");
    const std::string_view word = in.field("keyword");
    if (word == "end_header") break;
    if (word == "comment" || word == "obj_info") continue;
    if (word == "format") {
      header.encoding = read_encoding(in);
      has_format = true;
    } else if (word == "element") {
      header.elements.push_back(read_element(in));
    } else if (word == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(read_property(in, header.elements.back()));
    } else {
      in.fail(fmt::format("\"{}\" is not expected in a PLY header", word));
    }
  }
  if (!has_format) in.fail("the header has no line format");
  require_mesh(in, header);
  return header;
}

// The body: two sources of numbers, and one reader of the mesh over either.

/// Numbers of a text body: a line for each row.
class TextSource {
 public:
  explicit TextSource(TextReader& in) : in_(in) {}

  void begin_row(const Element& element, std::uint64_t row) {
    if (!in_.next_line()) in_.fail(fmt::format("the file ends after {} of {} {} lines", row, element.count, element.name));
  }
  void end_row() {
    if (in_.has_field()) in_.fail("more values than the element has properties");
  }
  double real(Scalar) { return in_.number("value"); }
  std::int64_t integer(Scalar) { return in_.integer("value"); }
  void skip(Scalar type) { is_integer(type) ? static_cast<void>(integer(type)) : static_cast<void>(real(type)); }
  void require_end() { in_.require_end("the last element that the header counts"); }
  [[nodiscard]] std::size_t bytes_left() const { return in_.rest().size() + 1; }  // the last line may lack its newline
  /// Shortest text of a value, with the blank or newline after it.
  static std::size_t bytes_of(Scalar) { return 2; }
  [[noreturn]] void fail(const std::string& message) const { in_.fail(message); }

 private:
  TextReader& in_;
};

/// Numbers of a binary body.
class BinarySource {
 public:
  BinarySource(std::string_view bytes, std::endian order, std::string name) : left_(bytes), order_(order), name_(std::move(name)) {}

  void begin_row(const Element& element, std::uint64_t row) {
    element_ = &element;
    row_ = row;
  }
  void end_row() {}
  double real(Scalar type) {
    if (type == Scalar::kFloat64) return take<double>();
    return type == Scalar::kFloat32 ? static_cast<double>(take<float>()) : static_cast<double>(integer(type));
  }
  std::int64_t integer(Scalar type) {
    switch (type) {
      case Scalar::kInt8:
        return take<std::int8_t>();
      case Scalar::kUint8:
        return take<std::uint8_t>();
      case Scalar::kInt16:
        return take<std::int16_t>();
      case Scalar::kUint16:
        return take<std::uint16_t>();
      case Scalar::kInt32:
        return take<std::int32_t>();
      default:
        return take<std::uint32_t>();
    }
  }
  void skip(Scalar type) { take_bytes(size_of(type)); }
  void require_end() const {
    if (!left_.empty()) throw InvalidInput(fmt::format("{}: {} bytes follow the last element that the header counts", name_, left_.size()));
  }
  [[nodiscard]] std::size_t bytes_left() const { return left_.size(); }
  static std::size_t bytes_of(Scalar type) { return size_of(type); }
  [[noreturn]] void fail(const std::string& message) const { throw InvalidInput(fmt::format("{}: {}", name_, message)); }

 private:
  template <class T>
  T take() {
    return load<T>(take_bytes(sizeof(T)), order_);
  }
  const char* take_bytes(std::size_t n) {
    if (left_.size() < n) fail(fmt::format("the file ends after {} of {} {} elements", row_, element_->count, element_->name));
    const char* bytes = left_.data();
    left_.remove_prefix(n);
    return bytes;
  }

  std::string_view left_;
  std::endian order_;
  std::string name_;
  const Element* element_ = nullptr;
  std::uint64_t row_ = 0;
};

template <class Source>
class BodyReader {
 public:
  BodyReader(Source source, const Header& header) : in_(std::move(source)), header_(header), vertices_(header.find("vertex")->count) {}

  TriangleMesh read() {
    for (const Element& element : header_.elements) {
      require_room(element);
      if (element.name == "vertex")
        read_points(element);
      else if (element.name == "face")
        read_triangles(element);
      else
        skip_element(element);
    }
    in_.require_end();
    return std::move(mesh_);
  }

 private:
  /// Refuses counts that the file is too short for before anything is allocated.
  void require_room(const Element& element) const {
    std::size_t bytes_each = 0;
    for (const Property& p : element.properties) bytes_each += Source::bytes_of(p.count_type.value_or(p.type));
    if (element.count > in_.bytes_left() / bytes_each)
      in_.fail(fmt::format("the header counts {} of element {}, more than the rest of the file has room for", element.count, element.name));
  }

  void read_points(const Element& element) {
    mesh_.points.resize(element.count);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      in_.begin_row(element, row);
      for (const Property& p : element.properties) {
        if (p.role == Role::kOther)
          skip(p);
        else
          mesh_.points[row][static_cast<int>(p.role)] = in_.real(p.type);
      }
      in_.end_row();
    }
  }

  void read_triangles(const Element& element) {
    mesh_.triangles.resize(element.count);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      in_.begin_row(element, row);
      for (const Property& p : element.properties) {
        if (p.role == Role::kCorners)
          read_corners(p, row);
        else
          skip(p);
      }
      in_.end_row();
    }
  }

  void read_corners(const Property& list, std::uint64_t face) {
    const std::int64_t n = in_.integer(*list.count_type);
    if (n != 3) in_.fail(fmt::format("face {} has {} vertices, expected 3", face, n));
    for (VertexId& corner : mesh_.triangles[face]) {
      const std::int64_t index = in_.integer(list.type);
      if (index < 0 || static_cast<std::uint64_t>(index) >= vertices_)
        in_.fail(fmt::format("face {}: vertex index {} is out of range, there are {} vertices, counted from 0", face, index, vertices_));
      corner = static_cast<VertexId>(index);
    }
  }

  void skip_element(const Element& element) {
    for (std::uint64_t row = 0; row < element.count; ++row) {
      in_.begin_row(element, row);
      for (const Property& p : element.properties) skip(p);
      in_.end_row();
    }
  }

  void skip(const Property& property) {
    const std::int64_t values = property.count_type ? in_.integer(*property.count_type) : 1;
    for (std::int64_t i = 0; i < values; ++i) in_.skip(property.type);
  }

  Source in_;
  const Header& header_;
  std::uint64_t vertices_;
  TriangleMesh mesh_;
};

std::string header_text(const TriangleMesh& mesh, std::span<const VertexScalars> scalars, bool is_signed_index) {
  std::string properties;
  for (const VertexScalars& s : scalars) properties += fmt::format("property double {}\n", s.name);
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n{}"
      "element face {}\nproperty list uchar {} vertex_indices\nend_header\n",
      mesh.points.size(), properties, mesh.triangles.size(), is_signed_index ? "int" : "uint");
}

}  // namespace

TriangleMesh parse_ply(std::string_view bytes, const std::string& name) {
  TextReader in(bytes, name);
  const Header header = read_header(in);
  if (header.encoding == Encoding::kText) return BodyReader(TextSource(in), header).read();
  const std::endian order = header.encoding == Encoding::kLittleEndian ? std::endian::little : std::endian::big;
  return BodyReader(BinarySource(in.rest(), order, name), header).read();
}

std::string format_ply(const TriangleMesh& mesh, const MeshWriteOptions&) {
  return format_ply_with_scalars(mesh, {});
}

std::string format_ply_with_scalars(const TriangleMesh& mesh, std::span<const VertexScalars> scalars) {
  // Many readers know `int` only; `uint` where there are more vertices than it can count.
  const bool is_signed_index = mesh.points.size() <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  std::string out = header_text(mesh, scalars, is_signed_index);
  out.reserve(out.size() + mesh.points.size() * (3 + scalars.size()) * sizeof(double) + mesh.triangles.size() * (1 + 3 * sizeof(VertexId)));
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    for (int k = 0; k < 3; ++k) append_little_endian(out, mesh.points[v][k]);
    for (const VertexScalars& s : scalars) append_little_endian(out, s.values[v]);
  }
  for (const Triangle& t : mesh.triangles) {
    append_little_endian(out, std::uint8_t{3});
    for (const VertexId v : t) append_little_endian(out, v);
  }
  return out;
}

}  // namespace smopt
