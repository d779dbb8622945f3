#include "smopt/improve/remesh/editable_surface.h"

#include <algorithm>
#include <array>

#include "smopt/error.h"
#include "smopt/mesh/compact.h"

namespace smopt {
namespace {

/// The same rings with room to grow.
VertexRings spacious(const VertexRings& rings) {
  VertexRings result;
  result.rows.resize(rings.vertex_count());
  std::uint32_t begin = 0;
  for (VertexId v = 0; v < rings.vertex_count(); ++v) {
    result.rows[v] = {begin, rings.valence(v)};
    begin += std::max(rings.valence(v), EditableSurface::kMaxValence);
  }
  result.ring_vertices.resize(begin);
  result.ring_faces.resize(begin);
  for (VertexId v = 0; v < rings.vertex_count(); ++v) {
    std::ranges::copy(rings.vertices(v), result.ring_vertices.begin() + result.rows[v].begin);
    std::ranges::copy(rings.faces(v), result.ring_faces.begin() + result.rows[v].begin);
  }
  return result;
}

std::size_t new_triangles_at(const Patch& patch, VertexId v) {
  return static_cast<std::size_t>(
      std::ranges::count_if(patch.new_triangles, [v](const Triangle& t) { return std::ranges::count(t, v) > 0; }));
}

struct NewTriangle {
  FaceId face;
  VertexId next;
};

/// The new triangle (v, w, next).
NewTriangle new_triangle_after(const Patch& patch, VertexId v, VertexId w) {
  for (std::size_t i = 0; i < patch.new_triangles.size(); ++i) {
    const Triangle& t = patch.new_triangles[i];
    for (std::size_t j = 0; j < 3; ++j)
      if (t[j] == v && t[(j + 1) % 3] == w) return {patch.new_faces[i], t[(j + 2) % 3]};
  }
  return {};
}

std::size_t valence_after(const EditableSurface& surface, const Patch& patch, VertexId v) {
  const auto has_v = [&](FaceId f) { return std::ranges::count(surface.mesh().triangles[f], v) > 0; };
  return surface.valence(v) - static_cast<std::size_t>(std::ranges::count_if(patch.old_faces, has_v)) + new_triangles_at(patch, v);
}

VertexRings rings_of(const TriangleMesh& mesh) {
  const std::optional<VertexRings> rings = build_rings(mesh);
  if (!rings) throw InvalidMesh("remeshing needs a closed, oriented manifold");
  return spacious(*rings);
}

}  // namespace

EditableSurface::EditableSurface(const TriangleMesh& mesh)
    : mesh_(mesh), rings_(rings_of(mesh_)), guarded_(mesh_, rings_), is_face_used_(mesh_.triangle_count(), 1) {}

std::uint32_t EditableSurface::capacity(VertexId v) const {
  const auto end = v + 1 < rings_.rows.size() ? rings_.rows[v + 1].begin : static_cast<std::uint32_t>(rings_.ring_vertices.size());
  return end - rings_.rows[v].begin;
}

std::size_t EditableSurface::slot_of(VertexId v, VertexId w) const {
  const std::span<const VertexId> ring = rings_.vertices(v);
  return static_cast<std::size_t>(std::ranges::find(ring, w) - ring.begin());
}

bool EditableSurface::are_neighbours(VertexId v, VertexId w) const {
  return slot_of(v, w) < rings_.valence(v);
}

TriangleMesh EditableSurface::compacted() const {
  TriangleMesh result = mesh_;
  keep_triangles(result, is_face_used_);
  remove_isolated_vertices(result);
  return result;
}

EditableSurface::Spare EditableSurface::reserve(std::size_t vertices) {
  Spare spare;
  for (VertexId v = 0; v < mesh_.vertex_count() && spare.vertices.size() < vertices; ++v)
    if (!is_in_use(v) && capacity(v) == kMaxValence) spare.vertices.push_back(v);
  for (FaceId f = 0; f < mesh_.triangle_count() && spare.faces.size() < 2 * vertices; ++f)
    if (is_face_used_[f] == 0) spare.faces.push_back(f);
  while (spare.vertices.size() < vertices) {
    spare.vertices.push_back(static_cast<VertexId>(mesh_.points.size()));
    mesh_.points.emplace_back(Vec3::Zero());
    rings_.rows.push_back({static_cast<std::uint32_t>(rings_.ring_vertices.size()), 0});
    rings_.ring_vertices.resize(rings_.ring_vertices.size() + kMaxValence);
    rings_.ring_faces.resize(rings_.ring_vertices.size());
  }
  while (spare.faces.size() < 2 * vertices) {
    spare.faces.push_back(static_cast<FaceId>(mesh_.triangles.size()));
    mesh_.triangles.push_back({});
    is_face_used_.push_back(0);
  }
  guarded_.cones.resize(mesh_.vertex_count());
  guarded_.grid.grow(mesh_.triangle_count());
  return spare;
}

bool EditableSurface::has_room_for(const Patch& patch) const {
  return std::ranges::all_of(patch.boundary, [&](VertexId w) { return valence_after(*this, patch, w) <= capacity(w); });
}

void EditableSurface::replace(const Patch& patch) {
  put_faces(patch);
  for (std::size_t k = 0; k < patch.boundary.size(); ++k) edit_ring(patch, k);
  if (patch.removed != kNoVertex) rings_.rows[patch.removed].valence = 0;
  if (patch.added != kNoVertex) set_inner_ring(patch);
  for (const VertexId w : patch.boundary) refresh_cone(w);
  if (patch.added != kNoVertex) refresh_cone(patch.added);
}

void EditableSurface::put_faces(const Patch& patch) {
  for (const FaceId f : patch.old_faces) {
    if (std::ranges::find(patch.new_faces, f) != patch.new_faces.end()) continue;
    guarded_.grid.remove(f);
    is_face_used_[f] = 0;
  }
  for (std::size_t i = 0; i < patch.new_faces.size(); ++i) {
    const FaceId f = patch.new_faces[i];
    const Triangle& t = patch.new_triangles[i];
    const Box box = guarded_.grid.box_of(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]);
    mesh_.triangles[f] = t;
    if (is_face_used_[f] != 0)
      guarded_.grid.move(f, box);
    else
      guarded_.grid.add(f, box);
    is_face_used_[f] = 1;
  }
}

