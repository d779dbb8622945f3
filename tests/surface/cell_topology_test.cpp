#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <ostream>
#include <random>
#include <set>
#include <vector>

#include "smopt/surface/cell_loops.h"
#include "smopt/surface/cell_triangulation.h"
#include "smopt/surface/cell_tunnel.h"
#include "tests/surface/subdivided_field.h"

namespace smopt {
namespace {

using Random = std::mt19937;
using cube::CornerValues;

/// What a cell's level set is, up to deformation: which crossings of the cube's edges one piece joins, and the Euler characteristic.
struct CellTopology {
  std::array<int, cube::kEdges> piece{};  ///< of the crossing, numbered as met; -1 where the edge is not crossed
  int euler = 0;

  bool operator==(const CellTopology&) const = default;
};

bool is_crossed(const CornerValues& values, int edge) {
  return is_inside(values[cube::low_corner(edge)]) != is_inside(values[cube::high_corner(edge)]);
}

template <class Key>
std::array<int, cube::kEdges> numbered(const std::array<std::optional<Key>, cube::kEdges>& keys) {
  std::array<int, cube::kEdges> numbers;
  std::map<Key, int> seen;
  for (int edge = 0; edge < cube::kEdges; ++edge)
    numbers[edge] = keys[edge] ? seen.try_emplace(*keys[edge], static_cast<int>(seen.size())).first->second : -1;
  return numbers;
}

/// By brute force. In a ball a piece of the level set is told by the inside and the outside region on its two sides.
CellTopology topology_by_subdivision(const CornerValues& values, int factor) {
  const ScalarGrid grid{{2, 2, 2}, Vec3::Zero(), 1, {values.begin(), values.end()}};
  const testing::SubdividedField field(grid, factor);
  const auto component = [&](int corner) { return field.component_of(corner & 1, corner >> 1 & 1, corner >> 2); };
  std::array<std::optional<std::pair<int, int>>, cube::kEdges> keys;
  for (int edge = 0; edge < cube::kEdges; ++edge) {
    if (is_crossed(values, edge)) keys[edge] = std::minmax(component(cube::low_corner(edge)), component(cube::high_corner(edge)));
  }
  return {numbered(keys), field.euler_characteristic_of_level_set()};
}

/// Of the triangles, by their connectivity alone.
CellTopology topology_of_patch(const CornerValues& values, const CellPatch& patch) {
  std::vector<int> piece(patch.points.size());
  for (std::size_t i = 0; i < piece.size(); ++i) piece[i] = static_cast<int>(i);
  std::set<int> vertices;
  std::set<std::pair<int, int>> edges;
  for (const PatchTriangle& t : patch.triangles) {
    for (int i = 0; i < 3; ++i) {
      vertices.insert(t[i]);
      edges.insert(std::minmax<int>(t[i], t[(i + 1) % 3]));
      std::replace(piece.begin(), piece.end(), int{piece[t[(i + 1) % 3]]}, int{piece[t[i]]});
    }
  }
  std::array<std::optional<int>, cube::kEdges> keys;
  for (int edge = 0; edge < cube::kEdges; ++edge) {
    if (is_crossed(values, edge)) keys[edge] = piece[edge];
  }
  const auto euler = static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + static_cast<int>(patch.triangles.size());
  return {numbered(keys), euler};
}

std::array<Vec3, cube::kEdges> crossings(const CornerValues& values) {
  std::array<Vec3, cube::kEdges> points;
  for (int edge = 0; edge < cube::kEdges; ++edge) {
    const int low = cube::low_corner(edge);
    points[edge] = Vec3(low & 1, low >> 1 & 1, low >> 2);
    if (!is_crossed(values, edge)) continue;
    points[edge][cube::axis_of_edge(edge)] = std::clamp(values[low] / (values[low] - values[cube::high_corner(edge)]), 1e-6, 1 - 1e-6);
  }
  return points;
}

struct MeshedCell {
  CellLoops loops;
  std::optional<Tunnel> tunnel;
  CellPatch patch;
};

MeshedCell meshed(const CornerValues& values) {
  MeshedCell cell;
  cell.loops = trace_cell_loops(values);
  cell.tunnel = find_tunnel(values, cell.loops);
  triangulate_cell(crossings(values), cell.loops, cell.tunnel, cell.patch);
  return cell;
}

std::string text(const CornerValues& values) {
  return fmt::format("corner values {}", fmt::join(values, " "));
}

/// Edges of the triangles that only one of them has, in its direction.
std::set<std::pair<int, int>> rim(const CellPatch& patch) {
  std::set<std::pair<int, int>> open;
  for (const PatchTriangle& t : patch.triangles) {
    for (int i = 0; i < 3; ++i) {
      const int a = t[i];
      const int b = t[(i + 1) % 3];
      if (open.erase({b, a}) == 0) open.insert({a, b});
    }
  }
  return open;
}

std::set<std::pair<int, int>> segments(const CellLoops& loops) {
  std::set<std::pair<int, int>> found;
  for (int i = 0; i < loops.count; ++i) {
    const auto loop = loops.loop(i);
    for (std::size_t n = 0; n < loop.size(); ++n) found.insert({loop[n], loop[(n + 1) % loop.size()]});
  }
  return found;
}

bool lies_in_face(int a, int b) {
  return a < cube::kEdges && b < cube::kEdges && cube::share_face(a, b);
}

/// What makes the union over all cells embedded: triangles without contact, whose boundary is the loops, and of which nothing else lies in
/// a face of the cube.
void expect_sound_patch(const CornerValues& values, const MeshedCell& cell) {
  EXPECT_TRUE(is_embedded(cell.patch.points, cell.patch.triangles)) << text(values);
  const auto loop_segments = segments(cell.loops);
  EXPECT_EQ(rim(cell.patch), loop_segments) << text(values);
  for (const PatchTriangle& t : cell.patch.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::pair<int, int> edge = {t[i], t[(i + 1) % 3]};
      EXPECT_TRUE(loop_segments.contains(edge) || !lies_in_face(edge.first, edge.second))
          << text(values) << " edge " << edge.first << "-" << edge.second;
    }
  }
  for (std::size_t i = cube::kEdges; i < cell.patch.points.size(); ++i) {
    EXPECT_GT(cell.patch.points[i].minCoeff(), 0) << text(values);
    EXPECT_LT(cell.patch.points[i].maxCoeff(), 1) << text(values);
  }
}

struct Tally {
  int compared = 0;
  int tunnels = 0;
};

/// The oracle's resolutions, in pairs: narrow necks and gaps of the level set fall through a coarse grid.
constexpr std::pair<int, int> kResolutions[] = {{12, 17}, {34, 47}, {70, 95}, {193, 210}};

/// A pair of resolutions that both agree with us settles a cell; otherwise finer ones are asked. The finest pair condemns us if it agrees
/// with itself, and says nothing otherwise.
void compare_with_subdivision(const CornerValues& values, Tally& tally) {
  const MeshedCell cell = meshed(values);
  expect_sound_patch(values, cell);
  const CellTopology ours = topology_of_patch(values, cell.patch);
  CellTopology first;
  CellTopology second;
  for (const auto& [factor, other_factor] : kResolutions) {
    first = topology_by_subdivision(values, factor);
    second = topology_by_subdivision(values, other_factor);
    if (first != ours || second != ours) continue;
    ++tally.compared;
    if (cell.tunnel) ++tally.tunnels;
    return;
  }
  EXPECT_FALSE(first == second) << text(values) << "\nby subdivision the Euler characteristic is " << first.euler << ", ours is "
                                << ours.euler;
}

CornerValues uniform_values(Random& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  CornerValues values;
  for (double& v : values) v = uniform(random);
  return values;
}

/// Magnitudes between 1/e and e on both sides of zero, those inside `bias` times as large.
CornerValues values_with_inside(unsigned inside, double bias, Random& random) {
  std::uniform_real_distribution<double> exponent(-1, 1);
  CornerValues values;
  for (unsigned corner = 0; corner < values.size(); ++corner) {
    const double size = std::exp(exponent(random));
    values[corner] = inside >> corner & 1U ? bias * size : -size;
  }
  return values;
}

CornerValues log_uniform_values(Random& random) {
  std::uniform_real_distribution<double> exponent(-8, 8);
  CornerValues values;
  for (double& v : values) v = std::exp(exponent(random)) * (random() % 2 == 0 ? 1 : -1);
  return values;
}

CornerValues integer_values(Random& random) {
  std::uniform_int_distribution<int> uniform(-4, 4);
  CornerValues values;
  for (double& v : values) v = uniform(random);
  return values;
}

bool has_face_tie(const CornerValues& v) {
  for (int face = 0; face < cube::kFaces; ++face) {
    const auto q = cube::corners_of_face(face);
    if (v[q[0]] * v[q[2]] == v[q[1]] * v[q[3]]) return true;
  }
  return std::find(v.begin(), v.end(), 0.0) != v.end();
}

TEST(CellTopology, OfRandomCellsIsThatOfTheTrilinearInterpolant) {
  Random random(20170912);
  Tally tally;
  for (int i = 0; i < 1200; ++i) compare_with_subdivision(uniform_values(random), tally);
  EXPECT_GT(tally.compared, 1180);
}

TEST(CellTopology, OfRandomIntegerCellsIsThatOfTheTrilinearInterpolant) {
  Random random(5);
  Tally tally;
  for (int i = 0; i < 1200; ++i) {
    const CornerValues values = integer_values(random);
    if (!has_face_tie(values)) compare_with_subdivision(values, tally);
  }
  EXPECT_GT(tally.compared, 200);
}

/// The sign patterns of Chernyaev's cases in which a tunnel is possible.
struct Case {
  const char* name;
  unsigned inside;  ///< bits: corners
};
constexpr Case kCases[] = {{"4", 0b10000001},  {"6", 0b10000011},  {"7", 0b10000110},
                           {"10", 0b11000011}, {"12", 0b10000111}, {"13", 0b01101001}};

void PrintTo(const Case& chosen, std::ostream* out) {
  *out << "case " << chosen.name;
}

/// Random values with this sign pattern; where `with_tunnel`, the first of many that have one (they are rare, most of all in case 13).
CornerValues values_of_case(const Case& chosen, double bias, bool with_tunnel, Random& random) {
  constexpr int kAttempts = 300;
  CornerValues values = values_with_inside(chosen.inside, bias, random);
  for (int i = 0; with_tunnel && i < kAttempts && !find_tunnel(values, trace_cell_loops(values)); ++i)
    values = values_with_inside(chosen.inside, bias, random);
  return values;
}

class CellTopologyOfCase : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Chernyaev, CellTopologyOfCase, ::testing::ValuesIn(kCases),
                         [](const auto& chosen) { return std::string("Case") + chosen.param.name; });

