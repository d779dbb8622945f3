#include "smopt/io/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "smopt/error.h"
#include "smopt/io/text_reader.h"
#include "smopt/io/text_writer.h"

namespace smopt {
namespace {

/// The statements that have nothing to say about a triangle mesh.
constexpr std::array<std::string_view, 42> kOtherStatements = {
    "vn",    "vt",    "vp",       "cstype",   "deg",  "bmat",   "step",   "p",      "l",      "curv",       "curv2",
    "surf",  "parm",  "trim",     "hole",     "scrv", "sp",     "end",    "con",    "g",      "s",          "mg",
    "o",     "bevel", "c_interp", "d_interp", "lod",  "maplib", "usemap", "usemtl", "mtllib", "shadow_obj", "trace_obj",
    "ctech", "stech", "call",     "csh",      "bsp",  "bzp",    "cdc",    "cdp",    "res"};

class Parser {
 public:
  Parser(std::string_view text, const std::string& name) : in_(text, name) {}

  TriangleMesh parse() {
    while (in_.next_line()) {
      const std::string_view word = in_.field("statement");
      if (word == "v")
        read_point();
      else if (word == "f" || word == "fo")
        read_face();
      else if (std::ranges::find(kOtherStatements, word) == kOtherStatements.end())
        in_.fail(fmt::format("\"{}\" is not an OBJ statement", word));
    }
    require_mesh();
    return std::move(mesh_);
  }

 private:
  void read_point() {
    mesh_.points.push_back(in_.point());
    if (mesh_.points.size() > kMaxMeshElements) in_.fail(fmt::format("more than {} vertices", kMaxMeshElements));
  }

  void read_face() {
    Triangle triangle{};
    std::size_t corners = 0;
    while (in_.has_field()) {
      const VertexId v = corner();
      if (corners < 3) triangle[corners] = v;
      ++corners;
    }
    if (corners != 3) in_.fail(fmt::format("face {} has {} vertices, expected 3", mesh_.triangles.size(), corners));
    mesh_.triangles.push_back(triangle);
    if (mesh_.triangles.size() > kMaxMeshElements) in_.fail(fmt::format("more than {} faces", kMaxMeshElements));
  }

  /// A corner `v`, `v/vt`, `v//vn` or `v/vt/vn`; v from 1, or backwards from -1.
  VertexId corner() {
    const std::string_view field = in_.field("vertex index");
    std::int64_t index = 0;
    if (!parse_integer(field.substr(0, field.find('/')), index))
      in_.fail(fmt::format("face {}: \"{}\" is not an index", mesh_.triangles.size(), field));
    const auto vertices = static_cast<std::int64_t>(mesh_.points.size());
    const std::int64_t from_zero = index > 0 ? index - 1 : vertices + index;
    if (index == 0 || from_zero < 0 || from_zero >= static_cast<std::int64_t>(kMaxMeshElements))
      in_.fail(fmt::format("face {}: vertex index {} is out of range", mesh_.triangles.size(), index));
    if (from_zero >= vertices) remember_forward(from_zero);
    return static_cast<VertexId>(from_zero);
  }

  /// A face may come before its vertices; whether they came is known at the end.
  void remember_forward(std::int64_t index) {
    if (index <= highest_.index) return;
    highest_ = {index, mesh_.triangles.size(), in_.line()};
  }

  void require_mesh() const {
    if (mesh_.points.empty()) in_.fail("the file has no vertices");
    if (highest_.index >= static_cast<std::int64_t>(mesh_.points.size()))
      throw InvalidInput(fmt::format("{}:{}: face {}: vertex index {} is out of range, there are {} vertices, counted from 1", in_.name(),
                                     highest_.line, highest_.face, highest_.index + 1, mesh_.points.size()));
  }

  struct ForwardIndex {
    std::int64_t index = -1;
    std::size_t face = 0;
    std::size_t line = 0;
  };

  TextReader in_;
  TriangleMesh mesh_;
  ForwardIndex highest_;
};

}  // namespace

TriangleMesh parse_obj(std::string_view text, const std::string& name) {
  return Parser(text, name).parse();
}

std::string format_obj(const TriangleMesh& mesh, const MeshWriteOptions& options) {
  TextWriter out(options.digits);
  out.reserve(mesh.points.size(), mesh.triangles.size());
  for (const Vec3& p : mesh.points) out.text("v ").point(p).text("\n");
  for (const auto& [a, b, c] : mesh.triangles) {
    out.text("f ").integer(std::uint64_t{a} + 1).text(" ").integer(std::uint64_t{b} + 1).text(" ").integer(std::uint64_t{c} + 1).text("\n");
  }
  return out.take();
}

}  // namespace smopt
