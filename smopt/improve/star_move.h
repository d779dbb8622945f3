#pragma once

#include <span>
#include <vector>

#include "smopt/geometry/vec3.h"
#include "smopt/mesh/rings.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// A vertex, its star, and where it would go: what step rules, quality tests and guards look at.
class StarMove {
 public:
  StarMove(const TriangleMesh& mesh, const VertexRings& rings) : mesh_(mesh), rings_(rings) {}

  /// Takes up vertex v where it is now. \pre v has a ring. Cost: O(valence).
  void select(VertexId v);
  /// Sets where it would go. \pre selected. Cost: O(valence).
  void aim(const Vec3& target);

  [[nodiscard]] VertexId vertex() const { return vertex_; }
  [[nodiscard]] std::size_t valence() const { return ring_.size(); }
  [[nodiscard]] std::span<const VertexId> ring() const { return ring_; }
  /// Triangle k has the corners vertex(), ring()[k] and ring()[k + 1] (cyclic), anticlockwise seen from outside.
  [[nodiscard]] std::span<const FaceId> faces() const { return rings_.faces(vertex_); }
  [[nodiscard]] const Vec3& position() const { return position_; }
  [[nodiscard]] const std::vector<Vec3>& ring_points() const { return ring_points_; }
  /// The ring's points relative to the position.
  [[nodiscard]] const std::vector<Vec3>& spokes() const { return spokes_; }
  /// Square of the longest spoke, Å².
  [[nodiscard]] double longest2() const { return longest2_; }

  [[nodiscard]] const Vec3& target() const { return target_; }
  [[nodiscard]] const Vec3& displacement() const { return displacement_; }
  /// Of the star's triangles at the target: doubled area vectors, Å².
  [[nodiscard]] const std::vector<Vec3>& target_normals() const { return target_normals_; }
  /// Square of the longest spoke at the target, Å².
  [[nodiscard]] double target_longest2() const { return target_longest2_; }

  /// Whether a triangle of the star has, at the target, an angle whose squared sine is below this.
  [[nodiscard]] bool has_smaller_angle_at_target(double squared_sine) const;
  /// Squared sine of the smallest angle in the star, at the position and at the target.
  [[nodiscard]] double squared_sine_at(const Vec3& point) const;

  [[nodiscard]] std::size_t next(std::size_t k) const { return k + 1 < ring_.size() ? k + 1 : 0; }
  [[nodiscard]] std::size_t previous(std::size_t k) const { return k > 0 ? k - 1 : ring_.size() - 1; }

 private:
  const TriangleMesh& mesh_;
  const VertexRings& rings_;
  VertexId vertex_ = 0;
  std::span<const VertexId> ring_;
  Vec3 position_ = Vec3::Zero();
  std::vector<Vec3> ring_points_;
  std::vector<Vec3> spokes_;
  double longest2_ = 0;
  Vec3 target_ = Vec3::Zero();
  Vec3 displacement_ = Vec3::Zero();
  std::vector<Vec3> target_normals_;
  std::vector<double> target_lengths2_;  // of the spokes at the target
  double target_longest2_ = 0;
};

}  // namespace smopt
