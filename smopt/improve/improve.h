#pragma once

#include "smopt/improve/prepare.h"
#include "smopt/improve/redundant_points.h"
#include "smopt/improve/smoothing.h"

namespace smopt {

/// SMOPT's three stages; the defaults do what the paper did.
struct ImproveOptions {
  CavityPolicy cavities = CavityPolicy::delete_cavities;
  bool deletes_redundant_points = true;
  RedundantPointOptions redundant;
  SmoothingOptions smoothing;
};

struct ImproveReport {
  PreparationReport preparation;
  RedundantPointReport redundant;
  SmoothingReport smoothing;
  double volume_before_smoothing = 0;  ///< enclosed, Å³; cavities count negative
  double volume_after_smoothing = 0;
  StageTimes seconds;  ///< "validity", "cavities", "redundant" and "smoothing"
};

/// Improves a molecular surface mesh without ever letting two triangles intersect (SMOPT, Liu et al. 2017).
/// \param mesh  positions in Å, changed in place.
/// \throws InvalidMesh when the mesh is not a closed manifold of finite coordinates; Cancelled when `progress` asks for it.
/// Cost: some microseconds a vertex.
ImproveReport improve(TriangleMesh& mesh, const ImproveOptions& options, const ProgressCallback& progress = {});

/// The stages after `prepare`, for a mesh that it has passed: redundant points and smoothing. Fills their parts of the report and appends their
/// times.
void improve_prepared(TriangleMesh& mesh, const ImproveOptions& options, ImproveReport& report, const ProgressCallback& progress = {});

}  // namespace smopt
