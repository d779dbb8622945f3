#include "experiments/figures/pair_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "smopt/geometry/triangle_shape.h"

namespace smopt::experiments {
namespace {

using Corners = std::array<Vec3, 3>;

/// By how much a point may be outside a triangle, or before it, and still count as on it: a share of the triangle's size. Far above rounding,
/// far below what a picture shows.
constexpr double kTolerance = 1e-7;
constexpr int kCrossingSamples = 12;  ///< along the crossing
constexpr int kTriangleSamples = 8;   ///< along each side of a triangle
constexpr double kAllSamples = kTriangleSamples * kTriangleSamples;

/// Of the light of what is behind a layer of the surroundings or behind the other triangle of the pair: all are drawn translucent.
constexpr double kShowsThrough = 0.5;
/// The radius of the piece that is shown, in those of the smallest sphere around its centre that holds the pair: some triangles to all sides.
constexpr double kPieceRadius = 3.5;

Corners corners_of(const TriangleMesh& mesh, FaceId face) {
  const Triangle& triangle = mesh.triangles[face];
  return {mesh.points[triangle[0]], mesh.points[triangle[1]], mesh.points[triangle[2]]};
}

double size_of(const Corners& t) {
  return std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
}

/// The share of each corner in a point of the triangle's plane.
Vec3 barycentric(const Corners& t, const Vec3& p) {
  const Vec3 normal = doubled_area_vector(t[0], t[1], t[2]);
  const double area2 = normal.squaredNorm();
  return Vec3(doubled_area_vector(p, t[1], t[2]).dot(normal), doubled_area_vector(t[0], p, t[2]).dot(normal),
              doubled_area_vector(t[0], t[1], p).dot(normal)) /
         area2;
}

/// Adds the points in which the edges of one triangle meet the other.
void add_edge_hits(const Corners& edges, const Corners& other, std::vector<Vec3>& hits) {
  const Vec3 normal = doubled_area_vector(other[0], other[1], other[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &p = edges[i], &q = edges[(i + 1) % 3];
    const double above = (p - other[0]).dot(normal), below = (q - other[0]).dot(normal);
    if (above == below || above * below > 0) continue;
    const Vec3 hit = p + (above / (above - below)) * (q - p);
    if (barycentric(other, hit).minCoeff() >= -kTolerance) hits.push_back(hit);
  }
}

/// The i-th of n points spread evenly over the sphere (Fibonacci's lattice).
Vec3 direction(int i, int n) {
  const double height = 1 - (2.0 * i + 1) / n;
  const double turn = 2 * std::numbers::pi * i / std::numbers::phi;
  const double radius = std::sqrt(1 - height * height);
  return {radius * std::cos(turn), radius * std::sin(turn), height};
}

/// The centres of the n² like triangles that a triangle is made of.
std::vector<Vec3> samples_of(const Corners& t) {
  constexpr int n = kTriangleSamples;
  std::vector<Vec3> samples;
  const auto add = [&](double b, double c) { samples.emplace_back(t[0] + b / n * (t[1] - t[0]) + c / n * (t[2] - t[0])); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      add(i + 1.0 / 3, j + 1.0 / 3);
      if (i + j < n - 1) add(i + 2.0 / 3, j + 2.0 / 3);
    }
  }
  return samples;
}

/// A pair with what does not depend on the direction.
struct Crossing {
  std::pair<FaceId, FaceId> pair;
  std::array<Corners, 2> triangles;
  std::array<Vec3, 2> ends;
  double most = 0;  ///< no direction shows more
};

Sphere piece_around(const Crossing& crossing) {
  Sphere piece{(crossing.ends[0] + crossing.ends[1]) / 2, 0};
  for (const Corners& t : crossing.triangles)
    for (const Vec3& corner : t) piece.radius = std::max(piece.radius, kPieceRadius * (corner - piece.centre).norm());
  return piece;
}

double area_of(const Corners& t) {
  return doubled_area_vector(t[0], t[1], t[2]).norm() / 2;
}

/// The smallest of the lengths that are to be large: the crossing's, and the square root of each triangle's area.
double smallest(double crossing, double area_a, double area_b) {
  return std::min({crossing, std::sqrt(area_a), std::sqrt(area_b)});
}

/// Of all pairs that have a crossing; those that may be shown largest come first.
std::vector<Crossing> crossings_of(const TriangleMesh& mesh, std::span<const std::pair<FaceId, FaceId>> pairs) {
  std::vector<Crossing> crossings;
  for (const auto& pair : pairs) {
    const Corners a = corners_of(mesh, pair.first), b = corners_of(mesh, pair.second);
    const auto ends = crossing_of(a, b);
    if (ends) crossings.push_back({pair, {a, b}, *ends, smallest(((*ends)[1] - (*ends)[0]).norm(), area_of(a), area_of(b))});
  }
  std::stable_sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.most > b.most; });
  return crossings;
}

