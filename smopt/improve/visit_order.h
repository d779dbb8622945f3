#pragma once

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// Vertices to visit in ascending order, each once; more may be added on the way.
class VisitOrder {
 public:
  explicit VisitOrder(std::vector<VertexId> planned) : planned_(std::move(planned)) {
    std::sort(planned_.begin(), planned_.end());
    planned_.erase(std::unique(planned_.begin(), planned_.end()), planned_.end());
  }

  /// \pre v is larger than what `next` gave last.
  void add(VertexId v) { added_.insert(v); }

  std::optional<VertexId> next() {
    const bool has_planned = at_ < planned_.size();
    if (added_.empty() && !has_planned) return std::nullopt;
    const VertexId v = added_.empty() || (has_planned && planned_[at_] <= *added_.begin()) ? planned_[at_] : *added_.begin();
    if (has_planned && planned_[at_] == v) ++at_;
    if (!added_.empty() && *added_.begin() == v) added_.erase(added_.begin());
    return v;
  }

  /// How far it has come, in [0, 1].
  [[nodiscard]] double fraction_done() const {
    return planned_.empty() ? 0 : static_cast<double>(at_) / static_cast<double>(planned_.size());
  }

 private:
  std::vector<VertexId> planned_;
  std::size_t at_ = 0;
  std::set<VertexId> added_;
};

}  // namespace smopt
