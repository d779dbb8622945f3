#include "smopt/surface/plain_cells.h"

#include <algorithm>
#include <limits>

#include "smopt/surface/cell_loops.h"

namespace smopt {
namespace {

PlainCell plain_cell(unsigned inside) {
  cube::CornerValues values;
  for (int corner = 0; corner < cube::kCorners; ++corner) values[corner] = inside >> corner & 1U ? 1 : -1;
  const CellLoops loops = trace_cell_loops(values);
  PlainCell cell;
  if (loops.count != 1 || loops.ambiguous_faces != 0) return cell;
  cell.count = static_cast<std::uint8_t>(loops.loop(0).size());
  std::ranges::copy(loops.loop(0), cell.edges.begin());
  return cell;
}

double fan_area(std::span<const Vec3> corners, std::size_t apex) {
  const std::size_t n = corners.size();
  const auto spoke = [&](std::size_t i) -> Vec3 { return corners[apex + i < n ? apex + i : apex + i - n] - corners[apex]; };
  double sum = 0;
  Vec3 side = spoke(1);
  for (std::size_t i = 2; i < n; ++i) {
    const Vec3 next = spoke(i);
    sum += 0.5 * side.cross(next).norm();
    side = next;
  }
  return sum;
}

}  // namespace

const std::array<PlainCell, 256>& plain_cells() {
  static const std::array<PlainCell, 256> cells = [] {
    std::array<PlainCell, 256> all;
    for (unsigned inside = 0; inside < all.size(); ++inside) all[inside] = plain_cell(inside);
    return all;
  }();
  return cells;
}

std::size_t best_fan_apex(std::span<const Vec3> corners) {
  if (corners.size() == 3) return 0;
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  const std::size_t different_fans = corners.size() == 4 ? 2 : corners.size();
  for (std::size_t apex = 0; apex < different_fans; ++apex) {
    const double size = fan_area(corners, apex);
    if (size < least) {
      least = size;
      best = apex;
    }
  }
  return best;
}

}  // namespace smopt