TEST_P(CellTopologyOfCase, WithAndWithoutTunnelIsThatOfTheTrilinearInterpolant) {
  Random random(GetParam().inside);
  Tally tally;
  for (const double bias : {0.3, 1.0, 3.0}) {
    for (int i = 0; i < 40; ++i) compare_with_subdivision(values_of_case(GetParam(), bias, i % 4 == 0, random), tally);
  }
  EXPECT_GT(tally.compared, 110);
  EXPECT_GE(tally.tunnels, 8) << "among " << tally.compared;
  EXPECT_LT(tally.tunnels, tally.compared);
}

TEST(CellTopology, OfTheNegativeFieldIsTheSameSurfaceReversed) {
  Random random(11);
  for (int i = 0; i < 20000; ++i) {
    const CornerValues values = uniform_values(random);
    CornerValues negative = values;
    for (double& v : negative) v = -v;
    const auto forwards = segments(trace_cell_loops(values));
    std::set<std::pair<int, int>> backwards;
    for (const auto& [a, b] : segments(trace_cell_loops(negative))) backwards.insert({b, a});
    EXPECT_EQ(forwards, backwards) << text(values);
    EXPECT_EQ(find_tunnel(values, trace_cell_loops(values)).has_value(), find_tunnel(negative, trace_cell_loops(negative)).has_value())
        << text(values);
  }
}

