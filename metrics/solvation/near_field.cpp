#include "metrics/solvation/near_field.h"

#include "metrics/solvation/batches.h"

namespace smopt::metrics {

NearField::NearField(const FarField& far, double kappa, const std::vector<double>& reaches)
    : far_(far), kappa_(kappa), leaves_(far.tree().leaves()) {
  squared_reaches_.reserve(reaches.size());
  for (const std::uint32_t p : far.tree().order()) squared_reaches_.push_back(reaches[p] * reaches[p]);
}

void NearField::apply(const std::vector<PointSources>& sources, std::vector<PointFields>& fields, const ProgressCallback& progress) const {
  const ClusterTree& tree = far_.tree();
  const TreeSources ordered(tree, sources);
  in_batches(leaves_.size(), progress, "near field", [&](std::size_t i) {
    const ClusterId leaf = leaves_[i];
    auto lanes = lanes_of(tree[leaf], far_.points());
    for (const ClusterId source : far_.near_sources(leaf)) {
      SourceView view = ordered.view(tree[source], far_.points());
      view.squared_reach = squared_reaches_.data() + tree[source].begin;
      add_pair_sums(view, kappa_, lanes, SourceKind::charges_and_dipoles, TargetKind::potentials_and_gradients);
    }
    add_to_fields(lanes, tree.points_of(leaf), fields);
  });
}

}  // namespace smopt::metrics
