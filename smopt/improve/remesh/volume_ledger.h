#pragma once

#include <vector>

#include "smopt/improve/remesh/editable_surface.h"
#include "smopt/improve/remesh/patch.h"

namespace smopt {

/// Who owes the surface how much volume: what an operation took or added is shared among the vertices around it, which give it back along their
/// star's area vector when they move next. The sum of the volume and of all debts never changes.
class VolumeLedger {
 public:
  explicit VolumeLedger(std::size_t vertices) : owed_(vertices, 0) {}

  void grow(std::size_t vertices) { owed_.resize(vertices, 0); }
  /// Books a patch that is about to be replaced.
  void book(const EditableSurface& surface, const Patch& patch);
  /// The step without its part along the star's area vector, but with what gives back the vertex's debt, as far as that is short.
  [[nodiscard]] Vec3 keeping_volume(const EditableSurface& surface, VertexId v, const Vec3& step) const;
  /// Books that v came from `former` to where it is.
  void book_move(const EditableSurface& surface, VertexId v, const Vec3& former);
  /// Whether v owes more than moves lose to rounding.
  [[nodiscard]] bool has_debt(const EditableSurface& surface, VertexId v) const;
  /// Å³, all vertices together.
  [[nodiscard]] double total() const;

 private:
  std::vector<double> owed_;  // per vertex: six times the volume, Å³
};

}  // namespace smopt
