#pragma once

#include <cstddef>
#include <optional>

#include "experiments/method_cases.h"
#include "experiments/record.h"
#include "experiments/remesh_study/study_mesh.h"
#include "smopt/improve/method.h"

namespace smopt::experiments {

/// What is asked of a case besides the metrics and the distances.
struct StudyPlan {
  bool with_distances = true;                 ///< to the input and, where the molecule is known, to the level set
  bool with_tetrahedra = true;                ///< TetGen `-p` and `-pY`
  bool with_quality_tetrahedra = false;       ///< TetGen `-pq1.4` besides these
  bool with_solvation = false;                ///< where the molecule is known and the mesh has at most `most_solved_vertices`
  bool with_two_threads = false;              ///< run it once more on two threads: time, and whether the bytes are the same
  std::size_t most_solved_vertices = 70'000;  ///< the solver takes a minute for as many
  std::optional<std::size_t> vertices = {};   ///< the budget of a case that asks for another's number of vertices
};

/// Runs a case on a mesh and records it, whatever becomes of it: as a record of `reproduce`, and besides `distance_to_input` (two-sided: mean,
/// largest, and the diagonal of the input's box), `worst` (see WorstPlaces), `tetgen_ready` (`smallest_dihedral_deg`, and `vertex_spacing`, the
/// smallest distance between two vertices as a share of the diagonal), `two_threads` (`seconds`, `same_bytes`) as far as asked for. `initial` is the
/// mesh without its cavities as it is. A method that the registry does not have is "not installed".
Json run_study_case(const StudyMesh& mesh, const MethodCase& method_case, const MethodRegistry& registry, const StudyPlan& plan);

/// How many vertices the result of a record has; nothing where it failed.
std::optional<std::size_t> vertices_of(const Json& record);

}  // namespace smopt::experiments
