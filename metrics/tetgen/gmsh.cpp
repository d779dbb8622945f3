#include "metrics/tetgen/gmsh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <iterator>

#include "smopt/io/text_writer.h"

namespace smopt::metrics {
namespace {

constexpr int kTriangleType = 2;     ///< Gmsh's number of a triangle with three nodes
constexpr int kTetrahedronType = 4;  ///< and of a tetrahedron with four

std::string entities(const TetMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : mesh.points) box.extend(p);
  if (box.isEmpty()) box.extend(Vec3::Zero().eval());
  const std::string bounds = TextWriter().point(box.min()).text(" ").point(box.max()).take();
  return fmt::format("$Entities\n0 0 1 1\n1 {0} 0 0\n1 {0} 0 1 1\n$EndEntities\n", bounds);
}

/// All nodes belong to the volume: one block, first the tags, then the coordinates.
std::string nodes(const TetMesh& mesh) {
  TextWriter out;
  out.text(fmt::format("$Nodes\n1 {0} 1 {0}\n3 1 0 {0}\n", mesh.points.size()));
  for (std::size_t i = 1; i <= mesh.points.size(); ++i) out.integer(i).text("\n");
  for (const Vec3& p : mesh.points) out.point(p).text("\n");
  return out.text("$EndNodes\n").take();
}

std::string elements(const TetMesh& mesh) {
  const std::size_t faces = mesh.boundary_faces.size();
  const std::size_t all = faces + mesh.tetrahedra.size();
  std::string text = fmt::format("$Elements\n2 {} 1 {}\n2 1 {} {}\n", all, all, kTriangleType, faces);
  std::size_t tag = 0;
  for (const auto& [a, b, c] : mesh.boundary_faces) fmt::format_to(std::back_inserter(text), "{} {} {} {}\n", ++tag, a + 1, b + 1, c + 1);
  text += fmt::format("3 1 {} {}\n", kTetrahedronType, mesh.tetrahedra.size());
  for (const auto& [a, b, c, d] : mesh.tetrahedra)
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {}\n", ++tag, a + 1, b + 1, c + 1, d + 1);
  return text + "$EndElements\n";
}

}  // namespace

std::string to_gmsh(const TetMesh& mesh) {
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + entities(mesh) + nodes(mesh) + elements(mesh);
}

}  // namespace smopt::metrics
