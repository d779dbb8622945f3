#include "smopt/surface/block_mesh.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "smopt/error.h"

namespace smopt {
namespace {

/// Vertex numbers are 32-bit.
constexpr std::size_t kMostVertices = std::numeric_limits<VertexId>::max();

/// A vertex by its block and its number there.
struct Place {
  std::uint32_t block;
  VertexId vertex;
};

/// A shared vertex that an earlier block has too.
struct Repeated {
  VertexId vertex;
  Place original;
};

/// Where a block begins in the joined mesh.
struct Start {
  std::size_t vertex = 0;
  std::size_t triangle = 0;
};

class BlockJoiner {
 public:
  explicit BlockJoiner(std::vector<BlockMesh>& blocks) : blocks_(blocks), repeated_(blocks.size()), starts_(blocks.size() + 1) {}

  TriangleMesh run() {
    find_repeated();
    lay_out();
    mesh_.points.resize(starts_.back().vertex);
    mesh_.triangles.resize(starts_.back().triangle);
    tbb::parallel_for(std::size_t{0}, blocks_.size(), [&](std::size_t block) { use_up(block); });
    return std::move(mesh_);
  }

 private:
  struct SharedPlace {
    GridEdge edge;
    Place place;

    bool operator<(const SharedPlace& other) const {
      return std::tie(edge, place.block, place.vertex) < std::tie(other.edge, other.place.block, other.place.vertex);
    }
  };

  [[nodiscard]] std::vector<SharedPlace> shared_by_edge() const {
    std::vector<SharedPlace> all;
    std::size_t count = 0;
    for (const BlockMesh& block : blocks_) count += block.shared.size();
    all.reserve(count);
    for (std::size_t i = 0; i < blocks_.size(); ++i)
      for (const auto& [edge, vertex] : blocks_[i].shared) all.push_back({edge, {static_cast<std::uint32_t>(i), vertex}});
    tbb::parallel_sort(all.begin(), all.end());
    return all;
  }

  void find_repeated() {
    const std::vector<SharedPlace> all = shared_by_edge();
    for (std::size_t first = 0, i = 1; i < all.size(); ++i) {
      if (all[i].edge != all[first].edge) {
        first = i;
      } else {
        repeated_[all[i].place.block].push_back({all[i].place.vertex, all[first].place});
      }
    }
    tbb::parallel_for(std::size_t{0}, repeated_.size(),
                      [&](std::size_t block) { std::ranges::sort(repeated_[block], {}, &Repeated::vertex); });
  }

  void lay_out() {
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      starts_[i + 1].vertex = starts_[i].vertex + blocks_[i].points.size() - repeated_[i].size();
      starts_[i + 1].triangle = starts_[i].triangle + blocks_[i].triangles.size();
    }
    if (starts_.back().vertex > kMostVertices)
      throw InvalidInput(fmt::format("the surface has {} vertices, more than 32-bit indices can number", starts_.back().vertex));
  }

  /// The number in the joined mesh of a vertex that is not repeated.
  [[nodiscard]] VertexId number_of(const Place& place) const {
    const std::vector<Repeated>& left_out = repeated_[place.block];
    const auto before = std::ranges::lower_bound(left_out, place.vertex, {}, &Repeated::vertex) - left_out.begin();
    return static_cast<VertexId>(starts_[place.block].vertex + place.vertex - static_cast<std::size_t>(before));
  }

  void use_up(std::size_t index) {
    const BlockMesh block = std::move(blocks_[index]);
    const std::vector<VertexId> numbers = copy_points(block, index);
    Triangle* to = mesh_.triangles.data() + starts_[index].triangle;
    for (const auto& [a, b, c] : block.triangles) *to++ = {numbers[a], numbers[b], numbers[c]};
  }

  /// Returns the number in the joined mesh of each vertex of the block.
  std::vector<VertexId> copy_points(const BlockMesh& block, std::size_t index) {
    std::vector<VertexId> numbers(block.points.size());
    std::size_t next = starts_[index].vertex;
    auto repeated = repeated_[index].begin();
    for (VertexId v = 0; v < block.points.size(); ++v) {
      if (repeated != repeated_[index].end() && repeated->vertex == v) {
        numbers[v] = number_of((repeated++)->original);
      } else {
        numbers[v] = static_cast<VertexId>(next);
        mesh_.points[next++] = block.points[v];
      }
    }
    return numbers;
  }

  std::vector<BlockMesh>& blocks_;
  std::vector<std::vector<Repeated>> repeated_;  // per block, ascending
  std::vector<Start> starts_;                    // per block, and the end
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh joined(std::vector<BlockMesh> blocks) {
  return BlockJoiner(blocks).run();
}

}  // namespace smopt
