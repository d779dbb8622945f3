#include "experiments/convergence/euler_parts.h"

#include <algorithm>
#include <cmath>

#include "smopt/surface/place_map.h"

namespace smopt::experiments {
namespace {

class EulerCounter {
 public:
  explicit EulerCounter(const CellLattice& lattice) : lattice_(lattice) {}

  void add(const Vec3& centroid, int sign) {
    const auto number = static_cast<std::int32_t>(sums_.size());
    const LatticePart part = part_of(centroid);
    const std::int32_t found = numbers_.find_or_add(part, number);
    if (found == number) sums_.push_back({part, 0});
    sums_[static_cast<std::size_t>(found)].euler += sign;
  }

  [[nodiscard]] std::vector<EulerPart> result() && {
    std::erase_if(sums_, [](const EulerPart& sum) { return sum.euler == 0; });
    std::sort(sums_.begin(), sums_.end(), [](const EulerPart& a, const EulerPart& b) { return a.part < b.part; });
    return std::move(sums_);
  }

 private:
  [[nodiscard]] LatticePart part_of(const Vec3& x) const {
    LatticePart part;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = (x[axis] - lattice_.origin[axis]) / lattice_.root_edge;
      const double nearest = std::round(at);
      const bool is_on_plane = std::abs(at - nearest) * lattice_.root_edge <= kOnPlane;
      part[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(is_on_plane ? 2 * nearest : 2 * std::floor(at) + 1);
    }
    return part;
  }

  const CellLattice& lattice_;
  PlaceMap<3> numbers_;
  std::vector<EulerPart> sums_;
};

}  // namespace

std::vector<EulerPart> euler_by_parts(const TriangleMesh& mesh, const CellLattice& lattice) {
  EulerCounter counter(lattice);
  for (const Vec3& point : mesh.points) counter.add(point, 1);
  for (const Triangle& t : mesh.triangles) {
    counter.add((mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3, 1);
    for (std::size_t side = 0; side < 3; ++side) {
      const VertexId from = t[side];
      const VertexId to = t[(side + 1) % 3];
      if (from < to) counter.add((mesh.points[from] + mesh.points[to]) / 2, -1);
    }
  }
  return std::move(counter).result();
}

}  // namespace smopt::experiments
