#include "smopt/improve/marked_cells.h"

#include <limits>

namespace smopt {

MarkedCells::MarkedCells(double cell_size)
    : cells_per_unit_(1 / std::max(cell_size, std::numeric_limits<double>::min())), bits_((std::size_t{1} << kLogBits) / 64, 0) {}

void MarkedCells::mark(const Extent& box) {
  const Range range = cells_of(box);
  if (is_large(range)) is_everything_ = true;
  if (is_everything_) return;
  is_true_for_all(range, [&](std::uint64_t bit) {
    bits_[bit / 64] |= std::uint64_t{1} << (bit % 64);
    return true;
  });
}

}  // namespace smopt
