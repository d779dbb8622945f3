#pragma once

#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::baselines {

/// What `angle_and_area_smoothing` of CGAL 5.5 can be told; the defaults are those of its manual, but for the rounds.
struct AngleAreaOptions {
  /// CGAL's default is one iteration, which is one small step; the example that CGAL ships makes ten.
  int rounds = 10;
  bool smooths_angles = true;  ///< use_angle_smoothing
  bool smooths_areas = false;  ///< use_area_smoothing; CGAL's default is true. Needs `has_area_smoothing()`
  /// use_safety_constraints: no move that turns a triangle round or lessens the smallest angle of a star. Off by the manual and in CGAL's
  /// example; left out, CGAL's code has it on, which gives up at the first self-intersection (see below): on a molecule in the first round.
  bool has_safety_constraints = false;
  bool flips_edges = true;  ///< use_Delaunay_flips, after each smoothing of areas only
  bool projects = true;     ///< do_project: every vertex goes to the nearest point of the initial surface after each pass
};

struct AngleAreaReport {
  int complete_rounds = 0;
  bool met_itself = false;  ///< CGAL stopped, as the surface intersected itself when it was to be projected
};

/// Whether CGAL's smoothing of areas is built in: it needs the Ceres solver.
bool has_area_smoothing();

/// CGAL's `Polygon_mesh_processing::angle_and_area_smoothing` (Surazhsky & Gotsman 2004), over its usual kernel (exact predicates, double
/// positions), in one call: what it projects to is the surface at the start of the call, so that a call for each round would let the
/// surface drift. With safety constraints and projection CGAL gives up without a word at the first pass after which the surface intersects
/// itself, and leaves it as that pass left it; the report says so. Without flips the triangles do not change.
/// \pre has_area_smoothing() if areas are to be smoothed. \throws InvalidMesh unless the mesh is a closed, oriented manifold; MethodFailed
/// for a triangle without area, which CGAL cannot smooth; Cancelled. Cost: about 4 µs a vertex and round for angles, 50 µs for areas.
AngleAreaReport smooth_angles_and_areas(TriangleMesh& mesh, const AngleAreaOptions& options, const ProgressCallback& progress = {});

}  // namespace smopt::baselines