/// A look along a direction: the first two coordinates are those of the picture, the third grows towards the viewer.
Eigen::Matrix3d view_along(const Vec3& towards) {
  Eigen::Matrix3d rows;
  rows.row(0) = towards.unitOrthogonal();
  rows.row(1) = towards.cross(rows.row(0).transpose());
  rows.row(2) = towards;
  return rows;
}

Corners seen_along(const Eigen::Matrix3d& view, const Corners& t) {
  return {view * t[0], view * t[1], view * t[2]};
}

/// Twice the signed area of a triangle in the picture.
double doubled_picture_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Whether the triangle is in front of the point, all in the view's coordinates.
bool hides(const Corners& t, const Vec3& p) {
  const double area = doubled_picture_area(t[0], t[1], t[2]);
  if (area == 0) return false;
  const Vec3 shares(doubled_picture_area(p, t[1], t[2]) / area, doubled_picture_area(t[0], p, t[2]) / area,
                    doubled_picture_area(t[0], t[1], p) / area);
  const double height = shares[0] * t[0][2] + shares[1] * t[1][2] + shares[2] * t[2][2];
  return shares.minCoeff() > 0 && height > p[2] + kTolerance * size_of(t);
}

/// A point of the pair, and how much of it shows through what is in front.
struct Sample {
  Vec3 place;
  double shown = 1;
};

/// Points of the crossing or of a triangle, in a picture.
class Samples {
 public:
  void add(const Vec3& place) { samples_.push_back({place}); }
  void put_before(const Corners& t, double shows_through) {
    for (Sample& sample : samples_)
      if (hides(t, sample.place)) sample.shown *= shows_through;
  }
  [[nodiscard]] double shown() const {
    return std::accumulate(samples_.begin(), samples_.end(), 0.0, [](double sum, const Sample& sample) { return sum + sample.shown; });
  }

 private:
  std::vector<Sample> samples_;
};

/// A pair in a picture, and how much of it shows.
class PairPicture {
 public:
  PairPicture(const Crossing& crossing, const Eigen::Matrix3d& view)
      : pair_(crossing.pair), triangles_{seen_along(view, crossing.triangles[0]), seen_along(view, crossing.triangles[1])} {
    const Vec3 a = view * crossing.ends[0], b = view * crossing.ends[1];
    length_ = (b - a).head<2>().norm();
    for (int i = 0; i < kCrossingSamples; ++i) crossing_.add(a + (i + 0.5) / kCrossingSamples * (b - a));
    for (std::size_t i = 0; i < 2; ++i) {
      const Corners& t = triangles_[i];
      area_[i] = std::abs(doubled_picture_area(t[0], t[1], t[2])) / 2;
      for (const Vec3& p : samples_of(t)) samples_[i].add(p);
      samples_[i].put_before(triangles_[1 - i], kShowsThrough);  // not before the crossing, which is in both
    }
    for (const Corners& t : triangles_) {
      low_ = low_.cwiseMin(t[0]).cwiseMin(t[1]).cwiseMin(t[2]);
      high_ = high_.cwiseMax(t[0]).cwiseMax(t[1]).cwiseMax(t[2]);
    }
  }

