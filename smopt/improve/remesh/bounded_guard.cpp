#include "smopt/improve/remesh/bounded_guard.h"

#include "smopt/geometry/triangle_intersection.h"
#include "smopt/improve/exact_guard.h"

namespace smopt {
namespace {

class BoundedGuard final : public MoveGuard {
 public:
  explicit BoundedGuard(RemeshState& state) : state_(state), exact_(state.surface.guarded()) {}

  void enter(std::span<const VertexId> group, const TriangleGrid::CubeRange* region) override {
    region_ = region;
    exact_.enter(group, region);
  }
  void select(const StarMove& move, const Vec3& reach) override {
    move_ = &move;
    exact_.select(move, reach);
  }
  [[nodiscard]] bool is_within_region() const override {
    return exact_.is_within_region() && (region_ == nullptr || region_->contains(grid().reading(state_.bound->reach(star_box()))));
  }
  [[nodiscard]] bool is_ok() override { return exact_.is_ok() && is_within_bound(); }
  [[nodiscard]] bool must_wait() const override { return exact_.must_wait(); }
  void apply() override { exact_.apply(); }

 private:
  [[nodiscard]] const TriangleGrid& grid() const { return state_.surface.guarded().grid; }

  [[nodiscard]] Box star_box() const {
    Box box = grid().box_of(move_->position());
    for (const Vec3& p : move_->ring_points()) box.unite(grid().box_of(p));
    return box;
  }
  [[nodiscard]] bool is_within_bound() {
    const std::vector<Vec3>& ring = move_->ring_points();
    new_triangles_.clear();
    for (std::size_t k = 0; k < ring.size(); ++k) new_triangles_.push_back({move_->target(), ring[k], ring[move_->next(k)]});
    return state_.bound->allows(state_.surface.mesh(), grid(), move_->faces(), new_triangles_);
  }

  const RemeshState& state_;
  ExactGuard exact_;
  const StarMove* move_ = nullptr;
  const TriangleGrid::CubeRange* region_ = nullptr;
  std::vector<TrianglePoints> new_triangles_;
};

}  // namespace

std::unique_ptr<MoveGuard> make_bounded_guard(RemeshState& state) {
  if (state.bound) return std::make_unique<BoundedGuard>(state);
  return std::make_unique<ExactGuard>(state.surface.guarded());
}

}  // namespace smopt
