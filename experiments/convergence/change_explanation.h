#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "experiments/convergence/critical_points.h"
#include "experiments/convergence/topology_changes.h"
#include "smopt/mesh/components.h"
#include "smopt/surface/adaptive_partition.h"

namespace smopt::experiments {

/// The surface for one error.
struct AdaptiveMesh {
  double error = 0;        ///< ångström
  double finest_edge = 0;  ///< of the smallest cell that the surface crosses, ångström
  AdaptivePartition partition;
  TriangleMesh mesh;
};

/// A critical point near a place where the topology changed.
struct ExplainingPoint {
  CriticalPoint point;
  /// |φ − c| over ½·max|λ|·E², E the coarser error: a surface within E of φ = c cannot miss a critical point with more than 1, because the
  /// part of φ = c that hangs on it reaches farther than E from it.
  double ratio = 0;
  std::optional<double> coarser;  ///< the interpolants' value − c at the point
  std::optional<double> finer;
};

/// What a change of topology has to do with the critical points around it.
enum class Explanation {
  passed,  ///< the interpolants have different signs at some, and what these add to the Euler characteristic is the change
  specks,  ///< not so, and the change is the coming and going of specks: it is the sampling's
  beside,  ///< neither, but one that a surface within E may miss is there: interpolants flat near it cross c elsewhere, or several times
  none     ///< neither, and no critical point there is near enough to c
};

std::string_view to_string(Explanation explanation);

/// What happens at a critical point when it comes to lie inside or outside.
std::string_view event_name(const CriticalPoint& point, bool is_now_inside);

struct ExplainedChange {
  TopologyChange place;
  Explanation explanation = Explanation::none;
  /// passed: those whose sign changed, largest ratio first. Otherwise the one of the least ratio; empty where there is no critical point.
  std::vector<ExplainingPoint> points;
  std::int64_t specks_before = 0;           ///< in the coarser mesh; see `kSpeckVertices`
  std::int64_t specks_after = 0;            ///< in the finer mesh
  double largest_distance = 0;              ///< of both meshes' vertices in the place to φ = c, ångström
  std::optional<double> least_bend_radius;  ///< least radius of curvature of φ = c where these vertices are, ångström

  /// Of the first point; nothing where there is none.
  [[nodiscard]] std::optional<double> ratio() const { return points.empty() ? std::nullopt : std::optional(points.front().ratio); }
};

/// Finds where the topology changes from the coarser to the finer mesh, and why.
/// \pre both are of this field and isovalue. Cost: O(n) and that of `critical_points_near`.
std::vector<ExplainedChange> explained_changes(const GaussianField& field, double isovalue, const AdaptiveMesh& coarser,
                                               const AdaptiveMesh& finer);

/// How many vertices each component has. \pre every vertex is in a triangle
std::vector<std::size_t> vertices_of(const Components& components);

/// A component of so many vertices or fewer is a speck: one node of the grid, or two neighbours, on the other side than all around them.
inline constexpr std::size_t kSpeckVertices = 10;

/// The least radius of curvature of the level set through x, ångström; infinite where it is flat. \pre ∇φ(x) is not zero
double bend_radius(const GaussianField& field, const Vec3& x);

}  // namespace smopt::experiments
