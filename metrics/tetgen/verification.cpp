#include "metrics/tetgen/verification.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "metrics/tetgen/shells.h"

namespace smopt::metrics {
namespace {

/// Relative error allowed in volumes and areas; the contract of the program's documentation.
constexpr double kRelativeTolerance = 1e-9;
/// Rounding of a coordinate that TetGen computes (a point on a segment): some units in the last place of the largest coordinate.
constexpr double kCoordinateRounding = 16 * std::numeric_limits<double>::epsilon();

Triangle sorted_corners(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// How many tetrahedra have a given face.
class FaceTable {
 public:
  explicit FaceTable(const TetMesh& mesh) {
    faces_.reserve(4 * mesh.tetrahedra.size());
    for (const auto& [a, b, c, d] : mesh.tetrahedra)
      for (const Triangle& face : {Triangle{a, b, c}, Triangle{a, b, d}, Triangle{a, c, d}, Triangle{b, c, d}})
        faces_.push_back(sorted_corners(face));
    std::sort(faces_.begin(), faces_.end());
  }

  [[nodiscard]] std::size_t uses(const Triangle& face) const {
    const auto [first, last] = std::equal_range(faces_.begin(), faces_.end(), sorted_corners(face));
    return static_cast<std::size_t>(last - first);
  }

 private:
  std::vector<Triangle> faces_;
};

double area(const std::vector<Vec3>& points, const Triangle& t) {
  return 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).norm();
}

double longest_side(const std::vector<Vec3>& points, const Triangle& t) {
  return std::max({(points[t[1]] - points[t[0]]).norm(), (points[t[2]] - points[t[1]]).norm(), (points[t[0]] - points[t[2]]).norm()});
}

class Verification {
 public:
  Verification(const TriangleMesh& surface, const TetMesh& result, bool boundary_kept)
      : surface_(surface), result_(result), boundary_kept_(boundary_kept), table_(result), shells_(find_shells(surface)) {
    for (const Vec3& p : surface.points) largest_coordinate_ = std::max(largest_coordinate_, p.cwiseAbs().maxCoeff());
  }

  std::string run() {
    using Check = std::string (Verification::*)() const;
    for (const Check check : {&Verification::no_tetrahedra, &Verification::lost_points, &Verification::stray_boundary_faces,
                              &Verification::broken_triangles, &Verification::wrong_volume})
      if (std::string why = (this->*check)(); !why.empty()) return why;
    return {};
  }

 private:
  [[nodiscard]] std::string no_tetrahedra() const {
    if (!result_.tetrahedra.empty()) return {};
    const bool open = std::any_of(shells_.volume.begin(), shells_.volume.end(), [](const auto& volume) { return !volume; });
    return open ? "no tetrahedra: the surface is not closed" : "no tetrahedra";
  }

  [[nodiscard]] std::string lost_points() const {
    if (result_.points.size() < surface_.points.size()) return "points of the surface are missing";
    std::vector<bool> used(result_.points.size(), false);
    for (const auto& corners : result_.tetrahedra)
      for (const VertexId v : corners) used[v] = true;
    for (std::size_t v = 0; v < surface_.points.size(); ++v) {
      if (!used[v]) return fmt::format("point {} is in no tetrahedron", v);
      if (result_.points[v] != surface_.points[v]) return fmt::format("point {} was moved", v);
    }
    return {};
  }

  [[nodiscard]] std::string stray_boundary_faces() const {
    for (std::size_t i = 0; i < result_.boundary_faces.size(); ++i) {
      if (result_.surface_triangle[i] >= surface_.triangle_count()) return fmt::format("boundary face {} belongs to no triangle", i);
      if (table_.uses(result_.boundary_faces[i]) == 0) return fmt::format("boundary face {} is not a face of a tetrahedron", i);
    }
    return {};
  }

  [[nodiscard]] std::string broken_triangles() const { return boundary_kept_ ? triangles_not_kept() : triangles_not_tiled(); }

  [[nodiscard]] std::string triangles_not_kept() const {
    for (std::size_t f = 0; f < surface_.triangle_count(); ++f)
      if (table_.uses(surface_.triangles[f]) == 0) return fmt::format("triangle {} is not a face of a tetrahedron", f);
    return {};
  }

