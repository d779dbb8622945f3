#include "smopt/surface/cell_triangulation.h"

#include <algorithm>
#include <limits>
#include <span>
#include <stdexcept>

#include "smopt/surface/plain_cells.h"

namespace smopt {
namespace {

using Loop = std::span<const std::uint8_t>;
using Triangles = std::vector<PatchTriangle>;

double area(std::span<const Vec3> points, const PatchTriangle& t) {
  return 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).norm();
}

double area(std::span<const Vec3> points, const Triangles& triangles) {
  double sum = 0;
  for (const PatchTriangle& t : triangles) sum += area(points, t);
  return sum;
}

// ---- cells without ambiguous face ----

void append_best_fan(Loop loop, CellPatch& patch) {
  std::array<Vec3, cube::kEdges> corners;
  for (std::size_t i = 0; i < loop.size(); ++i) corners[i] = patch.points[loop[i]];
  const std::size_t apex = best_fan_apex({corners.data(), loop.size()});
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    patch.triangles.push_back({loop[apex], loop[(apex + i) % loop.size()], loop[(apex + i + 1) % loop.size()]});
}

// ---- candidates for one disc or annulus ----

/// Whether the straight line between two points of the patch lies in a face of the cube.
bool lies_in_face(std::uint8_t point, std::uint8_t other) {
  return point < cube::kEdges && other < cube::kEdges && cube::share_face(point, other);
}

/// One way to fill a loop or the band between two.
struct Candidate {
  Triangles triangles;
  double area = 0;
};

/// All triangulations of a polygon none of whose diagonals lies in a face of the cube.
class PolygonTriangulations {
 public:
  explicit PolygonTriangulations(Loop loop) : loop_(loop) {}

  [[nodiscard]] std::vector<Triangles> all() const { return between(0, loop_.size() - 1); }

 private:
  /// Of the polygon first, first + 1, …, last.
  [[nodiscard]] std::vector<Triangles> between(std::size_t first, std::size_t last) const {
    if (last - first < 2) return {Triangles{}};
    std::vector<Triangles> found;
    for (std::size_t apex = first + 1; apex < last; ++apex) {
      if (is_allowed(first, apex) && is_allowed(apex, last)) append_products(first, apex, last, found);
    }
    return found;
  }

  void append_products(std::size_t first, std::size_t apex, std::size_t last, std::vector<Triangles>& found) const {
    const std::vector<Triangles> right = between(apex, last);
    if (right.empty()) return;
    for (const Triangles& left : between(first, apex)) {
      for (const Triangles& other : right) {
        Triangles& sum = found.emplace_back(left);
        sum.insert(sum.end(), other.begin(), other.end());
        sum.push_back({loop_[first], loop_[apex], loop_[last]});
      }
    }
  }

  [[nodiscard]] bool is_allowed(std::size_t i, std::size_t j) const { return j - i == 1 || !lies_in_face(loop_[i], loop_[j]); }

  Loop loop_;
};

/// All triangulations of the band between two loops without points of its own and without an edge in a face of the cube. Both loops
/// run anticlockwise seen from the outside of the surface, so the band follows one forwards and the other backwards.
class BandTriangulations {
 public:
  BandTriangulations(Loop forward, Loop backward) : forward_(forward), backward_(backward) {}

  std::vector<Triangles> all() {
    for (std::size_t start = 0; start < backward_.size(); ++start) {
      start_ = start;
      if (is_allowed(0, 0)) advance(0, 0);
    }
    return std::move(found_);
  }

 private:
  [[nodiscard]] std::uint8_t front(std::size_t i) const { return forward_[i % forward_.size()]; }
  [[nodiscard]] std::uint8_t back(std::size_t j) const {
    return backward_[(start_ + backward_.size() - j % backward_.size()) % backward_.size()];
  }
  [[nodiscard]] bool is_allowed(std::size_t i, std::size_t j) const { return !lies_in_face(front(i), back(j)); }

  /// From the cross edge front(i)–back(j): the next triangle takes a step on one loop or on the other.
  void advance(std::size_t i, std::size_t j) {
    if (i == forward_.size() && j == backward_.size()) {
      found_.push_back(current_);
      return;
    }
    if (i < forward_.size() && is_allowed(i + 1, j)) step({front(i), front(i + 1), back(j)}, i + 1, j);
    if (j < backward_.size() && is_allowed(i, j + 1)) step({front(i), back(j + 1), back(j)}, i, j + 1);
  }

  void step(const PatchTriangle& triangle, std::size_t i, std::size_t j) {
    current_.push_back(triangle);
    advance(i, j);
    current_.pop_back();
  }

  Loop forward_;
  Loop backward_;
  std::size_t start_ = 0;
  Triangles current_;
  std::vector<Triangles> found_;
};

std::vector<Candidate> ordered_by_area(std::span<const Vec3> points, std::vector<Triangles> triangulations) {
  std::vector<Candidate> candidates;
  candidates.reserve(triangulations.size());
  for (Triangles& triangles : triangulations) {
    const double size = area(points, triangles);
    candidates.push_back({std::move(triangles), size});
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.area < b.area; });
  return candidates;
}

/// The first candidate that is embedded.
const Candidate* find_embedded(std::span<const Vec3> points, const std::vector<Candidate>& candidates) {
  const auto it = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) { return is_embedded(points, c.triangles); });
  return it == candidates.end() ? nullptr : &*it;
}

Triangles united(const Triangles& a, const Triangles& b) {
  Triangles sum = a;
  sum.insert(sum.end(), b.begin(), b.end());
  return sum;
}

