#include "metrics/solvation/point_sources.h"

#include <numbers>

namespace smopt::metrics {

Eigen::MatrixX3d in_tree_order(const ClusterTree& tree, const std::vector<Vec3>& points) {
  Eigen::MatrixX3d ordered(points.size(), 3);
  for (std::size_t place = 0; place < points.size(); ++place)
    ordered.row(static_cast<Eigen::Index>(place)) = points[tree.order()[place]].transpose();
  return ordered;
}

TreeSources::TreeSources(const ClusterTree& tree, const std::vector<PointSources>& sources) {
  constexpr double kKernelFactor = std::numbers::inv_pi / 4;
  const auto& order = tree.order();
  const auto count = static_cast<Eigen::Index>(order.size());
  for (std::size_t kernel = 0; kernel < kKernels; ++kernel) {
    PointMoments& moments = moments_[kernel];
    moments = {Eigen::VectorXd(count), Eigen::MatrixX3d(count, 3)};
    for (Eigen::Index place = 0; place < count; ++place) {
      const ChargeAndDipole& source = sources[order[static_cast<std::size_t>(place)]][kernel];
      moments.number[place] = source.charge * kKernelFactor;
      moments.vector.row(place) = source.dipole.transpose() * kKernelFactor;
    }
  }
}

SourceView TreeSources::view(const Cluster& cluster, const Eigen::MatrixX3d& points) const {
  SourceView view;
  view.count = cluster.size();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    view.position[axis] = points.col(axis).data() + cluster.begin;
    for (std::size_t kernel = 0; kernel < kKernels; ++kernel)
      view.dipole[kernel][axis] = moments_[kernel].vector.col(axis).data() + cluster.begin;
  }
  for (std::size_t kernel = 0; kernel < kKernels; ++kernel) view.charge[kernel] = moments_[kernel].number.data() + cluster.begin;
  return view;
}

std::vector<TargetLanes> lanes_of(const Cluster& cluster, const Eigen::MatrixX3d& points) {
  return lanes_for(cluster.size(), [&](Eigen::Index i, Eigen::Index axis) { return points(cluster.begin + i, axis); });
}

void add_to_fields(const std::vector<TargetLanes>& lanes, std::span<const std::uint32_t> points, std::vector<PointFields>& fields) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TargetLanes& at = lanes[i / kTargetLanes];
    const std::size_t lane = i % kTargetLanes;
    for (std::size_t kernel = 0; kernel < kKernels; ++kernel) {
      PotentialAndGradient& field = fields[points[i]][kernel];
      field.potential += at.potential[kernel][lane];
      field.gradient += Vec3(at.gradient[kernel][0][lane], at.gradient[kernel][1][lane], at.gradient[kernel][2][lane]);
    }
  }
}

}  // namespace smopt::metrics
