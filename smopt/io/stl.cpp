#include "smopt/io/stl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "smopt/error.h"
#include "smopt/io/bytes.h"
#include "smopt/io/text_reader.h"

namespace smopt {
namespace {

/// Binary layout: a comment of 80 bytes, a 32-bit count, and for each triangle a normal and three corners in float32 and two spare bytes.
constexpr std::size_t kCommentBytes = 80;
constexpr std::size_t kHeaderBytes = kCommentBytes + 4;
constexpr std::size_t kNormalBytes = 3 * sizeof(float);
constexpr std::size_t kTriangleBytes = 4 * kNormalBytes + 2;

/// Makes one vertex of all corners at the same position.
class VertexMerger {
 public:
  explicit VertexMerger(std::vector<Vec3>& points) : points_(points) {}

  /// Makes room for the vertices of a closed surface: half as many as it has triangles.
  void reserve(std::size_t triangles) {
    points_.reserve(triangles / 2 + 2);
    ids_.reserve(triangles / 2 + 2);
  }

  VertexId vertex(const Vec3& p) {
    const auto [it, is_new] = ids_.try_emplace(key_of(p), static_cast<VertexId>(points_.size()));
    if (is_new) points_.push_back(p);
    return it->second;
  }

 private:
  using Key = std::array<std::uint64_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t hash = 0;
      for (const std::uint64_t bits : key) {
        // Multiplication by 2^64 / golden ratio spreads neighbouring values (Knuth, volume 3, section 6.4).
        hash = (hash ^ bits) * 0x9E3779B97F4A7C15U;
        hash ^= hash >> 32;
      }
      return hash;
    }
  };

  /// Adding zero makes -0 the 0 that it equals.
  static Key key_of(const Vec3& p) {
    return {std::bit_cast<std::uint64_t>(p.x() + 0.0), std::bit_cast<std::uint64_t>(p.y() + 0.0),
            std::bit_cast<std::uint64_t>(p.z() + 0.0)};
  }

  std::vector<Vec3>& points_;
  std::unordered_map<Key, VertexId, Hash> ids_;
};

std::uint32_t binary_count(std::string_view bytes) {
  return load<std::uint32_t>(bytes.data() + kCommentBytes, std::endian::little);
}

bool is_binary(std::string_view bytes) {
  return bytes.size() >= kHeaderBytes && bytes.size() == kHeaderBytes + std::size_t{binary_count(bytes)} * kTriangleBytes;
}

Vec3 load_point(const char* bytes) {
  Vec3 p;
  for (int k = 0; k < 3; ++k)
    p[k] = static_cast<double>(load<float>(bytes + static_cast<std::size_t>(k) * sizeof(float), std::endian::little));
  return p;
}

TriangleMesh parse_binary(std::string_view bytes) {
  TriangleMesh mesh;
  mesh.triangles.resize(binary_count(bytes));
  VertexMerger merger(mesh.points);
  merger.reserve(mesh.triangles.size());
  const char* corner = bytes.data() + kHeaderBytes;
  for (Triangle& triangle : mesh.triangles) {
    corner += kNormalBytes;
    for (VertexId& v : triangle) {
      v = merger.vertex(load_point(corner));
      corner += kNormalBytes;
    }
    corner += 2;
  }
  return mesh;
}

bool equals_ignoring_case(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

bool begins_as_text(std::string_view bytes) {
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && equals_ignoring_case(bytes.substr(begin, 5), "solid");
}

class TextParser {
 public:
  TextParser(std::string_view text, const std::string& name) : in_(text, name), merger_(mesh_.points) {}

  TriangleMesh parse() {
    while (in_.next_line()) {
      expect("solid");
      read_solid();
    }
    return std::move(mesh_);
  }

 private:
  void read_solid() {
    while (true) {
      in_.require_line("endsolid");
      const std::string_view word = in_.field("keyword");
      if (equals_ignoring_case(word, "endsolid")) return;
      if (!equals_ignoring_case(word, "facet")) fail_at(word, "facet or endsolid");
      read_facet();
    }
  }

  void read_facet() {
    expect_line("outer");
    expect("loop");
    std::size_t corners = 0;
    Triangle triangle{};
    while (is_vertex_line()) {
      const Vec3 p = in_.point();
      if (corners < 3) triangle[corners] = merger_.vertex(p);
      ++corners;
    }
    if (corners != 3) in_.fail(fmt::format("face {} has {} vertices, expected 3", mesh_.triangles.size(), corners));
    expect_line("endfacet");
    mesh_.triangles.push_back(triangle);
  }

  /// Goes to the next line, which has to be a vertex or the end of the loop.
  bool is_vertex_line() {
    in_.require_line("endloop");
    const std::string_view word = in_.field("keyword");
    if (equals_ignoring_case(word, "vertex")) return true;
    if (!equals_ignoring_case(word, "endloop")) fail_at(word, "vertex or endloop");
    return false;
  }

  void expect_line(std::string_view keyword) {
    in_.require_line(keyword);
    expect(keyword);
  }

  void expect(std::string_view keyword) {
    const std::string_view word = in_.field("keyword");
    if (!equals_ignoring_case(word, keyword)) fail_at(word, keyword);
  }

  [[noreturn]] void fail_at(std::string_view word, std::string_view expected) const {
    in_.fail(fmt::format("\"{}\" where {} is expected", word, expected));
  }

  TextReader in_;
  TriangleMesh mesh_;
  VertexMerger merger_;
};

void append_point(std::string& out, const Vec3& p, std::size_t face) {
  for (int k = 0; k < 3; ++k) {
    if (std::isfinite(p[k]) && std::abs(p[k]) > static_cast<double>(std::numeric_limits<float>::max()))
      throw InvalidInput(fmt::format("face {}: coordinate {} is too large for STL's float32", face, p[k]));
    append_little_endian(out, static_cast<float>(p[k]));
  }
}

/// The unit normal, or zero where there is none (or no finite one).
Vec3 normal_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a).stableNormalized();
  return normal.allFinite() ? normal : Vec3(Vec3::Zero());
}

}  // namespace

TriangleMesh parse_stl(std::string_view bytes, const std::string& name) {
  if (bytes.empty()) throw InvalidInput(name + ": the file is empty");
  if (is_binary(bytes)) return parse_binary(bytes);
  if (begins_as_text(bytes)) return TextParser(bytes, name).parse();
  if (bytes.size() < kHeaderBytes)
    throw InvalidInput(fmt::format("{}: not an STL file: {} bytes that do not begin with solid", name, bytes.size()));
  throw InvalidInput(fmt::format("{}: the header counts {} triangles, which take {} bytes, and the file has {}", name, binary_count(bytes),
                                 kHeaderBytes + std::size_t{binary_count(bytes)} * kTriangleBytes, bytes.size()));
}

std::string format_stl(const TriangleMesh& mesh, const MeshWriteOptions&) {
  std::string out = "binary STL written by smopt";  // must not begin with "solid"
  out.resize(kCommentBytes, ' ');
  out.reserve(kHeaderBytes + mesh.triangles.size() * kTriangleBytes);
  append_little_endian(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
    const auto& [a, b, c] = mesh.triangles[face];
    append_point(out, normal_of(mesh.points[a], mesh.points[b], mesh.points[c]), face);
    for (const VertexId v : mesh.triangles[face]) append_point(out, mesh.points[v], face);
    append_little_endian(out, std::uint16_t{0});
  }
  return out;
}

}  // namespace smopt
