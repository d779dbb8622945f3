#include "tests/improve/guarantee/ball_makers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/improve/hard_shapes.h"
#include "tests/improve/judge.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

/// A tetrahedron with corners at distance `radius` of `center`, turned at random.
TriangleMesh speck(Random& random, const Vec3& center, double radius) {
  const TriangleMesh regular = scaled(tetrahedron(), radius / std::numbers::sqrt3);
  return translated(rotated(regular, random.direction(), random.uniform(0, 2 * std::numbers::pi)), center);
}

/// A sphere some of whose vertices are moved to `factor` times their distance; `tips` gets these.
TriangleMesh sphere_with_tips(Random& random, double roughness, double factor, std::vector<Vec3>& tips) {
  TriangleMesh mesh = noisy(icosphere(2), 0.03 * roughness, random.seed());
  const auto every = static_cast<std::size_t>(random.integer(7, 30));
  for (std::size_t v = 0; v < mesh.points.size(); v += every) {
    mesh.points[v] *= factor;
    tips.push_back(mesh.points[v]);
  }
  return mesh;
}

/// One link of a chain: a torus of major radius 1 around z, or around y for every other link.
TriangleMesh link(Random& random, double minor_radius, int index) {
  constexpr double kDistance = 1.6;  // of the centres of two links: each goes through the other's hole
  const TriangleMesh ring = torus(1, minor_radius, random.integer(16, 30), random.integer(5, 10));
  const double turn = std::numbers::pi / 2 * (index % 2) + random.uniform(-0.3, 0.3);
  return translated(rotated(ring, {1, 0, 0}, turn), {kDistance * index, 0, 0});
}

Vec3 face_normal(const TriangleMesh& mesh, const Triangle& t) {
  return (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]).normalized();
}

