#include "smopt/mesh/nesting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <oneapi/tbb/enumerable_thread_specific.h>

#include "smopt/geometry/predicates.h"
#include "smopt/parallel.h"

namespace smopt {
namespace {

/// A ray in the direction +x from a component's point of largest x, so that it never meets its own component.
struct Ray {
  Vec3 origin;
  std::uint32_t component;
};

std::vector<Ray> rays_from_components(const TriangleMesh& mesh, const Components& components) {
  std::vector<Ray> rays(components.count);
  for (std::uint32_t i = 0; i < components.count; ++i) rays[i] = {Vec3::Constant(-std::numeric_limits<double>::infinity()), i};
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (components.of_vertex[v] == Components::kNone) continue;
    if (Ray& ray = rays[components.of_vertex[v]]; mesh.points[v][0] > ray.origin[0]) ray.origin = mesh.points[v];
  }
  return rays;
}

/// The rays sorted by the yz cell of their origin, so that a triangle is tested only against rays in the cells that its box covers.
class RayGrid {
 public:
  explicit RayGrid(std::vector<Ray> rays) : rays_(std::move(rays)) {
    low_ = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = -low_;
    for (const Ray& ray : rays_) {
      low_ = low_.cwiseMin(ray.origin);
      high = high.cwiseMax(ray.origin);
    }
    cells_ = std::clamp(static_cast<int>(kCellsPerRay * std::sqrt(static_cast<double>(rays_.size()))), 1, kMaxCells);
    cells_per_unit_ = ((high - low_) / cells_).cwiseMax(std::numeric_limits<double>::min()).cwiseInverse();
    sort_rays();
  }

  /// Calls visit(ray) for every ray whose line passes through the box.
  template <class Visit>
  void for_rays_in_box(const Vec3& low, const Vec3& high, const Visit& visit) const {
    const int y_begin = cell(low, 1), y_end = cell(high, 1), z_begin = cell(low, 2), z_end = cell(high, 2);
    for (int y = y_begin; y <= y_end; ++y) {
      const std::uint32_t end = cell_begin_[bucket(y, z_end) + 1];
      for (std::uint32_t i = cell_begin_[bucket(y, z_begin)]; i < end; ++i) {
        const Vec3& origin = rays_[i].origin;
        if (low[1] <= origin[1] && origin[1] <= high[1] && low[2] <= origin[2] && origin[2] <= high[2]) visit(rays_[i]);
      }
    }
  }

 private:
  /// Along one axis, for each ray along it if they were a square: most cells are empty, and most triangles meet no ray.
  static constexpr double kCellsPerRay = 4;
  static constexpr int kMaxCells = 1024;

  [[nodiscard]] int cell(const Vec3& p, int axis) const {
    return static_cast<int>(std::clamp((p[axis] - low_[axis]) * cells_per_unit_[axis], 0.0, cells_ - 1.0));
  }
  [[nodiscard]] std::size_t bucket(int y, int z) const { return static_cast<std::size_t>(y) * cells_ + z; }
  [[nodiscard]] std::size_t bucket(const Ray& ray) const { return bucket(cell(ray.origin, 1), cell(ray.origin, 2)); }

  void sort_rays() {
    std::ranges::stable_sort(rays_, {}, [&](const Ray& ray) { return bucket(ray); });
    cell_begin_.assign(static_cast<std::size_t>(cells_) * cells_ + 1, 0);
    for (const Ray& ray : rays_) ++cell_begin_[bucket(ray) + 1];
    std::partial_sum(cell_begin_.begin(), cell_begin_.end(), cell_begin_.begin());
  }

  std::vector<Ray> rays_;
  std::vector<std::uint32_t> cell_begin_;  // per cell, into rays_
  Vec3 low_, cells_per_unit_;
  int cells_ = 1;
};

/// Whether the ray's line in the yz plane passes an edge on its right: the half-open rule that counts each point of a closed surface's
/// outline once (an edge belongs to its lower end in z; a point exactly on an edge is never on its right).
bool passes_edge(const Vec3& origin, const Vec3& a, const Vec3& b) {
  const bool is_a_below = a[2] <= origin[2], is_b_below = b[2] <= origin[2];
  if (is_a_below == is_b_below) return false;
  const Vec3& low = is_a_below ? a : b;
  const Vec3& high = is_a_below ? b : a;
  return orient2d(low[1], low[2], high[1], high[2], origin[1], origin[2]) > 0;
}

bool ray_crosses(const Vec3& origin, const Vec3& a, const Vec3& b, const Vec3& c) {
  if (std::max({a[0], b[0], c[0]}) <= origin[0]) return false;
  const int passed = int{passes_edge(origin, a, b)} + int{passes_edge(origin, b, c)} + int{passes_edge(origin, c, a)};
  if (passed % 2 == 0) return false;
  const int origin_side = orient3d(a, b, c, origin);
  const int normal_x = orient2d(a[1], a[2], b[1], b[2], c[1], c[2]);  // sign of the normal's x component
  return origin_side * normal_x < 0;                                  // the origin lies on the side of smaller x
}

/// One crossing of the ray from a component with another component: (ray's component, crossed component).
using Crossing = std::pair<std::uint32_t, std::uint32_t>;

/// All crossings, sorted, so that it does not matter which thread found them.
std::vector<Crossing> find_crossings(const TriangleMesh& mesh, const Components& components) {
  const RayGrid grid(rays_from_components(mesh, components));
  tbb::enumerable_thread_specific<std::vector<Crossing>> found;
  for_ranges_in_parallel(mesh.triangle_count(), [&](std::size_t begin, std::size_t end) {
    std::vector<Crossing>& crossings = found.local();
    for (std::size_t f = begin; f < end; ++f) {
      const Vec3 &a = mesh.points[mesh.triangles[f][0]], &b = mesh.points[mesh.triangles[f][1]], &c = mesh.points[mesh.triangles[f][2]];
      grid.for_rays_in_box(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), [&](const Ray& ray) {
        if (ray.component != components.of_triangle[f] && ray_crosses(ray.origin, a, b, c))
          crossings.emplace_back(ray.component, components.of_triangle[f]);
      });
    }
  });
  std::vector<Crossing> all;
  for (const std::vector<Crossing>& crossings : found) all.insert(all.end(), crossings.begin(), crossings.end());
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

Nesting component_nesting(const TriangleMesh& mesh, const Components& components) {
  const std::vector<Crossing> crossings = find_crossings(mesh, components);
  Nesting nesting{std::vector<std::uint32_t>(components.count, 0), std::vector<std::vector<std::uint32_t>>(components.count)};
  for (auto it = crossings.begin(); it != crossings.end();) {
    const auto end = std::upper_bound(it, crossings.end(), *it);
    if ((end - it) % 2 == 1) nesting.enclosing[it->first].push_back(it->second);
    it = end;
  }
  for (std::size_t i = 0; i < components.count; ++i) nesting.depth[i] = static_cast<std::uint32_t>(nesting.enclosing[i].size());
  return nesting;
}

}  // namespace smopt
