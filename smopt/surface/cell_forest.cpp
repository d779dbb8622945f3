#include "smopt/surface/cell_forest.h"

namespace smopt {

CellForest::Id CellForest::find(const CellPlace& place) const {
  const auto at_level = [&](int axis, int level) { return place.at[axis] >> (place.level - level); };
  Id id = roots_.find({at_level(0, 0), at_level(1, 0), at_level(2, 0)});
  if (id == kNone) return kNone;
  for (int level = 1; level <= place.level && !is_leaf(id); ++level)
    id = first_child_[id] + ((at_level(0, level) & 1) | (at_level(1, level) & 1) << 1 | (at_level(2, level) & 1) << 2);
  return id;
}

void CellForest::add_root(const Cell& cell) {
  roots_.find_or_add(cell.place.at, static_cast<Id>(cells_.size()));
  cells_.push_back(cell);
  first_child_.push_back(kNone);
}

void CellForest::add_children(Id parent, const std::array<Cell, cube::kCorners>& children) {
  first_child_[parent] = static_cast<Id>(cells_.size());
  cells_.insert(cells_.end(), children.begin(), children.end());
  first_child_.resize(cells_.size(), kNone);
}

}  // namespace smopt
