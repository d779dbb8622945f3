#include "smopt/improve/vertex_mover.h"

#include <cmath>
#include <numbers>

namespace smopt {
namespace {

/// A step shorter than this part of the longest spoke is none: its effect on any angle is below 1e-7 rad, and without a bound the fixed
/// point would be approached for ever.
constexpr double kNegligibleStepRel = 1e-7;

}  // namespace

VertexMover::VertexMover(const GuardedSurface& surface, const MoveRules& rules, std::unique_ptr<MoveGuard> guard)
    : rules_(rules),
      move_(surface.mesh, surface.rings),
      guard_(std::move(guard)),
      bad_squared_sine_(std::pow(std::sin(rules.min_angle_deg * std::numbers::pi / 180), 2)) {}

Visit VertexMover::visit(VertexId v, const Vec3& step) {
  move_.select(v);
  moved_by_ = 0;
  if (step.squaredNorm() <= kNegligibleStepRel * kNegligibleStepRel * move_.longest2()) return Visit::unmoved;
  guard_->select(move_, move_.position() + step);
  if (!guard_->is_within_region()) return Visit::postponed;
  double beta = 1;
  for (int halving = 0; halving <= rules_.halvings; ++halving, beta *= 0.5) {
    move_.aim(move_.position() + beta * step);
    if (rules_.keeps_angles && makes_bad_angle_worse()) continue;
    if (!guard_->is_ok()) continue;
    if (guard_->must_wait()) return Visit::postponed;
    guard_->apply();
    moved_by_ = beta * step.norm();
    return halving > 0 ? Visit::moved_shortened : Visit::moved;
  }
  return Visit::refused;
}

bool VertexMover::makes_bad_angle_worse() const {
  return move_.has_smaller_angle_at_target(bad_squared_sine_) &&
         move_.squared_sine_at(move_.target()) < move_.squared_sine_at(move_.position());
}

}  // namespace smopt
