#include "smopt/surface/cell_tunnel.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

namespace smopt {
namespace {

using CornerPair = std::pair<int, int>;

/// The four vertical edges of the cube in order around it, each by its corner at z = 0.
constexpr std::array<int, 4> kColumns = {0, 1, 3, 2};
constexpr int kUp = 4;

/// A function linear in t along a column: value(t) = at_zero + slope·t.
template <class Number>
struct Linear {
  Number at_zero;
  Number slope;
};

/// Whether columns a and c, of one sign, are joined at the maximum of the parabola Q(t) = a·c − b·d, while b and d have the other
/// sign there.
/// \return the sign (inside or not) of the joined columns.
template <class Number>
std::optional<bool> joined_at_maximum(const std::array<Linear<Number>, 4>& column) {
  const auto& [a, b, c, d] = column;
  const Number quadratic = a.slope * c.slope - b.slope * d.slope;
  if (!(quadratic < 0)) return std::nullopt;
  const Number linear = a.at_zero * c.slope + a.slope * c.at_zero - b.at_zero * d.slope - b.slope * d.at_zero;
  const Number scale = -2 * quadratic;  // positive; the maximum is at t = linear / scale
  if (!(linear > 0) || !(linear < scale)) return std::nullopt;

  const auto is_inside_there = [&](const Linear<Number>& f) { return bool(f.at_zero * scale + f.slope * linear >= 0); };
  const bool inside = is_inside_there(a);
  if (is_inside_there(c) != inside || is_inside_there(b) == inside || is_inside_there(d) == inside) return std::nullopt;

  const Number constant = a.at_zero * c.at_zero - b.at_zero * d.at_zero;
  const Number maximum = linear * linear + 2 * scale * constant;  // Q there, times a positive factor
  const bool joined = inside ? bool(maximum >= 0) : bool(maximum > 0);
  return joined ? std::optional(inside) : std::nullopt;
}

template <class Number>
std::optional<bool> joined_at_maximum_of(const cube::CornerValues& values, int first_column) {
  std::array<Linear<Number>, 4> column;
  for (int i = 0; i < 4; ++i) {
    const int corner = kColumns[(first_column + i) % 4];
    const Number low(values[corner]);
    column[i] = {low, Number(values[corner + kUp]) - low};
  }
  return joined_at_maximum(column);
}

std::optional<bool> joined_at_maximum_exactly(const cube::CornerValues& values, int first_column) {
  try {
    return joined_at_maximum_of<CGAL::Interval_nt<true>>(values, first_column);
  } catch (const CGAL::Uncertain_conversion_exception&) {
    return joined_at_maximum_of<CGAL::Exact_rational>(values, first_column);
  }
}

/// Two corners that are joined through the interior by a maximum of Q.
std::optional<CornerPair> find_interior_join(const cube::CornerValues& values) {
  const auto end_of_sign = [&](int column, bool inside) {
    return is_inside(values[kColumns[column]]) == inside ? kColumns[column] : kColumns[column] + kUp;
  };
  for (int first = 0; first < 2; ++first) {
    if (const std::optional<bool> inside = joined_at_maximum_exactly(values, first))
      return CornerPair{end_of_sign(first, *inside), end_of_sign(first + 2, *inside)};
  }
  return std::nullopt;
}

// ---- the waist ----

/// The waist is at least this far from its centre on each axis, in edges of the cube, or half the way to the cube's faces. A level
/// set that is narrower differs from the cylinder of this width by the square of it in value.
constexpr double kLeastHalfWidth = 0.02;

/// No point of the waist is nearer to a face of the cube, in edges of the cube: rounding must not put it there.
constexpr double kNearestToFace = 1e-6;

/// The slice z = t of the function has its saddle at (x, y).
Vec3 slice_saddle(const cube::CornerValues& values, double t) {
  const auto at = [&](int i) { return values[kColumns[i]] + t * (values[kColumns[i] + kUp] - values[kColumns[i]]); };
  const double twist = at(0) - at(1) + at(2) - at(3);
  return {(at(0) - at(3)) / twist, (at(0) - at(1)) / twist, t};
}

/// The zeros of Q, as centre and half distance.
std::pair<double, double> zeros_of_parabola(const cube::CornerValues& values) {
  std::array<Linear<double>, 4> column;
  for (int i = 0; i < 4; ++i) column[i] = {values[kColumns[i]], values[kColumns[i] + kUp] - values[kColumns[i]]};
  const auto& [a, b, c, d] = column;
  const double quadratic = a.slope * c.slope - b.slope * d.slope;
  const double linear = a.at_zero * c.slope + a.slope * c.at_zero - b.at_zero * d.slope - b.slope * d.at_zero;
  const double constant = a.at_zero * c.at_zero - b.at_zero * d.at_zero;
  const double discriminant = std::max(0.0, linear * linear - 4 * quadratic * constant);
  return {-linear / (2 * quadratic), std::sqrt(discriminant) / (2 * std::abs(quadratic))};
}

/// Two places on an axis, apart and inside the cube.
std::pair<double, double> widened(double low, double high) {
  const double middle = std::clamp(0.5 * (low + high), kNearestToFace, 1 - kNearestToFace);
  const double least = std::min(kLeastHalfWidth, 0.5 * std::min(middle, 1 - middle));
  const double half = 0.5 * (high - low);
  const double wide = std::copysign(std::max(std::abs(half), least), half);
  return {std::clamp(middle - wide, kNearestToFace, 1 - kNearestToFace), std::clamp(middle + wide, kNearestToFace, 1 - kNearestToFace)};
}

std::array<Vec3, 6> waist_of_tunnel(const cube::CornerValues& values) {
  const auto [middle, half] = zeros_of_parabola(values);
  const Vec3 low = slice_saddle(values, middle - half);
  const Vec3 high = slice_saddle(values, middle + half);
  const auto [x0, x1] = widened(low.x(), high.x());
  const auto [y0, y1] = widened(low.y(), high.y());
  const auto [z0, z1] = widened(low.z(), high.z());
  return {Vec3(x0, y0, z0), Vec3(x0, y1, z0), Vec3(x0, y1, z1), Vec3(x1, y1, z1), Vec3(x1, y0, z1), Vec3(x1, y0, z0)};
}

/// Which corners belong to one region of the cube's boundary.
class BoundaryRegions {
 public:
  BoundaryRegions(const cube::CornerValues& values, const CellLoops& loops) {
    std::iota(region_.begin(), region_.end(), 0);
    for (int edge = 0; edge < cube::kEdges; ++edge) {
      const int low = cube::low_corner(edge);
      const int high = cube::high_corner(edge);
      if (is_inside(values[low]) == is_inside(values[high])) join(low, high);
    }
    for (int face = 0; face < cube::kFaces; ++face) {
      if (loops.ambiguous_faces >> face & 1U) join_diagonal(values, face, loops.joined_faces >> face & 1U);
    }
  }

