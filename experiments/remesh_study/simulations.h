#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/tetgen_trials.h"
#include "smopt/io/molecule.h"
#include "smopt/mesh/triangle_mesh.h"

/// What simulations say of a mesh in memory, as the records of a run have it.
namespace smopt::experiments {

/// A record's `tetgen`: by switches what `smopt tetrahedralize --json` prints, whatever becomes of it. Where `p` fails, nothing else that
/// refines its result is tried, and the reason says so.
nlohmann::ordered_json tetgen_of(const TriangleMesh& mesh, const std::vector<TetgenTrial>& trials);

/// A record's `solvation`, whatever becomes of it: what `smopt solvate --json` prints with AFMPB's defaults, and the options; or the status
/// "over limit" (more memory would be needed) or "failed", with the reason. On all threads.
nlohmann::ordered_json solvation_of(const TriangleMesh& mesh, const Molecule& molecule, std::uint64_t max_memory_bytes);

/// A record's `solvation` where it is not computed.
nlohmann::ordered_json no_solvation(const std::string& why);

}  // namespace smopt::experiments
