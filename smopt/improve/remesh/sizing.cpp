#include "smopt/improve/remesh/sizing.h"

#include <algorithm>
#include <cmath>

#include "smopt/geometry/triangle_shape.h"
#include "smopt/parallel.h"

namespace smopt {
namespace {

/// Remeshing ends with so many more vertices than equilateral triangles of the sizes would have: edges between what is split and what is collapsed
/// stay as they are. Seen on four molecules, 1.02 to 1.05.
constexpr double kSurplus = 1.035;
/// How often values are averaged over the ring: features smaller than about three rings go.
constexpr int kAveragings = 10;
/// Area of an equilateral triangle with edges of length 1.
const double kEquilateralArea = std::sqrt(3.0) / 4;
/// Curvature sizing: the smallest and the largest size in means of the density.
constexpr double kSmallestSize = 0.25, kLargestSize = 4;
/// How much sizes grow with the distance: neighbours then differ by less than a third, and angles stay far from the goals.
constexpr double kGradation = 0.3;
/// Rings over which gradation is carried, at most; four times the mean is reached from a quarter in fewer.
constexpr int kGradationRounds = 30;

double area_of(const TriangleMesh& mesh, const Triangle& t) {
  return 0.5 * doubled_area_vector(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]).norm();
}

template <class ValueOf>
std::vector<double> for_all_vertices(const VertexRings& rings, const ValueOf& value_of) {
  std::vector<double> values(rings.vertex_count(), 0);
  for_ranges_in_parallel(values.size(), [&](std::size_t begin, std::size_t end) {
    for (auto v = static_cast<VertexId>(begin); v < end; ++v)
      if (rings.valence(v) > 0) values[v] = value_of(v);
  });
  return values;
}

std::vector<double> averaged(std::vector<double> values, const VertexRings& rings) {
  for (int i = 0; i < kAveragings; ++i) {
    values = for_all_vertices(rings, [&](VertexId v) {
      double sum = values[v];
      for (const VertexId w : rings.vertices(v)) sum += values[w];
      return sum / (rings.valence(v) + 1);
    });
  }
  return values;
}

std::vector<double> density_sizes(const TriangleMesh& mesh, const VertexRings& rings) {
  const std::vector<double> areas = averaged(for_all_vertices(rings,
                                                              [&](VertexId v) {
                                                                double sum = 0;
                                                                for (const FaceId f : rings.faces(v))
                                                                  sum += area_of(mesh, mesh.triangles[f]);
                                                                return sum / rings.valence(v);
                                                              }),
                                             rings);
  return for_all_vertices(rings, [&](VertexId v) { return std::sqrt(areas[v] / kEquilateralArea); });
}

double mean_of(const std::vector<double>& sizes) {
  double sum = 0;
  std::size_t count = 0;
  for (const double size : sizes) {
    sum += size;
    count += size > 0 ? 1 : 0;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

/// The rate at which the normal turns along the edges around each vertex, 1/Å: long edges count more, as on short ones it is noise.
std::vector<double> curvatures(const TriangleMesh& mesh, const VertexRings& rings) {
  std::vector<Vec3> normals(mesh.vertex_count(), Vec3::Zero());
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t) normals[v] += doubled_area_vector(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
  for (Vec3& normal : normals) normal.normalize();
  return averaged(for_all_vertices(rings,
                                   [&](VertexId v) {
                                     double turns2 = 0, lengths2 = 0;
                                     for (const VertexId w : rings.vertices(v)) {
                                       turns2 += (normals[v] - normals[w]).squaredNorm();
                                       lengths2 += (mesh.points[v] - mesh.points[w]).squaredNorm();
                                     }
                                     return lengths2 > 0 ? std::sqrt(turns2 / lengths2) : 0;
                                   }),
                  rings);
}

std::vector<double> graded(std::vector<double> sizes, const TriangleMesh& mesh, const VertexRings& rings) {
  for (int i = 0; i < kGradationRounds; ++i) {
    sizes = for_all_vertices(rings, [&](VertexId v) {
      double size = sizes[v];
      for (const VertexId w : rings.vertices(v)) size = std::min(size, sizes[w] + kGradation * (mesh.points[v] - mesh.points[w]).norm());
      return size;
    });
  }
  return sizes;
}

std::vector<double> curvature_sizes(const TriangleMesh& mesh, const VertexRings& rings, double chord_error) {
  const double mean = mean_of(density_sizes(mesh, rings));
  const std::vector<double> kappa = curvatures(mesh, rings);
  return graded(for_all_vertices(rings,
                                 [&](VertexId v) {
                                   const double squared = 6 * chord_error / std::max(kappa[v], 1e-300) - 3 * chord_error * chord_error;
                                   return std::clamp(std::sqrt(std::max(squared, 0.0)), kSmallestSize * mean, kLargestSize * mean);
                                 }),
                mesh, rings);
}

/// How many vertices a mesh of equilateral triangles of these sizes would have.
double equilateral_vertices(const TriangleMesh& mesh, const std::vector<double>& sizes) {
  double triangles = 0;
  for (const Triangle& t : mesh.triangles) {
    const double size = (sizes[t[0]] + sizes[t[1]] + sizes[t[2]]) / 3;
    if (size > 0) triangles += area_of(mesh, t) / (kEquilateralArea * size * size);
  }
  return triangles / 2;
}

std::vector<double> relative_sizes(const TriangleMesh& mesh, const VertexRings& rings, const RemeshOptions& options) {
  switch (options.sizing) {
    case Sizing::density:
      return density_sizes(mesh, rings);
    case Sizing::uniform:
      return for_all_vertices(rings, [&](VertexId) { return options.edge_length > 0 ? options.edge_length : 1.0; });
    case Sizing::curvature:
      return curvature_sizes(mesh, rings, options.chord_error);
  }
  return {};
}

/// \param equilateral  as many as the sizes would give by themselves.
double wanted_vertices(const TriangleMesh& mesh, const RemeshOptions& options, double equilateral) {
  if (options.vertices > 0) return static_cast<double>(options.vertices);
  const bool are_absolute = options.sizing == Sizing::curvature || (options.sizing == Sizing::uniform && options.edge_length > 0);
  return are_absolute ? equilateral : static_cast<double>(mesh.vertex_count());
}

}  // namespace

WantedSizes find_sizes(const TriangleMesh& mesh, const VertexRings& rings, const RemeshOptions& options) {
  WantedSizes wanted{relative_sizes(mesh, rings, options), 0};
  const double equilateral = equilateral_vertices(mesh, wanted.edges);
  wanted.vertices = wanted_vertices(mesh, options, equilateral);
  for (double& size : wanted.edges) size *= std::sqrt(kSurplus * equilateral / wanted.vertices);
  return wanted;
}

}  // namespace smopt
