#pragma once

#include <cstddef>
#include <string>

#include "smopt/improve/round_report.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"
#include "smopt/surface/gaussian_field.h"
#include "smopt/surface/level_set_distance.h"

namespace smopt {

/// How vertices are brought onto the level set.
struct ProjectionOptions {
  int rounds = 5;             ///< sweeps over the vertices that are not there yet; ≥ 0
  int halvings = 10;          ///< how often a refused step is halved before the vertex stays; ≥ 0
  double tolerance = 1e-6;    ///< Å; a vertex nearer than this has arrived
  bool keeps_angles = true;   ///< whether a step is refused that leaves an angle below `min_angle_deg` and smaller than it was
  double min_angle_deg = 10;  ///< [0, 60)
};

struct ProjectionReport {
  LevelSetDistance before;
  LevelSetDistance after;
  std::size_t arrived = 0;  ///< vertices within the tolerance in the end
  int rounds = 0;
  MoveCounts moves;             ///< over all rounds
  std::string stopped_because;  ///< "all arrived", "nothing moved" or "rounds"
};

/// Moves each vertex to its foot on the level set φ = c, as far as no two triangles come to intersect.
///
/// The guard is that of the smoothing: all that a star sweeps over is tested with exact signs, and the step is halved while it is refused.
/// Connectivity does not change. Newton's method without a guard gives intersecting pairs where the surface is thin.
/// \param mesh  positions in Å, changed in place.
/// \pre mesh is a closed, oriented manifold.
/// \throws InvalidOption for an option out of its range; InvalidMesh when the mesh has no rings; Cancelled when `progress` asks for it.
/// Cost: about ten evaluations of φ a vertex, and some microseconds a move; all cores, the same bytes for any number.
ProjectionReport project_onto_level_set(TriangleMesh& mesh, const GaussianField& field, double isovalue,
                                        const ProjectionOptions& options = {}, const ProgressCallback& progress = {});

}  // namespace smopt