  [[nodiscard]] std::string triangles_not_tiled() const {
    std::vector<double> covered(surface_.triangle_count(), 0.0);
    for (std::size_t i = 0; i < result_.boundary_faces.size(); ++i) {
      const FaceId f = result_.surface_triangle[i];
      if (!lies_in(result_.boundary_faces[i], surface_.triangles[f]))
        return fmt::format("a boundary face of triangle {} does not lie in it", f);
      covered[f] += area(result_.points, result_.boundary_faces[i]);
    }
    for (std::size_t f = 0; f < surface_.triangle_count(); ++f) {
      const double whole = area(surface_.points, surface_.triangles[f]);
      const double rounding = kCoordinateRounding * largest_coordinate_ * longest_side(surface_.points, surface_.triangles[f]);
      if (covered[f] == 0.0) return fmt::format("triangle {} has no boundary face", f);
      if (std::abs(covered[f] - whole) > kRelativeTolerance * whole + rounding)
        return fmt::format("the boundary faces of triangle {} do not tile it (area {:.12g}, should be {:.12g})", f, covered[f], whole);
    }
    return {};
  }

  /// In the triangle's plane and within its sides, but for rounding.
  [[nodiscard]] bool lies_in(const Triangle& face, const Triangle& triangle) const {
    const Vec3& a = surface_.points[triangle[0]];
    const Vec3 doubled_area = (surface_.points[triangle[1]] - a).cross(surface_.points[triangle[2]] - a);
    const double size = longest_side(surface_.points, triangle);
    const double tolerance = kRelativeTolerance * size + kCoordinateRounding * largest_coordinate_;
    if (doubled_area.norm() == 0) return true;  // degenerate: any plane through it will do, and its area is checked
    const Vec3 normal = doubled_area.normalized();
    for (const VertexId v : face) {
      const Vec3& p = result_.points[v];
      if (std::abs(normal.dot(p - a)) > tolerance + plane_error(triangle, p, doubled_area.norm())) return false;
      for (int i = 0; i < 3; ++i) {
        const Vec3& from = surface_.points[triangle[i]];
        const Vec3 side = surface_.points[triangle[(i + 1) % 3]] - from;
        if (side.cross(p - from).dot(normal) < -tolerance * side.norm()) return false;
      }
    }
    return true;
  }

  /// How far rounding may tilt the computed plane of a thin triangle at the point p.
  [[nodiscard]] double plane_error(const Triangle& t, const Vec3& p, double doubled_area) const {
    const double size = longest_side(surface_.points, t);
    const double reach = (p - surface_.points[t[0]]).norm();
    return kCoordinateRounding * size * size * reach / doubled_area;
  }

  [[nodiscard]] std::string wrong_volume() const {
    std::string why;
    const double expected = enclosed_volume(why);
    if (!why.empty()) return why;
    double sum = 0;
    for (const auto& [a, b, c, d] : result_.tetrahedra) sum += sixfold_volume(a, b, c, d) / 6;
    if (std::abs(sum - expected) <= kRelativeTolerance * expected) return {};
    return fmt::format("the volumes of the tetrahedra sum to {:.12g}, the surface encloses {:.12g}", sum, expected);
  }

  [[nodiscard]] double sixfold_volume(VertexId a, VertexId b, VertexId c, VertexId d) const {
    const Vec3& o = result_.points[a];
    return (result_.points[b] - o).dot((result_.points[c] - o).cross(result_.points[d] - o));
  }

  /// The volume of the shells that have tetrahedra on one side only; a shell with tetrahedra on both is a filled cavity or an island in
  /// one.
  double enclosed_volume(std::string& why) const {
    std::vector<bool> outer(shells_.volume.size(), false);
    std::vector<bool> inner(shells_.volume.size(), false);
    for (std::size_t i = 0; i < result_.boundary_faces.size(); ++i) {
      const std::uint32_t shell = shells_.of_triangle[result_.surface_triangle[i]];
      (table_.uses(result_.boundary_faces[i]) == 1 ? outer : inner)[shell] = true;
    }
    double volume = 0;
    for (std::size_t s = 0; s < shells_.volume.size(); ++s) {
      if (!shells_.volume[s]) why = "the surface is not closed: what it encloses cannot be compared with the tetrahedra";
      if (outer[s] && inner[s]) why = "a closed part of the surface has tetrahedra on both sides in one place and on one side in another";
      if (outer[s]) volume += shells_.volume[s].value_or(0);
    }
    return volume;
  }

  const TriangleMesh& surface_;
  const TetMesh& result_;
  bool boundary_kept_;
  FaceTable table_;
  Shells shells_;
  double largest_coordinate_ = 0;
};

}  // namespace

std::string why_not_a_mesh_of(const TriangleMesh& surface, const TetMesh& result, bool boundary_kept) {
  return Verification(surface, result, boundary_kept).run();
}

}  // namespace smopt::metrics
