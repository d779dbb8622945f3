#include "smopt/improve/remesh/volume_ledger.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/improve/hard_shapes.h"
#include "tests/improve/remesh/patch_maker.h"
#include "tests/support/matchers.h"
#include "tests/support/shapes.h"

namespace smopt {
namespace {

using namespace testing;

constexpr double kRounding = 1e-12;  // volumes here are about 4 Å³

/// Makes random operations and books them; the number that were made.
int make_and_book(PatchMaker& maker, VolumeLedger& ledger, std::uint32_t seed, int attempts) {
  Random random(seed);
  int made = 0;
  for (int i = 0; i < attempts; ++i) {
    if (!maker.propose_any(random) || !maker.surface().has_room_for(maker.patch()) || !maker.is_ok()) continue;
    ledger.grow(maker.surface().mesh().vertex_count());
    ledger.book(maker.surface(), maker.patch());
    maker.make();
    ++made;
  }
  return made;
}

/// Moves a vertex, which nobody here asks the guard about.
void move_to(PatchMaker& maker, VertexId v, const Vec3& target) {
  maker.state().surface.guarded().mesh.points[v] = target;
}

TEST(VolumeLedger, KeepsTheSumOfVolumeAndDebtsThroughAnyOperations) {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    PatchMaker maker(noisy(icosphere(2), 0.05, seed));
    VolumeLedger ledger(maker.surface().mesh().vertex_count());
    const double before = enclosed_volume(maker.mesh());
    EXPECT_EQ(ledger.total(), 0);
    EXPECT_GT(make_and_book(maker, ledger, seed, 1000), 100);
    EXPECT_GT(std::abs(enclosed_volume(maker.mesh()) - before), 1e-4) << "something was to be booked";
    EXPECT_NEAR(enclosed_volume(maker.mesh()) + ledger.total(), before, kRounding);
  }
}

TEST(VolumeLedger, MovesWithoutDebtsKeepTheVolumeAndWithThemGiveItBack) {
  PatchMaker maker(noisy(icosphere(2), 0.05, 7));
  VolumeLedger ledger(maker.surface().mesh().vertex_count());
  const double before = enclosed_volume(maker.mesh());
  make_and_book(maker, ledger, 7, 300);
  const double owed = std::abs(ledger.total());
  ASSERT_GT(owed, 1e-4);
  for (int sweep = 0; sweep < 20; ++sweep) {
    for (VertexId v = 0; v < maker.surface().mesh().vertex_count(); ++v) {
      if (!maker.surface().is_in_use(v)) continue;
      const Vec3 former = maker.surface().point(v);
      move_to(maker, v, former + ledger.keeping_volume(maker.surface(), v, Vec3(1e-4, -2e-4, 1e-4)));
      ledger.book_move(maker.surface(), v, former);
      ASSERT_NEAR(enclosed_volume(maker.mesh()) + ledger.total(), before, kRounding) << v;
    }
  }
  EXPECT_LT(std::abs(ledger.total()), 0.01 * owed);
  EXPECT_NEAR(enclosed_volume(maker.mesh()), before, 0.01 * owed);
}

TEST(VolumeLedger, AStepWithoutDebtKeepsTheVolume) {
  PatchMaker maker(noisy(icosphere(2), 0.05, 3));
  const VolumeLedger ledger(maker.surface().mesh().vertex_count());
  const double before = enclosed_volume(maker.mesh());
  Random random(3);
  for (VertexId v = 0; v < maker.surface().mesh().vertex_count(); ++v) {
    EXPECT_FALSE(ledger.has_debt(maker.surface(), v));
    const Vec3 step = random.in_ball(0.05), kept = ledger.keeping_volume(maker.surface(), v, step);
    EXPECT_LE(kept.norm(), step.norm() * (1 + 1e-12));
    EXPECT_GT(kept.norm(), 0);
    EXPECT_NEAR(kept.dot(step), kept.squaredNorm(), kRounding) << "only what changes the volume is taken away";
    move_to(maker, v, maker.surface().point(v) + kept);
    ASSERT_NEAR(enclosed_volume(maker.mesh()), before, kRounding);
  }
}

TEST(VolumeLedger, KnowsWhoOwes) {
  PatchMaker maker(noisy(icosphere(2), 0.1, 3));
  VolumeLedger ledger(maker.surface().mesh().vertex_count());
  const VertexId v = 20, w = maker.surface().rings().vertices(v)[0];
  ASSERT_TRUE(maker.propose(kCollapse, v, w));
  ledger.book(maker.surface(), maker.patch());
  const std::vector<VertexId> around = maker.patch().boundary;
  maker.make();
  int debtors = 0;
  for (VertexId u = 0; u < maker.surface().mesh().vertex_count(); ++u) {
    if (!maker.surface().is_in_use(u) || !ledger.has_debt(maker.surface(), u)) continue;
    EXPECT_NE(std::find(around.begin(), around.end(), u), around.end()) << u;
    ++debtors;
  }
  EXPECT_GT(debtors, 0);
}

}  // namespace
}  // namespace smopt
