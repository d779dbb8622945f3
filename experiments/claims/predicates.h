#pragma once

#include <string_view>
#include <vector>

#include "experiments/claims/evidence.h"
#include "experiments/record_set.h"

namespace smopt::experiments {

/// What answers a claim of claims.json.
struct Predicate {
  std::string_view id;  ///< the claim's
  Evidence (*evaluate)(const RecordSet& records);
};

/// By what the claims are about.
std::vector<Predicate> surface_predicates();     ///< pairs, manifoldness, topology, what is removed
std::vector<Predicate> simulation_predicates();  ///< TetGen and solvation energies
std::vector<Predicate> cost_predicates();        ///< processor seconds, rounds, moves
std::vector<Predicate> shape_predicates();       ///< area, volume, edge ratios, angles
std::vector<Predicate> rival_predicates();       ///< ISO2mesh, MeshLab, and SMOPT with other options
std::vector<Predicate> smopt2_predicates();      ///< this project's own claims of smopt2

/// All of them.
std::vector<Predicate> all_predicates();

}  // namespace smopt::experiments
