#include "baselines/external/medit_mesh.h"

#include <fmt/format.h>

#include <cctype>

#include "smopt/io/file.h"
#include "smopt/io/text_reader.h"
#include "smopt/io/text_writer.h"

namespace smopt::baselines {
namespace {

constexpr std::size_t kShortestElement = 8;  ///< bytes: four fields of a digit, a blank after each

/// Medit's fields, which may stand on any line.
class MeditReader {
 public:
  MeditReader(std::string_view text, const std::string& name) : reader_(text, name) {}

  TriangleMesh read() {
    go_to("MeshVersionFormatted");
    if (field("MeshVersionFormatted") != "MeshVersionFormatted") reader_.fail("expected MeshVersionFormatted");
    while (has_more()) {
      const std::string_view keyword = reader_.field("a keyword");
      if (keyword == "End") break;
      if (keyword == "Dimension") read_dimension();
      if (keyword == "Vertices") read_vertices();
      if (keyword == "Triangles") read_triangles();
      // Anything else: its fields are numbers, which this loop passes over one by one.
    }
    require_indices();
    return std::move(mesh_);
  }

 private:
  bool has_more() { return reader_.has_field() || reader_.next_line(); }
  void go_to(std::string_view what) {
    if (!reader_.has_field()) reader_.require_line(what);
  }
  std::string_view field(std::string_view what) {
    go_to(what);
    return reader_.field(what);
  }
  double number(std::string_view what) {
    go_to(what);
    return reader_.number(what);
  }
  std::int64_t integer(std::string_view what) {
    go_to(what);
    return reader_.integer(what);
  }
  std::size_t count(std::string_view what) {
    go_to(what);
    return reader_.count(what, kShortestElement);
  }

  void read_dimension() {
    if (integer("the dimension") != 3) reader_.fail("expected three dimensions");
  }

  void read_vertices() {
    mesh_.points.resize(count("the number of vertices"));
    for (Vec3& p : mesh_.points) {
      for (const int axis : {0, 1, 2}) p[axis] = number("a coordinate");
      field("a reference");
    }
  }

  void read_triangles() {
    mesh_.triangles.resize(count("the number of triangles"));
    for (Triangle& t : mesh_.triangles) {
      for (VertexId& v : t) v = vertex_index();
      field("a reference");
    }
  }

  /// Counted from 1; the vertices may come later, so that it is compared with their number at the end.
  VertexId vertex_index() {
    const std::int64_t index = integer("a vertex");
    if (index < 1 || index > static_cast<std::int64_t>(kMaxMeshElements)) reader_.fail(fmt::format("no vertex has the number {}", index));
    return static_cast<VertexId>(index - 1);
  }

  void require_indices() const {
    for (const Triangle& t : mesh_.triangles)
      for (const VertexId v : t)
        if (v >= mesh_.vertex_count()) reader_.fail(fmt::format("a triangle names vertex {} of {}", v + 1, mesh_.vertex_count()));
  }

  TextReader reader_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh parse_medit(std::string_view text, const std::string& name) {
  return MeditReader(text, name).read();
}

std::string format_medit(const TriangleMesh& mesh) {
  TextWriter out;
  out.text("MeshVersionFormatted 2\nDimension 3\nVertices\n").integer(mesh.vertex_count()).text("\n");
  for (const Vec3& p : mesh.points) out.point(p).text(" 0\n");
  out.text("Triangles\n").integer(mesh.triangle_count()).text("\n");
  for (const Triangle& t : mesh.triangles) {
    for (const VertexId v : t) out.integer(std::uint64_t{v} + 1).text(" ");
    out.text("0\n");
  }
  out.text("End\n");
  return out.take();
}

TriangleMesh read_medit(const std::filesystem::path& path) {
  return parse_medit(read_file(path), display_name(path));
}

}  // namespace smopt::baselines
