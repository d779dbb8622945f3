#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "metrics/tetgen/tet_mesh.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::metrics {

struct TetrahedralizeOptions {
  std::string switches = "p";          ///< TetGen's; `p` must be among them, and only those that keep input and output as they are
  double time_limit_seconds = 600;     ///< wall time, positive; then the worker is killed
  std::size_t memory_limit_mb = 8192;  ///< address space of the worker; 0: no limit. None under AddressSanitizer
  ProgressCallback progress = {};      ///< the fraction is that of the time limit
};

/// What became of it. A failure is a result with its reason, not an exception.
struct Tetrahedralization {
  bool success = false;
  std::string reason;          ///< in words; empty on success
  std::optional<int> code;     ///< TetGen's: 0 done, 3 self-intersection, 4 very small feature, …; empty when it did not get to say one
  std::string switches;        ///< as in the options
  TetMesh mesh;                ///< on success; its surface points have the indices of `surface` less the points in no triangle
  std::size_t tetrahedra = 0;  ///< as TetGen returned them, on failure too
  double seconds = 0;          ///< wall time of the worker
  double peak_memory_mb = 0;   ///< resident, of the worker
  std::string tetgen_version;  ///< of the library that ran; empty when none did
};

/// Fills a surface with tetrahedra by TetGen 1.5, in a process of its own with limits on time and memory, and checks the result.
///
/// Success means what `why_not_a_mesh_of` says, and that TetGen merged no points: it replaces points closer than 1e-8 of the bounding box
/// by one another and carries on, which is not a mesh of the surface that was given. Cavities are filled (no hole points are given). Points
/// in no triangle are left out. The input need not be anything: an open, intersecting or non-manifold surface is tried and its failure
/// told. \throws InvalidOption on switches that do not fit or limits that are not positive; InvalidInput when the worker program cannot be
/// started or no temporary folder made; Cancelled. Cost: TetGen's; about 3 s and 250 000 tetrahedra for 65 000 vertices.
Tetrahedralization tetrahedralize(const TriangleMesh& surface, const TetrahedralizeOptions& options = {});

/// What `smopt tetrahedralize --json` prints.
nlohmann::ordered_json to_json(const Tetrahedralization& result);

}  // namespace smopt::metrics