  /// Takes into account a triangle of the mesh.
  void add_surroundings(FaceId face, const Corners& t) {
    if (face == pair_.first || face == pair_.second || !is_in_front(t)) return;
    crossing_.put_before(t, kShowsThrough);
    for (Samples& samples : samples_) samples.put_before(t, kShowsThrough);
  }

  [[nodiscard]] double shown() const {
    return smallest(length_ * crossing_.shown() / kCrossingSamples, area_[0] * samples_[0].shown() / kAllSamples,
                    area_[1] * samples_[1].shown() / kAllSamples);
  }

 private:
  [[nodiscard]] bool is_in_front(const Corners& t) const {
    const Vec3 low = t[0].cwiseMin(t[1]).cwiseMin(t[2]), high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
    return low[0] < high_[0] && low[1] < high_[1] && high[0] > low_[0] && high[1] > low_[1] && high[2] > low_[2];
  }

  std::pair<FaceId, FaceId> pair_;
  std::array<Corners, 2> triangles_;
  Vec3 low_ = Vec3::Constant(HUGE_VAL), high_ = Vec3::Constant(-HUGE_VAL);
  double length_ = 0;
  std::array<double, 2> area_{};
  Samples crossing_;
  std::array<Samples, 2> samples_;
};

/// Keeps the best of all pairs and directions that it is shown.
class Search {
 public:
  explicit Search(const TriangleMesh& mesh) : mesh_(mesh) {}

  [[nodiscard]] bool may_be_better(double shown) const { return shown > most_; }

  void look_at(const Crossing& crossing) {
    const Sphere piece = piece_around(crossing);
    const std::vector<FaceId> faces = faces_in(mesh_, piece);
    for (int i = 0; i < kDirections; ++i) {
      const Eigen::Matrix3d view = view_along(direction(i, kDirections));
      PairPicture picture(crossing, view);
      for (const FaceId face : faces) {
        if (!may_be_better(picture.shown())) break;
        picture.add_surroundings(face, seen_along(view, corners_of(mesh_, face)));
      }
      if (!may_be_better(picture.shown())) continue;
      most_ = picture.shown();
      best_ = {crossing.pair, crossing.ends, view.row(2), piece};
    }
  }

  [[nodiscard]] const std::optional<PairView>& best() const { return best_; }

 private:
  const TriangleMesh& mesh_;
  double most_ = 0;  ///< that is shown by the best, Å
  std::optional<PairView> best_;
};

}  // namespace

std::optional<std::array<Vec3, 2>> crossing_of(const Corners& a, const Corners& b) {
  std::vector<Vec3> hits;
  add_edge_hits(a, b, hits);
  add_edge_hits(b, a, hits);
  std::array<Vec3, 2> longest{Vec3::Zero(), Vec3::Zero()};
  for (const Vec3& p : hits)
    for (const Vec3& q : hits)
      if ((q - p).squaredNorm() > (longest[1] - longest[0]).squaredNorm()) longest = {p, q};
  const bool is_point = (longest[1] - longest[0]).norm() <= kTolerance * std::min(size_of(a), size_of(b));
  return is_point ? std::nullopt : std::optional(longest);
}

std::vector<FaceId> faces_in(const TriangleMesh& mesh, const Sphere& sphere) {
  const auto is_inside = [&](VertexId v) { return (mesh.points[v] - sphere.centre).squaredNorm() < sphere.radius * sphere.radius; };
  std::vector<FaceId> faces;
  for (FaceId face = 0; face < mesh.triangle_count(); ++face)
    if (std::ranges::any_of(mesh.triangles[face], is_inside)) faces.push_back(face);
  return faces;
}

std::optional<PairView> find_pair_view(const TriangleMesh& mesh, std::span<const std::pair<FaceId, FaceId>> pairs) {
  Search search(mesh);
  for (const Crossing& crossing : crossings_of(mesh, pairs)) {
    if (!search.may_be_better(crossing.most)) break;
    search.look_at(crossing);
  }
  return search.best();
}

}  // namespace smopt::experiments
