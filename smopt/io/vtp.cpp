#include "smopt/io/vtp.h"

#include <fmt/format.h>

#include "smopt/error.h"
#include "smopt/io/base64.h"
#include "smopt/io/bytes.h"
#include "smopt/io/text_reader.h"
#include "smopt/io/text_writer.h"
#include "smopt/io/vtk_array.h"
#include "smopt/io/xml.h"

namespace smopt {
namespace {

class PolyDataReader {
 public:
  PolyDataReader(std::string_view document, const std::string& name)
      : root_(parse_xml(document, name)), arrays_(document, name, require_root(name)) {}

  TriangleMesh read() {
    const XmlElement* poly_data = root_.child("PolyData");
    if (!poly_data) arrays_.fail(root_, "no element PolyData");
    for (const XmlElement& piece : poly_data->children)
      if (piece.name == "Piece") read_piece(piece);
    return std::move(mesh_);
  }

 private:
  const XmlElement& require_root(const std::string& name) const {
    if (root_.name != "VTKFile" || root_.attribute("type") != "PolyData")
      throw InvalidInput(fmt::format("{}:1: not a VTK PolyData file: <{} type=\"{}\">", name, root_.name, root_.attribute("type")));
    return root_;
  }

  void read_piece(const XmlElement& piece) {
    const std::size_t points = count(piece, "NumberOfPoints");
    const std::size_t polygons = count(piece, "NumberOfPolys");
    if (count(piece, "NumberOfStrips") != 0) arrays_.fail(piece, "triangle strips are not supported");
    const std::size_t first = mesh_.points.size();
    if (points > 0) read_points(require_child(piece, "Points"), points);
    if (polygons > 0) read_triangles(require_child(piece, "Polys"), polygons, first);
  }

  std::size_t count(const XmlElement& piece, std::string_view attribute) const {
    const std::string_view text = piece.attribute(attribute);
    std::int64_t n = 0;
    if (!text.empty() && !parse_integer(text, n)) arrays_.fail(piece, fmt::format("{} is \"{}\", expected an integer", attribute, text));
    if (n < 0 || static_cast<std::uint64_t>(n) > kMaxMeshElements)
      arrays_.fail(piece, fmt::format("{} is {}, expected 0 to {}", attribute, n, kMaxMeshElements));
    return static_cast<std::size_t>(n);
  }

  const XmlElement& require_child(const XmlElement& piece, std::string_view name) const {
    const XmlElement* child = piece.child(name);
    if (!child) arrays_.fail(piece, fmt::format("no element {}", name));
    return *child;
  }

  const XmlElement& require_array(const XmlElement& polys, std::string_view name) const {
    for (const XmlElement& array : polys.children)
      if (array.name == "DataArray" && array.attribute("Name") == name) return array;
    arrays_.fail(polys, fmt::format("no DataArray {}", name));
  }

  void read_points(const XmlElement& element, std::size_t n) {
    const XmlElement& array = require_child(element, "DataArray");
    if (array.attribute("NumberOfComponents") != "3") arrays_.fail(array, "NumberOfComponents is not 3");
    const std::vector<double> values = arrays_.reals(array);
    if (values.size() != 3 * n)
      arrays_.fail(array, fmt::format("{} values, but NumberOfPoints is {}, which takes {}", values.size(), n, 3 * n));
    if (n > kMaxMeshElements - mesh_.points.size()) arrays_.fail(array, fmt::format("more than {} points in all", kMaxMeshElements));
    mesh_.points.reserve(mesh_.points.size() + n);
    for (std::size_t i = 0; i < n; ++i) mesh_.points.emplace_back(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  }

  void read_triangles(const XmlElement& element, std::size_t n, std::size_t first_vertex) {
    const XmlElement& connectivity = require_array(element, "connectivity");
    require_triangles(require_array(element, "offsets"), n);
    const std::vector<std::int64_t> corners = arrays_.integers(connectivity);
    if (corners.size() != 3 * n)
      arrays_.fail(connectivity, fmt::format("{} values, but NumberOfPolys is {}, which takes {}", corners.size(), n, 3 * n));
    mesh_.triangles.reserve(mesh_.triangles.size() + n);
    for (std::size_t face = 0; face < n; ++face) {
      Triangle& triangle = mesh_.triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) triangle[k] = corner(connectivity, corners[3 * face + k], face, first_vertex);
    }
  }

  void require_triangles(const XmlElement& array, std::size_t n) const {
    const std::vector<std::int64_t> offsets = arrays_.integers(array);
    if (offsets.size() != n) arrays_.fail(array, fmt::format("{} values, but NumberOfPolys is {}", offsets.size(), n));
    std::int64_t begin = 0;
    for (std::size_t face = 0; face < n; ++face) {
      if (offsets[face] < begin || offsets[face] - begin != 3)
        arrays_.fail(array, fmt::format("face {} has {} vertices, expected 3", face, offsets[face] < begin ? 0 : offsets[face] - begin));
      begin = offsets[face];
    }
  }

