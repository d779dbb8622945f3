#pragma once

#include <cstddef>
#include <string>

namespace smopt {

/// What every part of the mesh should reach. Repairs go on until it does or nothing helps any more.
struct RemeshGoals {
  double min_angle_deg = 30;     ///< no smaller angle in a triangle; (0, 60)
  double max_angle_deg = 110;    ///< no larger one; (60, 180)
  double edge_ratio = 0.4;       ///< shortest/longest edge of a triangle, no less; [0, 1)
  double min_dihedral_deg = 30;  ///< no sharper angle between neighbouring triangles, inside or outside; [0, 180)
  int valence_spread = 1;        ///< valences are 6 give or take this; ≥ 0
};

/// Whether a goal was reached, and where not.
struct GoalOutcome {
  std::string name;  ///< as the option that sets it
  double goal = 0;
  double reached = 0;       ///< the worst there is
  std::size_t missing = 0;  ///< triangles, edges or vertices that miss it; 0: reached
  std::string explanation;  ///< where the worst is, and what was refused around it and why; empty where reached
};

}  // namespace smopt
