#pragma once

#include <vector>

#include "metrics/solvation/far_field.h"

namespace smopt::metrics {

/// What FarField leaves of its sums, but for close pairs: those whose distance is not above the source's reach, a point with itself among them. They
/// are the caller's to integrate.
class NearField {
 public:
  /// \param far      must outlive this; built with the same reaches.
  /// \param kappa    1/ångström.
  /// \param reaches  ångström; one for each point.
  NearField(const FarField& far, double kappa, const std::vector<double>& reaches);

  /// As FarField::apply. Cost: 2.3 ns a near pair (AVX-512).
  void apply(const std::vector<PointSources>& sources, std::vector<PointFields>& fields, const ProgressCallback& progress = {}) const;

  [[nodiscard]] const std::vector<ClusterId>& leaves() const { return leaves_; }
  [[nodiscard]] std::span<const std::uint32_t> points_of(ClusterId leaf) const { return far_.tree().points_of(leaf); }
  /// Calls visit(target, source) for the close pairs of targets in a leaf, whose sources come in the tree's order.
  template <class Visit>
  void visit_close_pairs(ClusterId leaf, const Visit& visit) const;

 private:
  [[nodiscard]] bool is_close(std::size_t target_place, std::size_t source_place) const;

  const FarField& far_;
  double kappa_;
  std::vector<ClusterId> leaves_;
  std::vector<double> squared_reaches_;  // in the tree's order
};

inline bool NearField::is_close(std::size_t target_place, std::size_t source_place) const {
  const auto& points = far_.points();
  const auto t = static_cast<Eigen::Index>(target_place), s = static_cast<Eigen::Index>(source_place);
  const double rho[3] = {points(t, 0) - points(s, 0), points(t, 1) - points(s, 1), points(t, 2) - points(s, 2)};
  return squared_distance(rho) <= squared_reaches_[source_place];
}

template <class Visit>
void NearField::visit_close_pairs(ClusterId leaf, const Visit& visit) const {
  const ClusterTree& tree = far_.tree();
  for (std::size_t t = tree[leaf].begin; t < tree[leaf].end; ++t)
    for (const ClusterId source_leaf : far_.near_sources(leaf))
      for (std::size_t s = tree[source_leaf].begin; s < tree[source_leaf].end; ++s)
        if (is_close(t, s)) visit(tree.order()[t], tree.order()[s]);
}

}  // namespace smopt::metrics
