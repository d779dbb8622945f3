#include "experiments/claims/predicates.h"

namespace smopt::experiments {

std::vector<Predicate> all_predicates() {
  std::vector<Predicate> all;
  for (const auto& list :
       {surface_predicates(), simulation_predicates(), cost_predicates(), shape_predicates(), rival_predicates(), smopt2_predicates()})
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace smopt::experiments
