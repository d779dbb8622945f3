#include "experiments/convergence/change_explanation.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "experiments/convergence/interpolant.h"
#include "smopt/surface/level_set_distance.h"
#include "smopt/surface/place_map.h"

namespace smopt::experiments {
namespace {

class Explainer {
 public:
  Explainer(const GaussianField& field, double isovalue, const AdaptiveMesh& coarser, const AdaptiveMesh& finer)
      : field_(field), isovalue_(isovalue), coarser_(coarser), finer_(finer) {}

  [[nodiscard]] ExplainedChange explain(TopologyChange place) const {
    ExplainedChange change;
    change.place = std::move(place);
    std::vector<ExplainingPoint> points = points_near(change.place);
    std::vector<ExplainingPoint> passed = passed_of(points);
    if (!passed.empty() && gain_of(passed) == change.place.change) {
      change.explanation = Explanation::passed;
      change.points = std::move(passed);
      std::reverse(change.points.begin(), change.points.end());
    } else if (!points.empty()) {
      change.explanation = points.front().ratio <= 1 ? Explanation::beside : Explanation::none;
      change.points = {points.front()};
    }
    return change;
  }

 private:
  /// Ascending by ratio.
  [[nodiscard]] std::vector<ExplainingPoint> points_near(const TopologyChange& place) const {
    std::vector<ExplainingPoint> points;
    for (const CriticalPoint& point : critical_points_near(field_, isovalue_, coarser_.partition.lattice, place.cells)) {
      const double may_be_missed = 0.5 * point.largest_curvature() * coarser_.error * coarser_.error;
      points.push_back({point, std::abs(point.value - isovalue_) / may_be_missed, interpolant_at(coarser_.partition, point.position),
                        interpolant_at(finer_.partition, point.position)});
    }
    std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.ratio < b.ratio; });
    return points;
  }

  static std::vector<ExplainingPoint> passed_of(const std::vector<ExplainingPoint>& points) {
    std::vector<ExplainingPoint> passed;
    for (const ExplainingPoint& point : points) {
      if (point.coarser && point.finer && (*point.coarser >= 0) != (*point.finer >= 0)) passed.push_back(point);
    }
    return passed;
  }

  static std::int64_t gain_of(const std::vector<ExplainingPoint>& passed) {
    std::int64_t gain = 0;
    for (const ExplainingPoint& point : passed) gain += (*point.finer >= 0 ? 1 : -1) * point.point.gain_when_inside();
    return gain;
  }

  const GaussianField& field_;
  double isovalue_;
  const AdaptiveMesh& coarser_;
  const AdaptiveMesh& finer_;
};

/// Looks at the vertices that a mesh has in the places of the changes.
class PlaceVisitor {
 public:
  PlaceVisitor(const CellLattice& lattice, std::vector<ExplainedChange>& changes) : lattice_(lattice), changes_(changes) {
    for (std::size_t i = 0; i < changes.size(); ++i) {
      for (const LatticeCell& cell : changes[i].place.cells) number_of_.find_or_add(cell, static_cast<std::int32_t>(i));
    }
  }

  /// Where φ = c is under the vertices.
  void measure(const GaussianField& field, double isovalue, const TriangleMesh& mesh) {
    for (const Vec3& point : mesh.points) {
      ExplainedChange* change = change_at(point);
      if (change == nullptr) continue;
      if (const auto foot = foot_on_level_set(field, isovalue, point)) add(*change, (*foot - point).norm(), bend_radius(field, *foot));
    }
  }

  void count_specks(const TriangleMesh& mesh, std::int64_t ExplainedChange::*count) {
    const Components components = connected_components(mesh);
    const std::vector<std::size_t> vertices = vertices_of(components);
    std::vector<bool> is_counted(components.count, false);
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      const std::uint32_t component = components.of_vertex[i];
      if (vertices[component] > kSpeckVertices || is_counted[component]) continue;
      is_counted[component] = true;
      if (ExplainedChange* change = change_at(mesh.points[i])) ++(change->*count);
    }
  }

 private:
  static void add(ExplainedChange& change, double distance, double radius) {
    change.largest_distance = std::max(change.largest_distance, distance);
    change.least_bend_radius = std::min(change.least_bend_radius.value_or(std::numeric_limits<double>::infinity()), radius);
  }

  [[nodiscard]] ExplainedChange* change_at(const Vec3& point) const {
    const std::int32_t number = number_of_.find(cell_at(lattice_, point));
    return number == PlaceMap<3>::kNone ? nullptr : &changes_[static_cast<std::size_t>(number)];
  }

  const CellLattice& lattice_;
  std::vector<ExplainedChange>& changes_;
  PlaceMap<3> number_of_;
};

/// A speck is a sphere.
constexpr std::int64_t kEulerOfSpeck = 2;

bool is_by_specks(const ExplainedChange& change) {
  return change.place.change == kEulerOfSpeck * (change.specks_after - change.specks_before);
}

}  // namespace

std::vector<std::size_t> vertices_of(const Components& components) {
  std::vector<std::size_t> vertices(components.count, 0);
  for (const std::uint32_t component : components.of_vertex) ++vertices[component];
  return vertices;
}

std::string_view to_string(Explanation explanation) {
  constexpr std::array<std::string_view, 4> kNames = {"passed", "specks", "beside", "none"};
  return kNames[static_cast<std::size_t>(explanation)];
}

std::string_view event_name(const CriticalPoint& point, bool is_now_inside) {
  constexpr std::array<std::string_view, 4> kOutside = {"pocket opened", "wall opened", "neck cut", "part vanished"};
  constexpr std::array<std::string_view, 4> kInside = {"pocket closed", "wall closed", "neck joined", "part appeared"};
  return (is_now_inside ? kInside : kOutside)[static_cast<std::size_t>(point.index())];
}

double bend_radius(const GaussianField& field, const Vec3& x) {
  const FieldJet jet = field.jet(x);
  const double slope = jet.gradient.norm();
  const Vec3 normal = jet.gradient / slope;
  const Eigen::Matrix3d onto_tangent = Eigen::Matrix3d::Identity() - normal * normal.transpose();
  const Eigen::Matrix3d bending = onto_tangent * jet.hessian * onto_tangent / slope;
  const double largest =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(bending, Eigen::EigenvaluesOnly).eigenvalues().cwiseAbs().maxCoeff();
  return largest > 0 ? 1 / largest : std::numeric_limits<double>::infinity();
}

std::vector<ExplainedChange> explained_changes(const GaussianField& field, double isovalue, const AdaptiveMesh& coarser,
                                               const AdaptiveMesh& finer) {
  const CellLattice& lattice = coarser.partition.lattice;
  const Explainer explainer(field, isovalue, coarser, finer);
  std::vector<ExplainedChange> changes;
  for (TopologyChange& place : topology_changes(euler_by_parts(coarser.mesh, lattice), euler_by_parts(finer.mesh, lattice)))
    changes.push_back(explainer.explain(std::move(place)));
  PlaceVisitor visitor(lattice, changes);
  visitor.measure(field, isovalue, coarser.mesh);
  visitor.measure(field, isovalue, finer.mesh);
  visitor.count_specks(coarser.mesh, &ExplainedChange::specks_before);
  visitor.count_specks(finer.mesh, &ExplainedChange::specks_after);
  for (ExplainedChange& change : changes) {
    if (change.explanation != Explanation::passed && is_by_specks(change)) change.explanation = Explanation::specks;
  }
  return changes;
}

}  // namespace smopt::experiments
