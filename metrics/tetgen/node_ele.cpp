#include "metrics/tetgen/node_ele.h"

#include <fmt/format.h>

#include <iterator>

#include "smopt/io/text_writer.h"

namespace smopt::metrics {

std::string to_node(const TetMesh& mesh) {
  TextWriter out;
  out.text(fmt::format("{} 3 0 0\n", mesh.points.size()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i) out.integer(i).text(" ").point(mesh.points[i]).text("\n");
  return out.take();
}

std::string to_ele(const TetMesh& mesh) {
  std::string text = fmt::format("{} 4 0\n", mesh.tetrahedra.size());
  std::size_t number = 0;
  for (const auto& [a, b, c, d] : mesh.tetrahedra) fmt::format_to(std::back_inserter(text), "{} {} {} {} {}\n", number++, a, b, c, d);
  return text;
}

std::string to_face(const TetMesh& mesh) {
  std::string text = fmt::format("{} 1\n", mesh.boundary_faces.size());
  for (std::size_t i = 0; i < mesh.boundary_faces.size(); ++i) {
    const auto& [a, b, c] = mesh.boundary_faces[i];
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {}\n", i, a, b, c, mesh.surface_triangle[i] + 1);
  }
  return text;
}

}  // namespace smopt::metrics
