#pragma once

#include <memory>

#include "smopt/improve/move_guard.h"
#include "smopt/improve/remesh/remesh_state.h"

namespace smopt {

/// The exact guard, which also refuses moves that leave the bound on the deviation where the state has one.
std::unique_ptr<MoveGuard> make_bounded_guard(RemeshState& state);

}  // namespace smopt