/// Around a vertex of the boundary, what lies between the next one and the previous one is exchanged.
void EditableSurface::edit_ring(const Patch& patch, std::size_t k) {
  const VertexId v = patch.boundary[k], from = patch.boundary[patch.next(k)], to = patch.boundary[patch.previous(k)];
  VertexRings::Row& row = rings_.rows[v];
  const auto vertices = rings_.ring_vertices.begin() + row.begin;
  const auto faces = rings_.ring_faces.begin() + row.begin;
  const auto first = static_cast<std::ptrdiff_t>(slot_of(v, from));
  std::rotate(vertices, vertices + first, vertices + row.valence);
  std::rotate(faces, faces + first, faces + row.valence);
  const auto old_count = static_cast<std::size_t>(std::find(vertices, vertices + row.valence, to) - vertices);
  const std::size_t kept = row.valence - old_count, new_count = new_triangles_at(patch, v);
  const auto shift = [&](auto row_begin) {
    const auto b = row_begin + static_cast<std::ptrdiff_t>(old_count), e = b + static_cast<std::ptrdiff_t>(kept);
    if (new_count > old_count)
      std::copy_backward(b, e, e + static_cast<std::ptrdiff_t>(new_count - old_count));
    else
      std::copy(b, e, row_begin + static_cast<std::ptrdiff_t>(new_count));
  };
  shift(vertices);
  shift(faces);
  VertexId w = from;
  for (std::size_t i = 0; i < new_count; ++i) {
    const auto [face, next] = new_triangle_after(patch, v, w);
    vertices[static_cast<std::ptrdiff_t>(i)] = w;
    faces[static_cast<std::ptrdiff_t>(i)] = face;
    w = next;
  }
  row.valence = static_cast<std::uint32_t>(kept + new_count);
}

void EditableSurface::set_inner_ring(const Patch& patch) {
  VertexRings::Row& row = rings_.rows[patch.added];
  row.valence = static_cast<std::uint32_t>(patch.boundary.size());
  for (std::size_t k = 0; k < patch.boundary.size(); ++k) {
    rings_.ring_vertices[row.begin + k] = patch.boundary[k];
    rings_.ring_faces[row.begin + k] = new_triangle_after(patch, patch.added, patch.boundary[k]).face;
  }
}

void EditableSurface::refresh_cone(VertexId v) {
  thread_local std::vector<Vec3> ring;
  thread_local std::vector<Eigen::Vector3f> directions;
  ring.clear();
  directions.clear();
  for (const VertexId w : rings_.vertices(v)) ring.push_back(mesh_.points[w]);
  for (std::size_t i = 0; i < ring.size(); ++i)
    directions.push_back(reliable_direction(mesh_.points[v], ring[i], ring[i + 1 < ring.size() ? i + 1 : 0]));
  guarded_.cones[v] = find_resting_cone(mesh_.points[v], ring, directions);
}

}  // namespace smopt
