#include "metrics/solvation/triangle_integrals.h"

#include <cmath>

namespace smopt::metrics {
namespace {

/// After so many halvings a piece is some 2⁻⁵⁰ times as long as the triangle, which coordinates resolve no more.
constexpr int kMostHalvings = 100;

struct Node {
  Vec3 corner_weights;
  double weight;  ///< parts of the triangle's area
};

/// Radon's seven points: the centroid and two orbits.
std::array<Node, 7> radon_rule() {
  const double root = std::sqrt(15.0);
  const double inner = (6 - root) / 21, outer = (6 + root) / 21;
  const double inner_weight = (155 - root) / 1200, outer_weight = (155 + root) / 1200;
  const auto orbit = [](double at, int corner) {
    Vec3 weights = Vec3::Constant(at);
    weights[corner] = 1 - 2 * at;
    return weights;
  };
  return {{{Vec3::Constant(1.0 / 3), 9.0 / 40},
           {orbit(inner, 0), inner_weight},
           {orbit(inner, 1), inner_weight},
           {orbit(inner, 2), inner_weight},
           {orbit(outer, 0), outer_weight},
           {orbit(outer, 1), outer_weight},
           {orbit(outer, 2), outer_weight}}};
}

/// A point and a weight of the rule of Gauss and Legendre on [0, 1].
struct LineNode {
  double at;
  double weight;
};
constexpr std::array<LineNode, 4> kGauss4 = {{{0.06943184420297371, 0.17392742256872692},
                                              {0.33000947820757187, 0.32607257743127308},
                                              {0.66999052179242813, 0.32607257743127308},
                                              {0.93056815579702629, 0.17392742256872692}}};

void add(CornerIntegrals& sum, const KernelValues& values, const Vec3& shape, double weight) {
  for (int corner = 0; corner < 3; ++corner) sum[static_cast<std::size_t>(corner)].add(values, weight * shape[corner]);
}

/// Cuts one triangle for one target.
class TriangleIntegration {
 public:
  TriangleIntegration(const TargetPoint& target, const std::array<Vec3, 3>& corners, const SideHeights& heights,
                      const KernelParameters& parameters, const TriangleQuadrature& quadrature)
      : target_(target), heights_(heights), parameters_(parameters), largest_piece2_(quadrature.largest_piece * quadrature.largest_piece) {
    const Vec3 doubled = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double length = doubled.norm();
    if (!(length > 0)) return;
    normal_ = doubled / length;
    visit({corners, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}}, length / 2, 0);
  }

  CornerIntegrals sum{};

 private:
  /// Part of the triangle: its corners, and the shape functions there.
  struct Piece {
    std::array<Vec3, 3> corners;
    std::array<Vec3, 3> shapes;
  };

  void visit(const Piece& piece, double area, int halvings) {
    double longest2 = 0;
    std::size_t opposite = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double side2 = (piece.corners[(c + 1) % 3] - piece.corners[(c + 2) % 3]).squaredNorm();
      if (side2 > longest2) {
        longest2 = side2;
        opposite = c;
      }
    }
    const Vec3 centroid = (piece.corners[0] + piece.corners[1] + piece.corners[2]) / 3;
    if (longest2 <= largest_piece2_ * (target_.position - centroid).squaredNorm()) return add_rule(piece, area);
    if (halvings == kMostHalvings) return;
    const std::size_t first = (opposite + 1) % 3, second = (opposite + 2) % 3;
    Piece half = piece;
    half.corners[first] = 0.5 * (piece.corners[first] + piece.corners[second]);
    half.shapes[first] = 0.5 * (piece.shapes[first] + piece.shapes[second]);
    Piece other = piece;
    other.corners[second] = half.corners[first];
    other.shapes[second] = half.shapes[first];
    visit(half, area / 2, halvings + 1);
    visit(other, area / 2, halvings + 1);
  }

  void add_rule(const Piece& piece, double area) {
    static const std::array<Node, 7> rule = radon_rule();
    for (const Node& node : rule) {
      const Vec3& w = node.corner_weights;
      const Vec3 y = w[0] * piece.corners[0] + w[1] * piece.corners[1] + w[2] * piece.corners[2];
      const Vec3 shape = w[0] * piece.shapes[0] + w[1] * piece.shapes[1] + w[2] * piece.shapes[2];
      add(sum, kernel_values(target_.position - y, target_.normal, normal_, parameters_, lift_at(shape)), shape, node.weight * area);
    }
  }

