#pragma once

#include <functional>
#include <string>

#include "experiments/record.h"
#include "smopt/improve/method.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::experiments {

/// A mesh with what the judge says about it, so that a mesh that many cases share is judged once.
struct JudgedMesh {
  TriangleMesh mesh;
  Json metrics;        ///< as `smopt measure --json`
  std::string sha256;  ///< of the mesh as an OFF file
};

JudgedMesh judge(TriangleMesh mesh);

/// The mesh that the methods get: the initial one, checked, oriented and without its cavities. \throws InvalidMesh
JudgedMesh prepare_input(const TriangleMesh& initial);

/// Runs what fills a record and marks it with what became of that: done, or the reason in what was thrown. \throws Cancelled alone.
void record_outcome(Json& record, const std::function<void()>& fill);

/// Runs a method, `repeats` times on one thread from the initial mesh on (validity and cavities are timed too), judges
/// the result, and fills the record as far as it gets. \return the improved mesh. \throws whatever the method throws.
TriangleMesh run_method_case(Json& record, const Method& method, const OptionValues& options, const TriangleMesh& initial,
                             const JudgedMesh& input, int repeats, const ProgressCallback& progress);

}  // namespace smopt::experiments
