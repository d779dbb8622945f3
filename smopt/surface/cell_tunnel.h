#pragma once

#include <array>
#include <optional>

#include "smopt/geometry/vec3.h"
#include "smopt/surface/cell_loops.h"

namespace smopt {

/// An annulus of the level set in a cell.
struct Tunnel {
  int first_loop = 0;
  int second_loop = 0;
  std::array<Vec3, 6> waist;  ///< a closed polygon around the tunnel between its loops; in units of the cube, strictly inside it

  /// From units of the cube into the cell between these corners.
  void move_waist_to(const Vec3& low, const Vec3& high) {
    for (Vec3& p : waist) p = low + p.cwiseProduct(high - low);
  }
};

/// The two loops of a cell that are the ends of one tunnel (an annulus of the level set); all other loops bound discs.
///
/// Inside the cube the zero set of a trilinear function is made of discs and of at most one annulus. It holds an annulus when two
/// regions of the cube's boundary of the same sign, apart on the boundary, are joined through the interior. Slices z = t show whether
/// they are: each is a bilinear square with corner values a, b, c, d (in order), all linear in t, in which diagonal corners a, c of
/// one sign, with b, d of the other, are joined where Q(t) = ac − bd is positive. At the ends of the interval of such t, Q is
/// negative (at zeros of a or c), or the join is there on the boundary as well; so a join of the interior alone is a maximum of the
/// parabola Q inside the interval. At most one of the four cases (two diagonals, two signs) can hold. All signs are exact (intervals
/// first, rational numbers where they do not tell). Chernyaev 1995 and Lopes & Brodlie 2003 list the cases. The waist is the hexagon
/// of axis-parallel lines of the level set between the two zeros of Q (Grosso 2016), widened where it is narrower than a fiftieth of
/// the cube.
/// \param values  as for `trace_cell_loops`; `loops` are its result for the same values.
std::optional<Tunnel> find_tunnel(const cube::CornerValues& values, const CellLoops& loops);

}  // namespace smopt