  /// How far the surface is above the triangle.
  [[nodiscard]] double lift_at(const Vec3& shape) const {
    return -(shape[0] * shape[1] * heights_.of_01 + shape[1] * shape[2] * heights_.of_12 + shape[2] * shape[0] * heights_.of_20);
  }

  const TargetPoint& target_;
  const SideHeights& heights_;
  const KernelParameters& parameters_;
  double largest_piece2_;
  Vec3 normal_ = Vec3::Zero();
};

/// Cuts one triangle, in angles around the target that is its first corner.
class CornerIntegration {
 public:
  CornerIntegration(const TargetPoint& target, const std::array<Vec3, 3>& corners, const SideHeights& heights,
                    const KernelParameters& parameters, const TriangleQuadrature& quadrature)
      : target_(target),
        parameters_(parameters),
        largest_piece_(quadrature.largest_piece),
        heights_(heights),
        a_(corners[1] - corners[0]),
        b_(corners[2] - corners[0]) {
    const Vec3 doubled = a_.cross(b_);
    doubled_area_ = doubled.norm();
    if (!(doubled_area_ > 0)) return;
    n_nu_ = target.normal.dot(doubled / doubled_area_);
    visit(0, 1, 0);
  }

  CornerIntegrals sum{};

 private:
  [[nodiscard]] Vec3 side_at(double t) const { return (1 - t) * a_ + t * b_; }

  void visit(double begin, double end, int halvings) {
    const double middle = 0.5 * (begin + end);
    const double length = (end - begin) * (b_ - a_).norm();
    if (length <= largest_piece_ * side_at(middle).norm() || halvings == kMostHalvings) return add_rule(begin, end);
    visit(begin, middle, halvings + 1);
    visit(middle, end, halvings + 1);
  }

  void add_rule(double begin, double end) {
    for (const LineNode& across : kGauss4) {
      const double t = begin + (end - begin) * across.at;
      const double side = side_at(t).norm();
      const double height = parabola_at(t);
      for (const LineNode& along : kGauss4)
        add(sum, values_at(along.at * side, along.at * along.at * height), Vec3(1 - along.at, along.at * (1 - t), along.at * t),
            across.weight * (end - begin) * along.weight * along.at * doubled_area_);
    }
  }

  /// The height at the opposite side; within the triangle it is s² times that.
  [[nodiscard]] double parabola_at(double t) const {
    const double a = heights_.of_01, b = heights_.of_20;
    return (1 - t) * (1 - t) * a + t * t * b + t * (1 - t) * (a + b - heights_.of_12);
  }

  /// At a distance r in the plane of the triangle, where ν·ρ = 0 and n·ρ is minus the height.
  [[nodiscard]] KernelValues values_at(double r, double height) const {
    const RadialKernels radial = radial_kernels(r, parameters_.kappa);
    const double epsilon = parameters_.ratio;
    KernelValues k;
    k.k1 = radial.g_difference;
    k.k3 = ((1 - 1 / epsilon) * radial.a_plain + radial.a_difference / epsilon) * height;
    k.k4 = -radial.a_difference * n_nu_;
    return k;
  }

  const TargetPoint& target_;
  const KernelParameters& parameters_;
  double largest_piece_;
  const SideHeights& heights_;
  Vec3 a_, b_;
  double doubled_area_ = 0;
  double n_nu_ = 0;
};

}  // namespace

CornerIntegrals integrate(const TargetPoint& target, const std::array<Vec3, 3>& corners, const SideHeights& heights,
                          const KernelParameters& parameters, const TriangleQuadrature& quadrature) {
  return TriangleIntegration(target, corners, heights, parameters, quadrature).sum;
}

CornerIntegrals integrate_at_corner(const TargetPoint& target, const std::array<Vec3, 3>& corners, const SideHeights& heights,
                                    const KernelParameters& parameters, const TriangleQuadrature& quadrature) {
  return CornerIntegration(target, corners, heights, parameters, quadrature).sum;
}

}  // namespace smopt::metrics
