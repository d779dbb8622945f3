#pragma once

#include <optional>
#include <vector>

#include "smopt/geometry/triangle_grid.h"
#include "smopt/improve/marked_cells.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// A spatial index of the triangles near a few places of a large mesh. It is built at the first query, over the triangles near the boxes
/// that are expected; a query that goes beyond builds it anew for twice as much around each.
class RegionalGrid {
 public:
  /// \param is_removed  one flag a triangle: those that are no longer there. Mesh and flags are referred to, not copied.
  RegionalGrid(const TriangleMesh& mesh, const std::vector<char>& is_removed) : mesh_(mesh), is_removed_(is_removed) {}

  /// Where queries will be. To be told before the first query.
  void expect(std::vector<Extent> boxes) { expected_ = std::move(boxes); }

  /// Calls visit(f) once for every triangle whose box overlaps `box`. Cost of the first and of one that goes beyond: O(n), on all threads.
  template <class Visit>
  void for_overlapping(const Extent& box, const Visit& visit) {
    if (!region_ || !region_->covers(box)) build_for(box);
    grid_->for_overlapping(grid_->box_of(box.low, box.high), [&](std::uint32_t i) { visit(faces_[i]); });
  }

  /// Takes triangle f out. \pre a query was made that its box overlaps.
  void remove(FaceId f) { grid_->remove(index_of(f)); }
  /// Tells where triangle f is now, as the mesh has it. \pre a query was made for a box that contains it and overlapped its former place.
  void move(FaceId f);

 private:
  void build_for(const Extent& box);
  void mark_region();
  [[nodiscard]] std::vector<FaceId> faces_in_region() const;
  [[nodiscard]] std::uint32_t index_of(FaceId f) const;

  const TriangleMesh& mesh_;
  const std::vector<char>& is_removed_;
  std::vector<Extent> expected_;
  double margin_ = 0;
  std::optional<MarkedCells> region_;
  std::optional<TriangleGrid> grid_;
  std::vector<FaceId> faces_;  // of the grid's triangles, ascending
};

}  // namespace smopt
