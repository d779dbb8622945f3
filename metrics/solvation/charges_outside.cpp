#include "metrics/solvation/charges_outside.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <functional>
#include <vector>

namespace smopt::metrics {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Traits = CGAL::AABB_traits<Kernel, Primitive>;
using Tree = CGAL::AABB_tree<Traits>;
using Node = CGAL::AABB_node<Traits>;

Point to_cgal(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

Triangles triangles_of(const TriangleMesh& mesh) {
  Triangles triangles;
  triangles.reserve(mesh.triangle_count());
  for (const auto& [a, b, c] : mesh.triangles)
    triangles.emplace_back(to_cgal(mesh.points[a]), to_cgal(mesh.points[b]), to_cgal(mesh.points[c]));
  return triangles;
}

/// Whether a triangle with its boundary, which may have no area, holds a point.
bool holds(const Point& a, const Point& b, const Point& c, const Point& p) {
  if (!CGAL::coplanar(a, b, c, p)) return false;
  if (CGAL::collinear(a, b, c))
    return CGAL::are_ordered_along_line(a, p, b) || CGAL::are_ordered_along_line(b, p, c) || CGAL::are_ordered_along_line(c, p, a);
  const auto is_beyond = [&](const Point& from, const Point& to, const Point& opposite) {
    return CGAL::coplanar_orientation(from, to, opposite, p) == CGAL::NEGATIVE;
  };
  return !is_beyond(a, b, c) && !is_beyond(b, c, a) && !is_beyond(c, a, b);
}

/// On which side of the line from `a` to `b` a point lies, all three seen from above and the point moved by (δ, δ²) for a δ below any number
/// but 0; zero only where `a` and `b` are one point from above.
int side_from_above(const Point& a, const Point& b, const Point& p) {
  const auto flat = [](const Point& q) { return Kernel::Point_2(q.x(), q.y()); };
  const CGAL::Orientation side = CGAL::orientation(flat(a), flat(b), flat(p));
  if (side != CGAL::COLLINEAR) return side;
  if (a.y() != b.y()) return a.y() > b.y() ? 1 : -1;
  return CGAL::compare(b.x(), a.x());
}

/// Whether the ray straight up from a point, moved aside likewise, crosses a triangle that does not hold the point.
bool is_crossed(const Point& a, const Point& b, const Point& c, const Point& p) {
  const int side = side_from_above(a, b, p);
  if (side == 0 || side_from_above(b, c, p) != side || side_from_above(c, a, p) != side) return false;
  // Seen from above the corners run anticlockwise where `side` is 1; a point below them is then on the plane's negative side.
  return CGAL::orientation(a, b, c, p) == -side;
}

/// Looks from a point straight up; the tree hands it the triangles above.
class UpwardLook {
 public:
  [[nodiscard]] bool go_further() const { return !is_on_surface_; }
  [[nodiscard]] bool do_intersect(const Point& p, const Node& node) const {
    const CGAL::Bbox_3 box = node.bbox();
    return box.xmin() <= p.x() && p.x() <= box.xmax() && box.ymin() <= p.y() && p.y() <= box.ymax() && p.z() <= box.zmax();
  }
  void intersection(const Point& p, const Primitive& primitive) {
    const Kernel::Triangle_3& t = *primitive.id();
    if (holds(t[0], t[1], t[2], p))
      is_on_surface_ = true;
    else if (is_crossed(t[0], t[1], t[2], p))
      is_inside_ = !is_inside_;
  }

  [[nodiscard]] bool is_enclosed() const { return is_inside_ && !is_on_surface_; }

 private:
  bool is_on_surface_ = false;
  bool is_inside_ = false;
};

bool is_enclosed(const Tree& surface, const Point& p) {
  UpwardLook look;
  surface.traversal(p, look);
  return look.is_enclosed();
}

}  // namespace

std::size_t count_charges_outside(const TriangleMesh& surface, const Molecule& molecule) {
  const Triangles triangles = triangles_of(surface);
  Tree tree(triangles.begin(), triangles.end());
  tree.build();
  using Range = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Range(0, molecule.atom_count()), std::size_t{0},
      [&](const Range& atoms, std::size_t outside) {
        for (std::size_t i = atoms.begin(); i < atoms.end(); ++i)
          if (molecule.charges[i] != 0 && !is_enclosed(tree, to_cgal(molecule.centers[i]))) ++outside;
        return outside;
      },
      std::plus<>());
}

}  // namespace smopt::metrics
