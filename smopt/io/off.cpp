#include "smopt/io/off.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "smopt/io/text_reader.h"
#include "smopt/io/text_writer.h"

namespace smopt {
namespace {

/// Shortest lines there are: "0 0 0\n" and "3 0 1 2\n".
constexpr std::size_t kShortestVertexLine = 6;
constexpr std::size_t kShortestFaceLine = 8;

/// Keywords of files whose vertices begin with x, y, z.
constexpr std::array<std::string_view, 8> kKeywords = {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCOFF", "STNOFF", "STCNOFF"};

struct Counts {
  std::size_t vertices;
  std::size_t faces;
};

Counts read_header(TextReader& in) {
  in.require_line("its OFF keyword");
  if (std::ranges::find(kKeywords, in.field("keyword")) == kKeywords.end()) in.fail("not an OFF file: it does not begin with OFF");
  if (!in.has_field()) in.require_line("the numbers of vertices and faces");
  Counts counts{};
  counts.vertices = in.count("number of vertices", kShortestVertexLine);
  counts.faces = in.count("number of faces", kShortestFaceLine);
  if (in.has_field()) in.integer("number of edges");
  return counts;
}

/// Every vertex has as many columns as the first: so a face's line is not taken for a vertex where the counts are wrong.
void read_points(TextReader& in, std::size_t n, std::vector<Vec3>& points) {
  points.resize(n);
  std::size_t extra_columns = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!in.next_line()) in.fail(fmt::format("the file ends after {} of {} vertices", i, n));
    points[i] = in.point();
    const std::size_t extra = in.skip_fields();
    if (i == 0) extra_columns = extra;
    if (extra != extra_columns) in.fail(fmt::format("vertex {} has {} columns, those before it have {}", i, 3 + extra, 3 + extra_columns));
  }
}

void read_triangles(TextReader& in, std::size_t n, std::size_t vertices, std::vector<Triangle>& triangles) {
  triangles.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!in.next_line()) in.fail(fmt::format("the file ends after {} of {} faces", i, n));
    const std::int64_t corners = in.integer("number of the face's vertices");
    if (corners != 3) in.fail(fmt::format("face {} has {} vertices, expected 3", i, corners));
    for (VertexId& corner : triangles[i]) corner = in.vertex_index(i, vertices, 0);
  }
}

}  // namespace

TriangleMesh parse_off(std::string_view text, const std::string& name) {
  TextReader in(text, name);
  const Counts counts = read_header(in);
  TriangleMesh mesh;
  read_points(in, counts.vertices, mesh.points);
  read_triangles(in, counts.faces, counts.vertices, mesh.triangles);
  in.require_end(fmt::format("{} vertices and {} faces, as many as the header counts", counts.vertices, counts.faces));
  return mesh;
}

std::string format_off(const TriangleMesh& mesh, const MeshWriteOptions& options) {
  TextWriter out(options.digits);
  out.reserve(mesh.points.size(), mesh.triangles.size());
  out.text(fmt::format("OFF\n{} {} 0\n", mesh.points.size(), mesh.triangles.size()));
  for (const Vec3& p : mesh.points) out.point(p).text("\n");
  for (const auto& [a, b, c] : mesh.triangles) out.text("3 ").integer(a).text(" ").integer(b).text(" ").integer(c).text("\n");
  return out.take();
}

}  // namespace smopt
