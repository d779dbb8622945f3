#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "smopt/improve/remesh/remesh_goals.h"
#include "smopt/mesh/triangle_mesh.h"

/// What remeshing aims at, measured from the triangles alone.
namespace smopt::testing {

/// One goal: the worst there is, and how many triangles, edges or vertices miss it.
struct GoalMeasure {
  std::string name;
  double worst = 0;
  std::size_t surely_missing = 0;   ///< by more than rounding
  std::size_t perhaps_missing = 0;  ///< these, and those that rounding decides about
};

/// In the order of `RemeshGoals`. Dihedral angles are the smaller of inside and outside; of valences the largest distance from 6 counts.
/// \pre the mesh is a closed manifold.
std::array<GoalMeasure, 5> measure_goals(const TriangleMesh& mesh, const RemeshGoals& goals);

double smallest_angle(const TriangleMesh& mesh);
double largest_angle(const TriangleMesh& mesh);

/// The lengths of all edges, each once.
std::vector<double> edge_lengths(const TriangleMesh& mesh);
double mean_edge_length(const TriangleMesh& mesh);

/// Vertices that are in a triangle.
std::size_t used_vertices(const TriangleMesh& mesh);

/// The components as meshes of their own, in the order of their lowest vertex.
std::vector<TriangleMesh> components_of(const TriangleMesh& mesh);

}  // namespace smopt::testing
