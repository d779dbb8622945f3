#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "smopt/improve/remesh/remesh_goals.h"
#include "smopt/improve/round_report.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt {

/// How long edges are to be, place by place.
enum class Sizing {
  density,   ///< as the input's are around there
  uniform,   ///< the same everywhere
  curvature  ///< so that chords stay within `chord_error` of the surface
};

struct RemeshOptions {
  RemeshGoals goals;
  int rounds = 4;       ///< of splits, collapses, flips and relaxation; up to 6 more as long as the number of vertices is off; ≥ 0
  int repairs = 30;     ///< sweeps over what misses a goal, at most, each time; ≥ 0
  int refinements = 6;  ///< how often edges are made shorter where triangles miss a goal and nothing helps, which adds vertices; ≥ 0
  bool flips = true;
  bool collapses = true;
  bool splits = true;
  bool preserves_volume = true;
  Sizing sizing = Sizing::density;
  std::size_t vertices = 0;   ///< about so many; 0: as many as the input has, or as `edge_length` or `chord_error` ask for
  double edge_length = 0;     ///< Å, for uniform sizing; 0: by the number of vertices
  double chord_error = 0.02;  ///< Å, for curvature sizing; > 0
  double deviation = std::numeric_limits<double>::infinity();  ///< Å; no point of input or output is farther than this from the other; > 0
};

/// \throws InvalidOption naming an option that is out of its range.
void require_valid(const RemeshOptions& options);

/// How often an operation was made, and how often one that was wanted was refused: by the guard or the bound on the deviation, because it would
/// bend the surface sharply, or because a vertex would get too many neighbours.
struct OperationCounts {
  std::size_t done = 0;
  std::size_t refused = 0;

  OperationCounts& operator+=(const OperationCounts& other) {
    done += other.done;
    refused += other.refused;
    return *this;
  }
};

struct RemeshReport {
  OperationCounts flips, collapses, splits;
  MoveCounts moves;
  int rounds = 0;   ///< without those of refinements
  int repairs = 0;  ///< sweeps
  int refinements = 0;
  double volume_owed = 0;          ///< Å³ that operations took away and no move could give back
  std::vector<GoalOutcome> goals;  ///< each, in the order of `RemeshGoals`
  std::string stopped_because;

  /// Adds a run that went on from the result of this one.
  void append(const RemeshReport& next);
};

/// Makes all of a surface mesh fit for simulation: regular triangles of the wanted size everywhere, the enclosed volume kept.
///
/// Rounds of four operations in the order of Botsch and Kobbelt (A remeshing approach to multiresolution modeling, 2004): long edges are split,
/// short ones collapsed, edges flipped where valences or angles gain, vertices relaxed towards the centroid of their star. Then repairs: around
/// what misses a goal, worst first in each block of space, the operation that gains most (after Hu et al., Error-bounded and feature preserving
/// surface remeshing with minimal angle improvement, 2017). Every operation is allowed by an exact test against the whole surface of all that it
/// sweeps over: no pair of triangles intersects afterwards that did not before, and the topology is unchanged. Vertices move within the plane
/// across their star's area vector, and give back along it what volume the other operations took.
/// \param mesh  positions in Å, changed in place, connectivity too, and numbered anew along a curve through space; closed, manifold and oriented.
/// \throws InvalidOption; InvalidMesh when the mesh is no closed, oriented manifold; Cancelled.
/// Cost: some 15 microseconds a vertex on one thread; the same bytes for any number of threads.
RemeshReport remesh(TriangleMesh& mesh, const RemeshOptions& options, const ProgressCallback& progress = {});

}  // namespace smopt
