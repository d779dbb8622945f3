#include <gtest/gtest.h>

#include "smopt/improve/remesh/remesh.h"
#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/improve/remesh/shape_judge.h"
#include "tests/support/shapes.h"
#include "tests/support/threads.h"

namespace smopt {
namespace {

using namespace testing;

/// A mesh that is compared bit for bit, with all that the report counts.
struct Outcome {
  TriangleMesh mesh;
  std::size_t operations = 0, refusals = 0, moves = 0;
  double owed = 0;
  std::string goals;

  bool operator==(const Outcome& o) const {
    return is_same(mesh, o.mesh) && operations == o.operations && refusals == o.refusals && moves == o.moves && owed == o.owed &&
           goals == o.goals;
  }
};

Outcome outcome_of(TriangleMesh mesh, const RemeshOptions& options) {
  const RemeshReport report = remesh(mesh, options);
  Outcome outcome;
  outcome.mesh = std::move(mesh);
  outcome.operations = report.flips.done + report.collapses.done + report.splits.done;
  outcome.refusals = report.flips.refused + report.collapses.refused + report.splits.refused;
  outcome.moves = report.moves.accepted + report.moves.refused;
  outcome.owed = report.volume_owed;
  for (const GoalOutcome& goal : report.goals) outcome.goals += goal.explanation + ";";
  return outcome;
}

void expect_same_bytes(const TriangleMesh& mesh, const RemeshOptions& options = {}) {
  expect_same_for_any_threads([&] { return outcome_of(mesh, options); });
}

TEST(RemeshThreads, GiveTheSameBytesOnASmallMesh) {
  expect_same_bytes(noisy(icosphere(2), 0.05, 1));
}

/// Several tiles of every colour, needles that have to be postponed.
TriangleMesh many_tiles() {
  return spiky(noisy(torus(10, 3, 200, 70), 0.05, 5), 97, 1.05);
}

TEST(RemeshThreads, GiveTheSameBytesOnSeveralTiles) {
  expect_same_bytes(many_tiles());
}

TEST(RemeshThreads, GiveTheSameBytesOnSeveralComponents) {
  expect_same_bytes(joined(noisy(torus(3, 1, 80, 30), 0.03, 2), translated(noisy(icosphere(3), 0.03, 6), {1000, 0, 0})));
  expect_same_bytes(plates_on_a_noisy_sheet(1e-3, 2));
  expect_same_bytes(random_molecule_surface(40, 3));
}

TEST(RemeshThreads, GiveTheSameBytesWithABoundOnTheDeviation) {
  const TriangleMesh mesh = noisy(torus(3, 1, 80, 30), 0.03, 2);
  RemeshOptions options;
  options.deviation = 0.2 * mean_edge_length(mesh);
  expect_same_bytes(mesh, options);
}

TEST(RemeshThreads, GiveTheSameBytesForOtherSizes) {
  RemeshOptions coarse, curved;
  coarse.vertices = 500;
  curved.sizing = Sizing::curvature;
  expect_same_bytes(noisy(torus(3, 1, 80, 30), 0.03, 2), coarse);
  expect_same_bytes(noisy(torus(3, 1, 80, 30), 0.03, 2), curved);
}

}  // namespace
}  // namespace smopt
