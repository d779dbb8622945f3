#include "smopt/surface/patch_embedding.h"

#include <gmock/gmock.h>

#include <vector>

namespace smopt {
namespace {

bool embedded(const std::vector<Vec3>& points, const std::vector<PatchTriangle>& triangles) {
  return is_embedded(points, triangles);
}

TEST(PatchEmbedding, AcceptsTwoTrianglesOfASquare) {
  EXPECT_TRUE(embedded({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}));
}

TEST(PatchEmbedding, RefusesTwoTrianglesFoldedOntoEachOther) {
  EXPECT_FALSE(embedded({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 0, 3}}));
  EXPECT_TRUE(embedded({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-300}}, {{0, 1, 2}, {1, 0, 3}})) << "not in one plane: exact";
}

TEST(PatchEmbedding, RefusesAnEdgeUsedTwiceInOneDirection) {
  EXPECT_FALSE(embedded({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 1}}, {{0, 1, 2}, {0, 1, 3}}));
}

TEST(PatchEmbedding, RefusesATriangleThatPiercesItsNeighbourAtASharedCorner) {
  const std::vector<Vec3> points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}, {-1, -1, 1}};
  EXPECT_FALSE(embedded(points, {{0, 1, 2}, {0, 3, 4}}));
  EXPECT_TRUE(embedded(points, {{0, 1, 2}, {0, 3, 5}}));
}

TEST(PatchEmbedding, RefusesTrianglesThatTouchInAPointOnly) {
  const std::vector<Vec3> points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, 0}, {0, 0, 1}, {1, 0, 1}};
  EXPECT_FALSE(embedded(points, {{0, 1, 2}, {3, 4, 5}}));
  std::vector<Vec3> lifted = points;
  lifted[3].z() = 1e-300;
  EXPECT_TRUE(embedded(lifted, {{0, 1, 2}, {3, 4, 5}}));
}

}  // namespace
}  // namespace smopt