/// A tetrahedron with one face parallel to the triangle at a signed distance from it, pointing away from it.
TriangleMesh hovering_over(const TriangleMesh& mesh, const Triangle& t, double distance, double size) {
  const Vec3 a = mesh.points[t[0]], b = mesh.points[t[1]], c = mesh.points[t[2]];
  const Vec3 center = (a + b + c) / 3, normal = face_normal(mesh, t), foot = center + distance * normal;
  const Vec3 top = foot + (distance > 0 ? size : -size) * (b - a).norm() * normal;
  TriangleMesh result{{foot + size * (a - center), foot + size * (b - center), foot + size * (c - center), top},
                      {{1, 0, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  return distance > 0 ? result : reversed(result);
}

}  // namespace

TriangleMesh noisy_sphere(Random& random, double roughness) {
  const int subdivisions = random.integer(2, 3);
  return noisy(icosphere(subdivisions), roughness * random.uniform(0.05, 0.5) / (1 << subdivisions), random.seed());
}

TriangleMesh noisy_torus(Random& random, double roughness) {
  const int n_major = random.integer(12, 60), n_minor = random.integer(5, 20);
  const double minor = random.uniform(0.05, 0.9);
  const double shortest = std::min(2 * (1 - minor) / n_major, minor / n_minor) * std::numbers::pi;
  return noisy(torus(1, minor, n_major, n_minor), roughness * random.uniform(0.1, 0.9) * shortest, random.seed());
}

TriangleMesh needles(Random& random, double roughness) {
  const TriangleMesh sphere = noisy(icosphere(random.integer(2, 3)), 0.03 * roughness, random.seed());
  return spiky(sphere, static_cast<std::size_t>(random.integer(3, 20)), random.uniform(2, 20));
}

TriangleMesh spikes_with_specks(Random& random, double roughness) {
  std::vector<Vec3> tips;
  const double factor = random.uniform(2, 8);
  TriangleMesh mesh = sphere_with_tips(random, roughness, factor, tips);
  constexpr double kFoot = 0.25;  // half the width of a spike where it leaves the sphere
  for (const Vec3& tip : tips) {
    const double t = random.uniform(0.1, 0.9), height = 1 + t * (factor - 1), width = kFoot * (1 - t) * roughness;
    const Vec3 axis = tip.normalized(), side = axis.cross(random.direction()).normalized();
    const bool is_inside = random.coin();
    const Vec3 center = height * axis + (is_inside ? 0.1 : 2.0) * width * side;
    mesh = joined(mesh, speck(random, center, width * random.power_of_ten(-4, -0.7)));
  }
  return mesh;
}

TriangleMesh dents_with_specks(Random& random, double roughness) {
  std::vector<Vec3> tips;
  const double factor = random.uniform(0.02, 0.5);
  TriangleMesh mesh = sphere_with_tips(random, roughness, factor, tips);
  constexpr double kMouth = 0.2;  // half the width of a dent at the sphere
  for (const Vec3& tip : tips) {
    const double t = random.uniform(0.1, 0.9), width = kMouth * t;
    const Vec3 center = (factor + t * (1 - factor)) * tip.normalized() + random.in_ball(0.3 * roughness * width);
    mesh = joined(mesh, speck(random, center, width * random.power_of_ten(-4, -0.7) * roughness));
  }
  return mesh;
}

TriangleMesh shells_that_nearly_touch(Random& random, double roughness) {
  const TriangleMesh inner = noisy(icosphere(2), 0.08 * roughness, random.seed());
  const TriangleMesh outer = scaled(inner, 1 + random.power_of_ten(-12, -3));
  const TriangleMesh core = random.coin() ? reversed(inner) : inner;
  return random.coin() ? joined(outer, core) : joined(core, outer);
}

TriangleMesh nested_components(Random& random, double roughness) {
  TriangleMesh mesh;
  double radius = 1;
  for (int depth = 0; depth < random.integer(2, 5); ++depth, radius *= random.uniform(0.6, 0.75)) {
    const TriangleMesh ball = noisy(icosphere(random.integer(1, 2), radius), 0.05 * roughness * radius, random.seed());
    mesh = joined(mesh, depth % 2 == 1 ? reversed(ball) : ball);
  }
  mesh = joined(mesh, speck(random, random.in_ball(0.1 * radius), 0.2 * radius));
  mesh = joined(mesh, noisy(icosphere(1, 0.5, {1.7, 0, 0}), 0.03 * roughness, random.seed()));
  return joined(mesh, translated(noisy(torus(0.3, 0.1, 12, 6), 0.01 * roughness, random.seed()), {0, 0, 1.4}));
}

TriangleMesh linked_tori(Random& random, double roughness) {
  TriangleMesh mesh;
  const int links = random.integer(2, 4);
  const double minor_radius = random.uniform(0.03, 0.2);
  for (int i = 0; i < links; ++i) mesh = joined(mesh, link(random, minor_radius, i));
  return noisy(mesh, roughness * random.uniform(0.05, 0.5) * minor_radius, random.seed());
}

TriangleMesh knot(Random& random, double roughness) {
  return noisy(knotted_tube(), roughness * random.uniform(0.01, 0.08), random.seed());
}

TriangleMesh badly_graded_sphere(Random& random, double roughness) {
  TriangleMesh mesh = icosphere(random.integer(2, 3));
  const Vec3 axis = random.direction();
  constexpr double kLowest = -3, kHighest = 1.5;  // exponents of the radius: edges are about a fifteenth of it
  for (Vec3& p : mesh.points) {
    const double height = 0.5 * (1 + p.dot(axis));
    p *= std::pow(10, kLowest + (kHighest - kLowest) * height) * random.uniform(1 - 0.2 * roughness, 1);
  }
  return mesh;
}

TriangleMesh flattened(Random& random, double roughness) {
  TriangleMesh mesh = random.coin() ? noisy_sphere(random, roughness) : noisy_torus(random, roughness);
  const double factor = random.power_of_ten(-12, -2);
  for (Vec3& p : mesh.points) p.z() *= factor;
  return mesh;
}

TriangleMesh redundant_points(Random& random, double roughness) {
  TriangleMesh mesh =
      random.coin() ? noisy(icosphere(1), 0.1 * roughness, random.seed()) : plate(random.integer(2, 4), random.uniform(0.5, 2));
  if (random.coin()) mesh = with_points_on_edges(mesh, random.seed());
  mesh = with_points_in_faces(mesh, random.seed());
  if (mesh.vertex_count() < 400) mesh = with_points_in_faces(mesh, random.seed());
  return noisy(mesh, roughness * random.power_of_ten(-7, -3), random.seed());
}

TriangleMesh lattice(Random& random, double /*roughness*/) {
  return random_molecule_surface(static_cast<std::size_t>(random.integer(8, 30)), random.seed());
}

TriangleMesh fans(Random& random, double roughness) {
  const int ring = random.integer(100, 200);
  TriangleMesh mesh{{{0, 0, random.power_of_ten(-3, 1)}, {0, 0, -random.power_of_ten(-3, 1)}}, {}};
  const auto point = [ring](int i) { return static_cast<VertexId>(2 + i % ring); };
  for (int i = 0; i < ring; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.uniform(0, 0.9 * roughness)) / ring;
    const double radius = random.uniform(1 - 0.9 * roughness, 1);
    mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    mesh.triangles.insert(mesh.triangles.end(), {{point(i), point(i + 1), 0}, {point(i + 1), point(i), 1}});
  }
  return mesh;
}

TriangleMesh pleats(Random& random, double roughness) {
  const int ring = random.integer(8, 30);
  const double distance = random.power_of_ten(-4, 0), height = random.power_of_ten(-0.3, 0.7) * roughness;
  TriangleMesh mesh{{{0, 0, distance}, {0, 0, -distance}}, {}};
  const auto point = [ring](int i) { return static_cast<VertexId>(2 + i % ring); };
  for (int i = 0; i < ring; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.uniform(0, 0.5)) / ring, radius = random.uniform(0.3, 1);
    mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), random.uniform(0.3, 1) * (i % 2 == 0 ? height : -height));
    mesh.triangles.insert(mesh.triangles.end(), {{point(i), point(i + 1), 0}, {point(i + 1), point(i), 1}});
  }
  while (mesh.vertex_count() < 100) mesh = with_points_on_edges(mesh, random.seed());
  return noisy(mesh, roughness * random.power_of_ten(-6, -2) * distance, random.seed());
}