/// Corner numbers after the cube is turned: axis a becomes axis (a + 1) % 3.
CornerValues turned(const CornerValues& values) {
  CornerValues result;
  for (unsigned corner = 0; corner < values.size(); ++corner) result[(corner << 1 & 7U) | corner >> 2] = values[corner];
  return result;
}

TEST(CellTopology, OfATurnedCubeIsTheSame) {
  Random random(12);
  int tunnels = 0;
  for (int i = 0; i < 20000; ++i) {
    const CornerValues values = i % 2 == 0 ? uniform_values(random) : values_with_inside(kCases[i / 2 % 6].inside, 3, random);
    const CornerValues other = turned(values);
    const CellLoops loops = trace_cell_loops(values);
    const CellLoops other_loops = trace_cell_loops(other);
    EXPECT_EQ(loops.count, other_loops.count) << text(values);
    const bool has_tunnel = find_tunnel(values, loops).has_value();
    EXPECT_EQ(has_tunnel, find_tunnel(other, other_loops).has_value()) << text(values);
    tunnels += has_tunnel;
  }
  EXPECT_GT(tunnels, 100);
}

TEST(CellTriangulation, HasNoContactsAndNothingInFacesForValuesOfAllMagnitudes) {
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const CornerValues values =
        i % 2 == 0 ? log_uniform_values(random) : values_with_inside(0b01101001, std::exp(0.1 * (i % 40) - 2), random);
    expect_sound_patch(values, meshed(values));
  }
}

