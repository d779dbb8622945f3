#include "smopt/surface/cell_forest.h"

namespace smopt {

CellForest::Id CellForest::find(const CellPlace& place) const {
  return CellFinder(*this).find(place).id;
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

CellFinder::Found CellFinder::find(const CellPlace& place) {
  const Root root = {place.at[0] >> place.level, place.at[1] >> place.level, place.at[2] >> place.level};
  const auto is_about = [&](int axis) { return root[axis] >= middle_[axis] - 1 && root[axis] <= middle_[axis] + 1; };
  if (!(is_about(0) && is_about(1) && is_about(2))) remember_roots_about(root);
  CellForest::Id id = roots_[9 * (root[2] - middle_[2]) + 3 * (root[1] - middle_[1]) + root[0] - middle_[0] + 13];
  if (id == CellForest::kNone) return {};
  int level = 0;
  for (; level < place.level && !forest_.is_leaf(id); ++level) {
    const int bit = place.level - level - 1;
    id = forest_.first_child_[id] + ((place.at[0] >> bit & 1) | (place.at[1] >> bit & 1) << 1 | (place.at[2] >> bit & 1) << 2);
  }
  return {id, level};
}

void CellFinder::remember_roots_about(const Root& root) {
  middle_ = root;
  std::size_t i = 0;
  for (int z = -1; z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) roots_[i++] = forest_.roots_.find({root[0] + x, root[1] + y, root[2] + z});
    }
  }
}

}  // namespace smopt