TriangleMesh crumpled(Random& random, double roughness) {
  const TriangleMesh smooth =
      random.coin() ? icosphere(2) : torus(1, random.uniform(0.2, 0.6), random.integer(16, 30), random.integer(6, 12));
  const std::uint32_t seed = random.seed();
  constexpr double kWild = 1;  // radii: certainly too much
  double none = 0, some = kWild;
  while (some - none > 0.03 * some) {
    const double middle = 0.5 * (none + some);
    (intersecting_pairs(noisy(smooth, middle, seed)).empty() ? none : some) = middle;
  }
  return noisy(smooth, roughness * none, seed);
}

TriangleMesh hovering_specks(Random& random, double roughness) {
  const TriangleMesh sphere = noisy(icosphere(2), 0.05 * roughness, random.seed());
  TriangleMesh mesh = sphere;
  for (FaceId f = 0; f < sphere.triangle_count(); f += static_cast<FaceId>(random.integer(2, 8))) {
    const double distance = random.power_of_ten(-10, -3);
    mesh = joined(mesh, hovering_over(sphere, sphere.triangles[f], random.coin() ? distance : -distance, random.uniform(0.01, 0.3)));
  }
  return mesh;
}

TriangleMesh tetrahedra(Random& random, double roughness) {
  constexpr int kPerAxis = 3;
  TriangleMesh mesh;
  for (int cell = 0; cell < kPerAxis * kPerAxis * kPerAxis; ++cell) {
    const Vec3 center(cell % 3, cell / 3 % 3, cell / 9);
    double radius = random.uniform(0.1, 0.499);
    const TriangleMesh outer = speck(random, center + random.in_ball((0.499 - radius) * roughness), radius);
    mesh = joined(mesh, outer);
    if (!random.coin()) continue;
    const Vec3 middle = (outer.points[0] + outer.points[1] + outer.points[2] + outer.points[3]) / 4;
    mesh = joined(mesh, reversed(speck(random, middle, 0.3 * radius)));
  }
  return mesh;
}

}  // namespace smopt::testing
