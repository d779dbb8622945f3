#pragma once

#include <compare>
#include <vector>

#include "smopt/improve/move_guard.h"

namespace smopt {

/// A guard that knows the mesh and nothing else: it cannot share the surface with others, so one thread does all.
class LocalGuard : public MoveGuard {
 public:
  explicit LocalGuard(TriangleMesh& mesh) : mesh_(mesh) {}

  void enter(std::span<const VertexId>, const TriangleGrid::CubeRange*) override {}
  void select(const StarMove& move, const Vec3&) override { move_ = &move; }
  [[nodiscard]] bool is_within_region() const override { return true; }
  [[nodiscard]] bool must_wait() const override { return false; }
  void apply() override { mesh_.points[move_->vertex()] = move_->target(); }

 protected:
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] const StarMove& move() const { return *move_; }

 private:
  TriangleMesh& mesh_;
  const StarMove* move_ = nullptr;
};

/// Algorithm 2 of Liu et al. 2017 as printed, in floating point, with the evident misprint P1P1 read as P1P2: whether the edge q1 q2 meets the
/// triangle p1 p2 p3. What it gets wrong is kept: contact counts, and an edge in the triangle's plane meets it however far away.
bool edge_meets_triangle_as_printed(const Vec3& q1, const Vec3& q2, const Vec3& p1, const Vec3& p2, const Vec3& p3);

/// The paper's own guard, for comparison ("we only need to check whether there is an edge intersecting a triangle in the vicinity of the current
/// moved vertex"): it guarantees nothing.
///
/// The vicinity, which the paper leaves open, is `vicinity` rings of triangles around the vertex. Edges of the star are tested against the
/// triangles of the vicinity, edges of the vicinity against the triangles of the star, at the target only, by Algorithm 2. An edge and a
/// triangle that share a vertex are left out, as Algorithm 2 answers yes to all of these. Cost: hundreds of tests a move.
class PaperGuard final : public LocalGuard {
 public:
  PaperGuard(TriangleMesh& surface_mesh, const VertexRings& rings, int vicinity)
      : LocalGuard(surface_mesh), rings_(rings), vicinity_(vicinity) {}

  void select(const StarMove& move, const Vec3& reach) override;
  [[nodiscard]] bool is_ok() override;

 private:
  struct Edge {
    VertexId from, to;
    auto operator<=>(const Edge&) const = default;
  };

  /// Where a vertex is once the move is made.
  [[nodiscard]] const Vec3& point(VertexId w) const { return w == move().vertex() ? move().target() : mesh().points[w]; }
  [[nodiscard]] bool meets(const Edge& edge, const Triangle& t) const;

  const VertexRings& rings_;
  int vicinity_;
  std::vector<FaceId> faces_;  // of the vicinity, ascending
  std::vector<Edge> edges_;    // of the vicinity
};

}  // namespace smopt
