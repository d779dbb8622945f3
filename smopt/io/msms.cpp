#include "smopt/io/msms.h"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "smopt/io/file.h"
#include "smopt/io/text_reader.h"
#include "smopt/io/text_writer.h"

namespace smopt {
namespace {

namespace fs = std::filesystem;

/// Shortest lines there are: "0 0 0\n" and "1 2 3\n".
constexpr std::size_t kShortestLine = 6;

std::size_t read_count(TextReader& in, std::string_view what) {
  in.require_line(what);
  return in.count(what, kShortestLine);
}

std::vector<Vec3> read_points(TextReader& in) {
  std::vector<Vec3> points(read_count(in, "number of vertices"));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!in.next_line()) in.fail(fmt::format("the file ends after {} of {} vertices", i, points.size()));
    points[i] = in.point();
  }
  in.require_end("as many vertices as the header counts");
  return points;
}

std::vector<Triangle> read_triangles(TextReader& in, std::size_t vertices) {
  std::vector<Triangle> triangles(read_count(in, "number of faces"));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!in.next_line()) in.fail(fmt::format("the file ends after {} of {} faces", i, triangles.size()));
    for (VertexId& corner : triangles[i]) corner = in.vertex_index(i, vertices, 1);
  }
  in.require_end("as many faces as the header counts");
  return triangles;
}

std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 twice_area = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    for (const VertexId v : {a, b, c}) normals[v] += twice_area;
  }
  for (Vec3& n : normals) {
    n.stableNormalize();
    if (!n.allFinite()) n.setZero();
  }
  return normals;
}

/// "# …", the columns' names and the counts, as MSMS 2.6 begins its files; number of spheres, density and probe radius are not known.
std::string header(std::string_view things, std::string_view column, std::size_t count) {
  return fmt::format("# MSMS solvent excluded surface {}, written by smopt\n#{} #sphere density probe_r\n{} 0 0.00 0.00\n", things, column,
                     count);
}

struct Pair {
  fs::path vert;
  fs::path face;
};

/// The name with another ending, `.gz` kept.
fs::path with_ending(const fs::path& path, std::string_view ending) {
  if (!is_gzip_name(path)) return fs::path(path).replace_extension(ending);
  return path.parent_path() / path.stem().replace_extension(ending).concat(path.extension().string());
}

Pair pair_of(const fs::path& path) {
  return format_ending(path) == "vert" ? Pair{path, with_ending(path, ".face")} : Pair{with_ending(path, ".vert"), path};
}

/// `path`, or where only its packed or unpacked form exists, that.
fs::path existing_form(const fs::path& path) {
  const fs::path other = is_gzip_name(path) ? fs::path(path).replace_extension() : fs::path(path).concat(".gz");
  return !fs::exists(path) && fs::exists(other) ? other : path;
}

}  // namespace

TriangleMesh parse_msms(std::string_view vert, const std::string& vert_name, std::string_view face, const std::string& face_name) {
  TextReader vert_in(vert, vert_name);
  TextReader face_in(face, face_name);
  TriangleMesh mesh;
  mesh.points = read_points(vert_in);
  mesh.triangles = read_triangles(face_in, mesh.points.size());
  return mesh;
}

MsmsText format_msms(const TriangleMesh& mesh, const MeshWriteOptions& options) {
  TextWriter vert(options.digits);
  TextWriter face;
  vert.reserve(2 * mesh.points.size(), 0);
  face.reserve(0, mesh.triangles.size());
  vert.text(header("vertices", "vertex", mesh.points.size()));
  face.text(header("faces", "faces", mesh.triangles.size()));
  const std::vector<Vec3> normals = vertex_normals(mesh);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) vert.point(mesh.points[i]).text(" ").point(normals[i]).text(" 0 0 2\n");
  for (const Triangle& t : mesh.triangles) {
    for (const VertexId v : t) face.integer(std::uint64_t{v} + 1).text(" ");
    face.text("3 0\n");
  }
  return {vert.take(), face.take()};
}

TriangleMesh read_msms(const fs::path& path) {
  const Pair named = pair_of(path);
  const Pair pair = format_ending(path) == "vert" ? Pair{path, existing_form(named.face)} : Pair{existing_form(named.vert), path};
  const std::string vert = read_file(pair.vert);
  const std::string face = read_file(pair.face);
  return parse_msms(vert, pair.vert.string(), face, pair.face.string());
}

void write_msms(const fs::path& path, const TriangleMesh& mesh, const MeshWriteOptions& options) {
  const Pair pair = pair_of(path);
  const MsmsText text = format_msms(mesh, options);
  const std::array<FileContent, 2> files = {{{pair.vert, text.vert}, {pair.face, text.face}}};
  write_files(files);
}

}  // namespace smopt