  VertexId corner(const XmlElement& array, std::int64_t index, std::size_t face, std::size_t first_vertex) const {
    const std::size_t vertices = mesh_.points.size() - first_vertex;
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertices)
      arrays_.fail(array,
                   fmt::format("face {}: vertex index {} is out of range, there are {} vertices, counted from 0", face, index, vertices));
    return static_cast<VertexId>(first_vertex + static_cast<std::size_t>(index));
  }

  XmlElement root_;
  VtkArrayReader arrays_;
  TriangleMesh mesh_;
};

/// Writes the arrays one by one, as text (without scalars) or as base64 with the size in front.
class PolyDataWriter {
 public:
  PolyDataWriter(const TriangleMesh& mesh, std::span<const VertexScalars> scalars, int digits)
      : mesh_(mesh), scalars_(scalars), digits_(digits), out_(digits) {}

  std::string write() {
    out_.text(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<PolyData>\n");
    out_.text(
        fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
                    mesh_.points.size(), mesh_.triangles.size()));
    if (!scalars_.empty()) write_scalars();
    is_text() ? write_text() : write_base64();
    out_.text("</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n");
    return out_.take();
  }

 private:
  [[nodiscard]] bool is_text() const { return digits_ > 0; }

  void begin_array(std::string_view attributes) {
    out_.text(fmt::format("<DataArray {} format=\"{}\">\n", attributes, is_text() ? "ascii" : "binary"));
  }
  void begin_points() {
    out_.text("<Points>\n");
    begin_array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"");
  }
  void begin_connectivity() { begin_array("type=\"Int64\" Name=\"connectivity\""); }
  void begin_offsets() { begin_array("type=\"Int64\" Name=\"offsets\""); }
  void end_array() { out_.text("</DataArray>\n"); }
  void end_points() {
    end_array();
    out_.text("</Points>\n<Polys>\n");
  }

  void write_scalars() {
    out_.text(fmt::format("<PointData Scalars=\"{}\">\n", scalars_.front().name));
    for (const VertexScalars& s : scalars_) {
      begin_array(fmt::format("type=\"Float64\" Name=\"{}\"", s.name));
      std::string bytes = sized(s.values.size());
      for (const double value : s.values) append_little_endian(bytes, value);
      out_.text(encode_base64(bytes)).text("\n");
      end_array();
    }
    out_.text("</PointData>\n");
  }

  void write_text() {
    begin_points();
    for (const Vec3& p : mesh_.points) out_.point(p).text("\n");
    end_points();
    begin_connectivity();
    for (const auto& [a, b, c] : mesh_.triangles) out_.integer(a).text(" ").integer(b).text(" ").integer(c).text("\n");
    end_array();
    begin_offsets();
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) out_.integer(3 * (i + 1)).text("\n");
    end_array();
  }

  void write_base64() {
    begin_points();
    std::string bytes = sized(3 * mesh_.points.size());
    for (const Vec3& p : mesh_.points)
      for (int k = 0; k < 3; ++k) append_little_endian(bytes, p[k]);
    out_.text(encode_base64(bytes)).text("\n");
    end_points();
    begin_connectivity();
    bytes = sized(3 * mesh_.triangles.size());
    for (const Triangle& t : mesh_.triangles)
      for (const VertexId v : t) append_little_endian(bytes, std::int64_t{v});
    out_.text(encode_base64(bytes)).text("\n");
    end_array();
    begin_offsets();
    bytes = sized(mesh_.triangles.size());
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) append_little_endian(bytes, static_cast<std::int64_t>(3 * (i + 1)));
    out_.text(encode_base64(bytes)).text("\n");
    end_array();
  }

  /// The start of an array of 8-byte values: its size in bytes.
  static std::string sized(std::size_t values) {
    std::string bytes;
    bytes.reserve(8 + 8 * values);
    append_little_endian(bytes, std::uint64_t{8 * values});
    return bytes;
  }

  const TriangleMesh& mesh_;
  std::span<const VertexScalars> scalars_;
  int digits_;
  TextWriter out_;
};

}  // namespace

TriangleMesh parse_vtp(std::string_view document, const std::string& name) {
  return PolyDataReader(document, name).read();
}

std::string format_vtp(const TriangleMesh& mesh, const MeshWriteOptions& options) {
  return PolyDataWriter(mesh, {}, options.digits).write();
}

std::string format_vtp_with_scalars(const TriangleMesh& mesh, std::span<const VertexScalars> scalars) {
  return PolyDataWriter(mesh, scalars, 0).write();
}

}  // namespace smopt