/// Every pair of a candidate of `first` and one of `second`.
std::vector<Triangles> products(const std::vector<Candidate>& first, const std::vector<Candidate>& second) {
  std::vector<Triangles> pairs;
  pairs.reserve(first.size() * second.size());
  for (const Candidate& a : first) {
    for (const Candidate& b : second) pairs.push_back(united(a.triangles, b.triangles));
  }
  return pairs;
}

/// An annulus as two bands that meet in its waist, a ring of points inside the cell.
class AnnulusWithWaist {
 public:
  AnnulusWithWaist(std::span<const Vec3> points, Loop first, Loop second, Loop waist) : points_(points), first_(first), second_(second) {
    forwards_.assign(waist.begin(), waist.end());
    backwards_.assign(waist.rbegin(), waist.rend());
  }

  [[nodiscard]] std::optional<Candidate> find() const {
    std::optional<Candidate> one_way = along(forwards_, backwards_);
    std::optional<Candidate> other_way = along(backwards_, forwards_);
    if (one_way && other_way) return one_way->area <= other_way->area ? one_way : other_way;
    return one_way ? one_way : other_way;
  }

 private:
  [[nodiscard]] std::optional<Candidate> along(Loop waist, Loop reversed) const {
    const std::vector<Candidate> bands = embedded_bands(first_, waist);
    if (bands.empty()) return std::nullopt;
    const std::vector<Candidate> pairs = ordered_by_area(points_, products(bands, embedded_bands(second_, reversed)));
    const Candidate* best = find_embedded(points_, pairs);
    return best ? std::optional(*best) : std::nullopt;
  }

  [[nodiscard]] std::vector<Candidate> embedded_bands(Loop a, Loop b) const {
    std::vector<Candidate> found;
    for (Candidate& candidate : ordered_by_area(points_, BandTriangulations(a, b).all())) {
      if (is_embedded(points_, candidate.triangles)) found.push_back(std::move(candidate));
      if (found.size() == kBandsTried) break;
    }
    return found;
  }

  /// Of each band, the smallest that are tried with those of the other: the first pair nearly always fits.
  static constexpr std::size_t kBandsTried = 20;

  std::span<const Vec3> points_;
  Loop first_;
  Loop second_;
  std::vector<std::uint8_t> forwards_;
  std::vector<std::uint8_t> backwards_;
};

// ---- cells with an ambiguous face or a tunnel ----

/// Fills what is left of a cell when its corner triangles are done.
class HardCell {
 public:
  explicit HardCell(CellPatch& patch) : patch_(patch) {}

  void add_disc(Loop loop) {
    discs_.push_back(loop);
    parts_.push_back(ordered_by_area(patch_.points, PolygonTriangulations(loop).all()));
  }

  void add_annulus(const CellLoops& loops, const Tunnel& tunnel) {
    const Loop a = loops.loop(tunnel.first_loop);
    const Loop b = loops.loop(tunnel.second_loop);
    parts_.push_back(ordered_by_area(patch_.points, BandTriangulations(a, b).all()));
    if (!find_embedded(patch_.points, parts_.back())) add_waist(a, b, tunnel);
  }

  void fill() {
    if (parts_.empty() || choose_embedded()) return;
    if (parts_.size() != 1 || discs_.size() != 1) throw std::logic_error("a cell of the surface has no embedded triangulation");
    append_cone(discs_.front());
  }

 private:
  /// One candidate for each part, by total area; the first combination without contact, also with the corner triangles, is taken.
  bool choose_embedded() {
    std::vector<Candidate> combinations = parts_.front();
    for (std::size_t i = 1; i < parts_.size(); ++i) combinations = ordered_by_area(patch_.points, products(combinations, parts_[i]));
    for (const Candidate& candidate : combinations) {
      Triangles whole = united(patch_.triangles, candidate.triangles);
      if (!is_embedded(patch_.points, whole)) continue;
      patch_.triangles = std::move(whole);
      return true;
    }
    return false;
  }

  void add_waist(Loop a, Loop b, const Tunnel& tunnel) {
    std::array<std::uint8_t, 6> waist;
    for (std::size_t i = 0; i < waist.size(); ++i) {
      waist[i] = static_cast<std::uint8_t>(patch_.points.size());
      patch_.points.push_back(tunnel.waist[i]);
    }
    const std::optional<Candidate> annulus = AnnulusWithWaist(patch_.points, a, b, waist).find();
    parts_.back().clear();
    if (annulus) parts_.back().push_back(*annulus);
  }

  void append_cone(Loop loop) {
    Vec3 sum = Vec3::Zero();
    for (const std::uint8_t corner : loop) sum += patch_.points[corner];
    const auto apex = static_cast<std::uint8_t>(patch_.points.size());
    patch_.points.emplace_back(sum / static_cast<double>(loop.size()));
    for (std::size_t i = 0; i < loop.size(); ++i) patch_.triangles.push_back({apex, loop[i], loop[(i + 1) % loop.size()]});
  }

  CellPatch& patch_;
  std::vector<Loop> discs_;
  std::vector<std::vector<Candidate>> parts_;
};

}  // namespace

void triangulate_cell(const std::array<Vec3, cube::kEdges>& points, const CellLoops& loops, const std::optional<Tunnel>& tunnel,
                      CellPatch& patch) {
  patch.points.assign(points.begin(), points.end());
  patch.triangles.clear();
  HardCell hard(patch);
  for (int i = 0; i < loops.count; ++i) {
    if (tunnel && (i == tunnel->first_loop || i == tunnel->second_loop)) continue;
    const Loop loop = loops.loop(i);
    if (loops.ambiguous_faces == 0 || loop.size() == 3) {
      append_best_fan(loop, patch);
    } else {
      hard.add_disc(loop);
    }
  }
  if (tunnel) hard.add_annulus(loops, *tunnel);
  hard.fill();
}

}  // namespace smopt