  [[nodiscard]] int of(int corner) const { return region_[corner]; }

 private:
  void join(int corner, int other) {
    const int from = region_[other];
    const int to = region_[corner];
    for (int& region : region_) {
      if (region == from) region = to;
    }
  }

  void join_diagonal(const cube::CornerValues& values, int face, bool inside) {
    const std::array<int, 4> q = cube::corners_of_face(face);
    const int first = is_inside(values[q[0]]) == inside ? 0 : 1;
    join(q[first], q[first + 2]);
  }

  std::array<int, cube::kCorners> region_;
};

/// The regions on both sides of a loop.
struct Sides {
  int inside;
  int outside;
};

Sides sides_of_loop(const cube::CornerValues& values, const BoundaryRegions& regions, int edge) {
  const int low = regions.of(cube::low_corner(edge));
  const int high = regions.of(cube::high_corner(edge));
  return is_inside(values[cube::low_corner(edge)]) ? Sides{low, high} : Sides{high, low};
}

}  // namespace

std::optional<Tunnel> find_tunnel(const cube::CornerValues& values, const CellLoops& loops) {
  if (loops.count < 2) return std::nullopt;
  const std::optional<CornerPair> join = find_interior_join(values);
  if (!join) return std::nullopt;
  const BoundaryRegions regions(values, loops);
  const int first = regions.of(join->first);
  const int second = regions.of(join->second);
  if (first == second) return std::nullopt;

  // Regions and loops form a tree; the tunnel's ends are the two loops between the joined regions and the one region that borders on both.
  const bool inside = is_inside(values[join->first]);
  for (int i = 0; i < loops.count; ++i) {
    for (int j = 0; j < loops.count; ++j) {
      const Sides a = sides_of_loop(values, regions, loops.loop(i)[0]);
      const Sides b = sides_of_loop(values, regions, loops.loop(j)[0]);
      const bool between = inside ? a.outside == b.outside : a.inside == b.inside;
      if (between && (inside ? a.inside : a.outside) == first && (inside ? b.inside : b.outside) == second)
        return Tunnel{i, j, waist_of_tunnel(values)};
    }
  }
  assert(false && "two regions of one sign are two loops apart");
  return std::nullopt;
}

}  // namespace smopt
