#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "smopt/progress.h"
#include "smopt/surface/gaussian_field.h"
#include "smopt/surface/scalar_grid.h"

namespace smopt {

/// The blocks of an unbounded grid in which a field may reach a value, so that what is kept of the field at a time is a block, and time and
/// memory follow the surface and not the box around it. The grid's nodes depend on the field's box and the spacing alone.
class FieldBlocks {
 public:
  /// \param value  > 0: only blocks in which φ may reach it; 0: all that a kernel reaches. The field must outlive this.
  /// \throws InvalidInput when doubles do not resolve the spacing at the molecule's distance from the origin.
  /// Cost: O(n·log n + b·a) for n atoms, and b blocks in and around the molecule with a atoms near each; all cores.
  FieldBlocks(const GaussianField& field, double spacing, double value);

  [[nodiscard]] std::size_t count() const { return blocks_.size(); }
  /// Of all blocks; those between blocks count for each.
  [[nodiscard]] std::size_t node_count() const;

  /// Samples every block and calls visit(i, block) for the i-th in the order z, y, x; neighbouring blocks have the nodes between them in
  /// common. On all threads of the calling thread's arena, in any order; no two calls of `progress` at once.
  /// \throws Cancelled when `progress` says so.
  void visit_all(const std::function<void(std::size_t i, const ScalarGrid& block)>& visit, std::string_view stage,
                 const ProgressCallback& progress) const;

 private:
  using Place = std::array<std::int32_t, 3>;

  void keep_those_that_may_reach(double value);
  void lay_out(const Place& place, ScalarGrid& block) const;
  [[nodiscard]] bool may_reach(double value, const Place& place) const;

  const GaussianField& field_;
  double spacing_;
  Vec3 origin_;
  std::vector<Place> blocks_;
};

}  // namespace smopt
