#include "smopt/surface/field_blocks.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <mutex>

#include "smopt/surface/trilinear_block.h"

namespace smopt {
namespace {

/// Cells on each edge of a block. Larger ones share fewer vertices and meet fewer atoms twice; smaller ones stay in the processor's cache and
/// keep all threads busy on small molecules. The AChE monomer takes 33, 28, 26, 24 and 24 ms on one thread with 16, 24, 32, 48 and 64.
constexpr std::int32_t kBlockCells = 32;

}  // namespace

FieldBlocks::FieldBlocks(const GaussianField& field, double spacing, double value)
    : field_(field), spacing_(spacing), origin_(field.low() - Vec3::Constant(spacing)) {
  require_resolution(spacing, std::max(field.low().cwiseAbs().maxCoeff(), field.high().cwiseAbs().maxCoeff()) + kBlockCells * spacing);
  blocks_ = field.reached_cubes(origin_, kBlockCells * spacing);
  keep_those_that_may_reach(value);
}

void FieldBlocks::keep_those_that_may_reach(double value) {
  std::vector<char> kept(blocks_.size());
  tbb::parallel_for(std::size_t{0}, blocks_.size(), [&](std::size_t i) { kept[i] = may_reach(value, blocks_[i]) ? 1 : 0; });
  std::size_t count = 0;
  for (std::size_t i = 0; i < blocks_.size(); ++i)
    if (kept[i] != 0) blocks_[count++] = blocks_[i];
  blocks_.resize(count);
}

std::size_t FieldBlocks::node_count() const {
  constexpr std::size_t kNodes = kBlockCells + 1;
  return count() * kNodes * kNodes * kNodes;
}

void FieldBlocks::visit_all(const std::function<void(std::size_t i, const ScalarGrid& block)>& visit, std::string_view stage,
                            const ProgressCallback& progress) const {
  report_progress(progress, stage, 0);
  tbb::enumerable_thread_specific<ScalarGrid> grids;
  std::mutex reporting;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, count(), [&](std::size_t i) {
    ScalarGrid& block = grids.local();
    lay_out(blocks_[i], block);
    field_.sample(block);
    visit(i, block);
    const std::lock_guard lock(reporting);
    report_progress(progress, stage, static_cast<double>(++done) / static_cast<double>(count()));
  });
}

void FieldBlocks::lay_out(const Place& place, ScalarGrid& block) const {
  block.size.fill(kBlockCells + 1);
  block.origin = origin_;
  block.spacing = spacing_;
  for (int axis = 0; axis < 3; ++axis) block.first[axis] = kBlockCells * place[axis];
}

bool FieldBlocks::may_reach(double value, const Place& place) const {
  ScalarGrid block;
  lay_out(place, block);
  Vec3 low;
  Vec3 high;
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = block.coordinate(axis, 0);
    high[axis] = block.coordinate(axis, kBlockCells);
  }
  return field_.may_reach(value, low, high);
}

}  // namespace smopt
