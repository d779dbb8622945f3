#include "smopt/surface/plain_cells.h"

#include <gmock/gmock.h>

#include <random>
#include <vector>

#include "smopt/surface/cell_loops.h"
#include "smopt/surface/cell_triangulation.h"

namespace smopt {
namespace {

using ::testing::ElementsAreArray;

TEST(PlainCells, HaveTheLoopThatIsTracedForAnyValuesOfTheirSigns) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> size(0.001, 1);
  for (int trial = 0; trial < 20000; ++trial) {
    const unsigned inside = static_cast<unsigned>(trial) % 256;
    cube::CornerValues values;
    for (int corner = 0; corner < cube::kCorners; ++corner) values[corner] = (inside >> corner & 1U ? 1 : -1) * size(random);
    const CellLoops loops = trace_cell_loops(values);
    const PlainCell& plain = plain_cells()[inside];
    ASSERT_EQ(plain.count != 0, loops.count == 1 && loops.ambiguous_faces == 0) << inside;
    if (plain.count != 0) {
      ASSERT_THAT(plain.loop(), ElementsAreArray(loops.loop(0))) << inside;
    }
  }
}

TEST(PlainCells, AreFilledWithTheFanThatOtherCellsGet) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(0.01, 0.99);
  for (int trial = 0; trial < 20000; ++trial) {
    const PlainCell& plain = plain_cells()[static_cast<std::size_t>(trial) % 256];
    if (plain.count == 0) continue;
    CellLoops loops;
    loops.count = 1;
    loops.begin[1] = plain.count;
    loops.edges = plain.edges;
    std::array<Vec3, cube::kEdges> points;
    std::vector<Vec3> corners;
    for (const int edge : plain.loop()) {
      const int low = cube::low_corner(edge);
      points[edge] = Vec3(low & 1, low >> 1 & 1, low >> 2);
      points[edge][cube::axis_of_edge(edge)] = place(random);
      corners.push_back(points[edge]);
    }
    CellPatch patch;
    triangulate_cell(points, loops, std::nullopt, patch);
    ASSERT_EQ(patch.triangles.size(), corners.size() - 2);
    ASSERT_EQ(patch.triangles.front()[0], plain.edges[best_fan_apex(corners)]);
  }
}

}  // namespace
}  // namespace smopt
