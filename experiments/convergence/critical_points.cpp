#include "experiments/convergence/critical_points.h"

#include <oneapi/tbb/parallel_for.h>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

namespace smopt::experiments {
namespace {

/// Seeds on each axis of a cube of level 0, whose edge is 1.7 widths of a kernel: a seed is within a quarter of a width of every point.
constexpr int kSeedsPerAxis = 5;

/// A first step that is longer, in spacings of seeds, leads to where other seeds are nearer.
constexpr double kLongestFirstStep = 3;

/// Ångström: longer steps are cut to this, half a kernel's width.
constexpr double kLongestStep = 0.4;
constexpr int kMostSteps = 60;

/// Ångström: what the field leaves out makes its gradient jump by about 1e-5 per ångström, and steps with it.
constexpr double kConverged = 1e-5;

Vec3 newton_step(const FieldJet& jet) {
  return -jet.hessian.fullPivLu().solve(jet.gradient);
}

CriticalPoint point_at(const Vec3& position, const FieldJet& jet) {
  return {position, jet.value, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(jet.hessian, Eigen::EigenvaluesOnly).eigenvalues()};
}

std::optional<CriticalPoint> newton(const GaussianField& field, Vec3 x, double longest_first_step) {
  for (int step = 0; step < kMostSteps; ++step) {
    const FieldJet jet = field.jet(x);
    if (!(jet.value > 0)) return std::nullopt;  // out of every kernel's reach all points are flat
    const Vec3 to_next = newton_step(jet);
    const double length = to_next.norm();
    if (!std::isfinite(length) || (step == 0 && length > longest_first_step)) return std::nullopt;
    if (length < kConverged) return point_at(x, jet);
    x += length > kLongestStep ? Vec3(to_next * (kLongestStep / length)) : to_next;
  }
  return std::nullopt;
}

std::vector<CriticalPoint> from_seeds_in(const GaussianField& field, const CellLattice& lattice, const LatticeCell& cell) {
  const double spacing = lattice.root_edge / kSeedsPerAxis;
  std::vector<CriticalPoint> found;
  for (int k = 0; k < kSeedsPerAxis; ++k) {
    for (int j = 0; j < kSeedsPerAxis; ++j) {
      for (int i = 0; i < kSeedsPerAxis; ++i) {
        const Vec3 seed = lattice.origin + lattice.root_edge * Vec3(cell[0], cell[1], cell[2]) + spacing * Vec3(i + 0.5, j + 0.5, k + 0.5);
        if (const auto point = newton(field, seed, kLongestFirstStep * spacing)) found.push_back(*point);
      }
    }
  }
  return found;
}

/// Of points that are one, the first stays.
void add_new(std::vector<CriticalPoint>& points, std::span<const CriticalPoint> more) {
  for (const CriticalPoint& point : more) {
    const auto is_same = [&](const CriticalPoint& p) { return (p.position - point.position).norm() < kSamePoint; };
    if (std::none_of(points.begin(), points.end(), is_same)) points.push_back(point);
  }
}

}  // namespace

std::vector<CriticalPoint> critical_points_near(const GaussianField& field, double isovalue, const CellLattice& lattice,
                                                std::span<const LatticeCell> cells) {
  const std::vector<LatticeCell> searched = widened(cells);
  std::vector<std::vector<CriticalPoint>> found(searched.size());
  tbb::parallel_for(std::size_t{0}, searched.size(), [&](std::size_t i) { found[i] = from_seeds_in(field, lattice, searched[i]); });
  std::vector<CriticalPoint> points;
  for (const std::vector<CriticalPoint>& some : found) add_new(points, some);
  std::erase_if(points, [&](const CriticalPoint& point) {
    return !std::binary_search(searched.begin(), searched.end(), cell_at(lattice, point.position));
  });
  std::stable_sort(points.begin(), points.end(), [&](const CriticalPoint& a, const CriticalPoint& b) {
    return std::abs(a.value - isovalue) < std::abs(b.value - isovalue);
  });
  return points;
}

}  // namespace smopt::experiments
