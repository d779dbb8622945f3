#include "metrics/solvation/close_matrix.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "metrics/solvation/batches.h"

namespace smopt::metrics {
namespace {

/// How high the surface at y lies above the tangent plane at x, by the normals at both ends, or at one if the other has none.
double height_along(const Vec3& x, const Vec3& normal_at_x, const Vec3& y, const Vec3& normal_at_y) {
  if (normal_at_y == Vec3::Zero()) return normal_at_x.dot(y - x);
  if (normal_at_x == Vec3::Zero()) return -normal_at_y.dot(y - x);
  return 0.5 * (normal_at_x - normal_at_y).dot(y - x);
}

/// Fills one row.
class RowIntegration {
 public:
  RowIntegration(const DiscreteSurface& surface, const KernelParameters& parameters, const TriangleQuadrature& quadrature)
      : surface_(surface), parameters_(parameters), quadrature_(quadrature) {}

  /// \param sources  ascending.
  void fill(const TargetPoint& target, std::span<const VertexId> sources, std::span<KernelValues> values) const {
    for (const FaceId f : faces_around(sources)) {
      const CornerIntegrals integrals = over_face(target, surface_.mesh.triangles[f]);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const auto at = std::ranges::lower_bound(sources, surface_.mesh.triangles[f][corner]);
        if (at == sources.end() || *at != surface_.mesh.triangles[f][corner]) continue;
        values[static_cast<std::size_t>(at - sources.begin())].add(integrals[corner]);
      }
    }
  }

 private:
  [[nodiscard]] std::vector<FaceId> faces_around(std::span<const VertexId> vertices) const {
    std::vector<FaceId> faces;
    for (const VertexId v : vertices) faces.insert(faces.end(), surface_.stars[v].begin(), surface_.stars[v].end());
    std::ranges::sort(faces);
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }

  [[nodiscard]] CornerIntegrals over_face(const TargetPoint& target, const Triangle& t) const {
    const std::array<Vec3, 3> corners = {surface_.mesh.points[t[0]], surface_.mesh.points[t[1]], surface_.mesh.points[t[2]]};
    for (std::size_t c = 0; c < 3; ++c)
      if (corners[c] == target.position) return over_face_at_corner(target, t, c);
    const SideHeights heights = {height_along(t[0], t[1]), height_along(t[1], t[2]), height_along(t[2], t[0])};
    return integrate(target, corners, heights, parameters_, quadrature_);
  }

  [[nodiscard]] CornerIntegrals over_face_at_corner(const TargetPoint& target, const Triangle& t, std::size_t at) const {
    const std::size_t a = (at + 1) % 3, b = (at + 2) % 3;
    const auto& points = surface_.mesh.points;
    const auto& patches = surface_.patches;
    const SideHeights heights = {metrics::height_along(target.position, target.normal, points[t[a]], patches[t[a]].normal),
                                 height_along(t[a], t[b]),
                                 metrics::height_along(target.position, target.normal, points[t[b]], patches[t[b]].normal)};
    const CornerIntegrals turned =
        integrate_at_corner(target, {points[t[at]], points[t[a]], points[t[b]]}, heights, parameters_, quadrature_);
    CornerIntegrals integrals;
    integrals[at] = turned[0];
    integrals[a] = turned[1];
    integrals[b] = turned[2];
    return integrals;
  }

  [[nodiscard]] double height_along(VertexId v, VertexId w) const {
    return metrics::height_along(surface_.mesh.points[v], surface_.patches[v].normal, surface_.mesh.points[w], surface_.patches[w].normal);
  }

  const DiscreteSurface& surface_;
  const KernelParameters& parameters_;
  const TriangleQuadrature& quadrature_;
};

}  // namespace

CloseMatrix::CloseMatrix(const NearField& near, const DiscreteSurface& surface, std::size_t first, std::size_t targets,
                         const std::function<TargetPoint(std::size_t)>& target_of, const KernelParameters& parameters,
                         const TriangleQuadrature& quadrature, const ProgressCallback& progress)
    : offsets_(targets + 1, 0) {
  const std::size_t leaves = near.leaves().size();
  // Calls visit(target, source) for the pairs of a leaf that have a place in the matrix.
  const auto visit_entries = [&](std::size_t leaf, const auto& visit) {
    near.visit_close_pairs(near.leaves()[leaf], [&](std::uint32_t target, std::uint32_t source) {
      if (target >= first && target - first < targets && source < surface.size()) visit(target - first, source);
    });
  };
  tbb::parallel_for(std::size_t{0}, leaves,
                    [&](std::size_t leaf) { visit_entries(leaf, [&](std::size_t target, VertexId) { ++offsets_[target + 1]; }); });
  for (std::size_t i = 0; i < targets; ++i) offsets_[i + 1] += offsets_[i];
  sources_.resize(offsets_.back());
  values_.resize(offsets_.back());
  const RowIntegration integration(surface, parameters, quadrature);
  in_batches(leaves, progress, "close pairs", [&](std::size_t leaf) {
    std::size_t last = targets;
    std::size_t filled = 0;
    visit_entries(leaf, [&](std::size_t target, VertexId source) {
      if (target != last) filled = 0;
      last = target;
      sources_[offsets_[target] + filled++] = source;
    });
    for (const std::uint32_t point : near.points_of(near.leaves()[leaf])) {
      if (point < first || point - first >= targets) continue;
      const std::size_t row = point - first;
      const auto sources = std::span(sources_).subspan(offsets_[row], offsets_[row + 1] - offsets_[row]);
      std::ranges::sort(sources);
      integration.fill(target_of(row), sources, std::span(values_).subspan(offsets_[row], sources.size()));
    }
  });
}

}  // namespace smopt::metrics