TEST(CellTriangulation, HasNoContactsForTiedValues) {
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const CornerValues values = integer_values(random);
    expect_sound_patch(values, meshed(values));
  }
}

CornerValues raised(CornerValues values, double by) {
  for (double& v : values) v += by;
  return values;
}

bool has_tunnel(const CornerValues& values) {
  return find_tunnel(values, trace_cell_loops(values)).has_value();
}

TEST(CellTriangulation, HasNoContactsWhereATunnelIsAboutToClose) {
  Random random(6);
  int closed = 0;
  for (int i = 0; i < 150; ++i) {
    const CornerValues values = values_of_case(kCases[i % 6], 1, true, random);
    double open = 0;
    double shut = i % 4 < 2 ? 5 : -5;  // all corners have one sign there
    if (!has_tunnel(values) || has_tunnel(raised(values, shut))) continue;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (open + shut);
      (has_tunnel(raised(values, middle)) ? open : shut) = middle;
    }
    for (const double by : {open, shut, open + 1e-9 * (open - shut), 0.999 * open})
      expect_sound_patch(raised(values, by), meshed(raised(values, by)));
    ++closed;
  }
  EXPECT_GT(closed, 100);
}

TEST(CellTunnel, OpensWhereTheSaddleReachesTheLevel) {
  // Inside at corners 0 and 7 with value s, -1 elsewhere: on the diagonal x = y = z = t the field is a cubic with its minimum at 1/2, where
  // it is (2·s - 6) / 8: the tunnel is there from s = 3 on, and not below.
  for (const double s : {2.0, 2.999999999999999, 3.0, 3.000000000000001, 4.0}) {
    CornerValues values;
    values.fill(-1);
    values[0] = values[7] = s;
    const CellLoops loops = trace_cell_loops(values);
    EXPECT_EQ(loops.count, 2);
    EXPECT_EQ(find_tunnel(values, loops).has_value(), s >= 3) << s;
    expect_sound_patch(values, meshed(values));
  }
}

}  // namespace
}  // namespace smopt
