#pragma once

#include <array>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// A bit for each ring vertex of a short ring, and one for the vertex itself: which of them a triangle has. Kept by a part of the vertex's
/// number; a vertex that finds its place taken has no bit, and its triangles get the general treatment.
class VertexBits {
 public:
  static constexpr unsigned kCenter = 1U << 31;
  VertexBits() { places_.fill({kFree, 0}); }
  void set(VertexId v, unsigned bit) {
    Place& place = places_[v % kPlaces];
    if (place.vertex == kFree) place = {v, bit};
  }
  void unset(VertexId v) { places_[v % kPlaces] = {kFree, 0}; }
  [[nodiscard]] unsigned of(const std::array<VertexId, 3>& t) const { return of(t[0]) | of(t[1]) | of(t[2]); }

 private:
  struct Place {
    VertexId vertex;
    unsigned bit;
  };
  [[nodiscard]] unsigned of(VertexId v) const {
    const Place& place = places_[v % kPlaces];
    return place.bit & (0U - static_cast<unsigned>(place.vertex == v));
  }
  static constexpr std::size_t kPlaces = 256;
  static constexpr VertexId kFree = 0xFFFFFFFF;
  std::array<Place, kPlaces> places_{};
};

}  // namespace smopt
