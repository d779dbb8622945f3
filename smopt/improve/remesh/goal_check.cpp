#include "smopt/improve/remesh/goal_check.h"

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "smopt/geometry/triangle_shape.h"
#include "smopt/improve/remesh/patch_shape.h"
#include "smopt/parallel.h"

namespace smopt {
namespace {

enum Goal : std::size_t { kMinAngle, kMaxAngle, kEdgeRatio, kDihedral, kValence, kGoals };

/// The worst of all elements of one kind, and how many miss the goal.
struct Worst {
  double badness = -std::numeric_limits<double>::infinity();  // larger is worse
  std::uint32_t element = 0;
  VertexId at = kNoVertex;
  std::size_t missing = 0;

  void add(double value, double limit, std::uint32_t id, VertexId vertex) {
    missing += value > limit ? 1 : 0;
    if (value > badness || (value == badness && std::pair(id, vertex) < std::pair(element, at))) {
      badness = value;
      element = id;
      at = vertex;
    }
  }
  void unite(const Worst& other) {
    const std::size_t sum = missing + other.missing;
    if (other.badness > badness || (other.badness == badness && std::pair(other.element, other.at) < std::pair(element, at))) *this = other;
    missing = sum;
  }
};

using AllWorst = std::array<Worst, kGoals>;

/// The goals as limits of badness.
std::array<double, kGoals> limits_of(const RemeshGoals& goals) {
  return {-goals.min_angle_deg, goals.max_angle_deg, -goals.edge_ratio, -goals.min_dihedral_deg, static_cast<double>(goals.valence_spread)};
}

class GoalScan {
 public:
  explicit GoalScan(const RemeshState& state) : surface_(state.surface), limits_(limits_of(state.options.goals)) {}

  AllWorst run() {
    tbb::enumerable_thread_specific<AllWorst> of_threads;
    for_ranges_in_parallel(surface_.mesh().vertex_count(), [&](std::size_t begin, std::size_t end) {
      AllWorst& worst = of_threads.local();
      for (auto v = static_cast<VertexId>(begin); v < end; ++v)
        if (surface_.is_in_use(v)) add_vertex(v, worst);
    });
    AllWorst all;
    for (const AllWorst& part : of_threads)
      for (std::size_t goal = 0; goal < kGoals; ++goal) all[goal].unite(part[goal]);
    return all;
  }

 private:
  void add_vertex(VertexId v, AllWorst& worst) const {
    worst[kValence].add(std::abs(static_cast<double>(surface_.valence(v)) - 6), limits_[kValence], v, v);
    const std::span<const FaceId> faces = surface_.rings().faces(v);
    const std::span<const VertexId> ring = surface_.rings().vertices(v);
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const Triangle& t = surface_.mesh().triangles[faces[k]];
      if (std::min({t[0], t[1], t[2]}) == v) add_triangle(faces[k], t, v, worst);
      if (v < ring[k]) add_edge(t, surface_.mesh().triangles[faces[k > 0 ? k - 1 : faces.size() - 1]], faces[k], v, worst);
    }
  }
  void add_triangle(FaceId f, const Triangle& t, VertexId v, AllWorst& worst) const {
    const TriangleShape shape = shape_of(surface_.point(t[0]), surface_.point(t[1]), surface_.point(t[2]));
    worst[kMinAngle].add(-shape.smallest_angle * kDegrees, limits_[kMinAngle], f, v);
    worst[kMaxAngle].add(shape.largest_angle * kDegrees, limits_[kMaxAngle], f, v);
    worst[kEdgeRatio].add(-shape.edge_ratio, limits_[kEdgeRatio], f, v);
  }
  void add_edge(const Triangle& left, const Triangle& right, std::uint32_t id, VertexId v, AllWorst& worst) const {
    const double dihedral = dihedral_angle(normal_of(left).dot(normal_of(right)));
    worst[kDihedral].add(-dihedral * kDegrees, limits_[kDihedral], id, v);
  }
  [[nodiscard]] Vec3 normal_of(const Triangle& t) const {
    return doubled_area_vector(surface_.point(t[0]), surface_.point(t[1]), surface_.point(t[2])).normalized();
  }

  const EditableSurface& surface_;
  std::array<double, kGoals> limits_;
};

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::not_manifold:
      return "would not keep the topology";
    case Verdict::no_gain:
      return "would not help";
    case Verdict::bends:
      return "would bend the surface sharply";
    case Verdict::too_many_neighbours:
      return "would give a vertex too many neighbours";
    case Verdict::meets:
      return "would meet another triangle";
    case Verdict::deviates:
      return "would leave the bound on the deviation";
    case Verdict::refused:
      return "refused";
    default:
      return "possible";
  }
}

std::string to_text(const std::string& what, const VerdictCounts& counts) {
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[i], name_of(static_cast<Verdict>(i)));
  return text.empty() ? "" : fmt::format("; {}: {}", what, text);
}

/// What every operation around the vertex would come to.
std::string refusals_around(const RemeshState& state, VertexId center, SurfaceWorker& worker) {
  std::array<VerdictCounts, kOperationKinds> operations{};
  VerdictCounts moves{};
  worker.judge_all(center, operations, moves);
  for (const VertexId w : state.surface.rings().vertices(center))
    if (misses_a_goal(state, w)) worker.judge_all(w, operations, moves);
  std::string text;
  for (const OperationKind kind : {kFlip, kCollapse, kSplit}) text += to_text(operation(kind).plural, operations[kind]);
  return text + to_text("moves", moves);
}

}  // namespace

std::vector<GoalOutcome> check_goals(const RemeshState& state, SurfaceWorker& worker) {
  static constexpr std::array<const char*, kGoals> kNames = {"min-angle", "max-angle", "edge-ratio", "min-dihedral", "valence"};
  static constexpr std::array<const char*, kGoals> kElements = {"triangles", "triangles", "triangles", "edges", "vertices"};
  const AllWorst all = GoalScan(state).run();
  const std::array<double, kGoals> limits = limits_of(state.options.goals);
  std::vector<GoalOutcome> outcomes;
  for (std::size_t i = 0; i < kGoals; ++i) {
    const Worst& worst = all[i];
    if (worst.at == kNoVertex) continue;
    GoalOutcome outcome{kNames[i], std::abs(limits[i]), std::abs(worst.badness), worst.missing, {}};
    if (worst.missing > 0) {
      const Vec3& p = state.surface.point(worst.at);
      outcome.explanation = fmt::format("{} {} miss it; the worst at ({:.3f}, {:.3f}, {:.3f}){}", worst.missing, kElements[i], p[0], p[1],
                                        p[2], refusals_around(state, worst.at, worker));
    }
    outcomes.push_back(std::move(outcome));
  }
  return outcomes;
}

bool has_bad_shape(const RemeshState& state, VertexId v) {
  const Vec3& x = state.surface.point(v);
  return star_quality_at(state, v, x) < 1 || star_bend_at(state, v, x) < 1;
}

bool misses_a_goal(const RemeshState& state, VertexId v) {
  return std::abs(state.excess(v)) > state.options.goals.valence_spread || has_bad_shape(state, v);
}

}  // namespace smopt
