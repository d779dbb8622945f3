#include "smopt/geometry/triangle_batch.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace smopt {
namespace {

/// Steps from end to end of the space; they are kept as 16-bit numbers around 0.
constexpr float kSteps = 64000.0F;
/// How many triangles ahead their points are asked for from memory.
constexpr std::size_t kLookahead = 8;
/// An empty box: its lower end is above every query.
constexpr std::int16_t kBeyondLow = 32767, kBeyondHigh = -32768;

float largest_of(const Eigen::Vector3f& p) {
  return p.cwiseAbs().maxCoeff();
}

using Numbers = std::uint32_t __attribute__((vector_size(16)));

/// For each set of eight bits, the places of those set, in order, and how many there are.
struct BitPlaces {
  std::array<std::array<Numbers, 2>, 256> places{};
  std::array<std::uint8_t, 256> count{};
};

constexpr BitPlaces all_bit_places() {
  BitPlaces table;
  for (std::size_t bits = 0; bits < 256; ++bits) {
    std::uint32_t places[8] = {};
    for (std::uint32_t i = 0; i < 8; ++i)
      if ((bits >> i & 1) != 0) places[table.count[bits]++] = i;
    table.places[bits] = {Numbers{places[0], places[1], places[2], places[3]}, Numbers{places[4], places[5], places[6], places[7]}};
  }
  return table;
}

constexpr BitPlaces kBitPlaces = all_bit_places();

}  // namespace

void TriangleBatch::gather(const TriangleGrid& grid, const std::vector<Vec3>& points,
                           const std::vector<std::array<std::uint32_t, 3>>& triangles, const Box& space, const Vec3& center) {
  set_space(space);
  center_ = center;
  radius_ = 0;
  entries_.clear();
  boxes_.clear();
  faces_.clear();
  grid.for_overlapping(space, [&](std::uint32_t f) {
    faces_.push_back(f);
    __builtin_prefetch(&triangles[f]);
  });
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    if (i + kLookahead < faces_.size())
      for (const std::uint32_t corner : triangles[faces_[i + kLookahead]]) __builtin_prefetch(&points[corner]);
    add(faces_[i], grid.box(faces_[i]), points, triangles[faces_[i]]);
  }
}

void TriangleBatch::add(std::uint32_t f, const Box& box, const std::vector<Vec3>& points, const std::array<std::uint32_t, 3>& t) {
  const Entry entry = Entry::of(f, t, points, center_);
  radius_ = std::max(radius_, entry.radius());
  if (entries_.size() % kBoxesPerGroup == 0) {
    constexpr Steps kLow = Steps{} + kBeyondLow, kHigh = Steps{} + kBeyondHigh;
    boxes_.push_back({{kLow, kLow, kLow}, {kHigh, kHigh, kHigh}});
  }
  put_box(entries_.size(), box);
  entries_.push_back(entry);
}

void TriangleBatch::set_space(const Box& space) {
  space_ = space;
  for (int axis = 0; axis < 3; ++axis)
    steps_per_unit_[axis] = kSteps / std::max(space.high[axis] - space.low[axis], std::numeric_limits<float>::min() * kSteps);
}

void TriangleBatch::put_box(std::size_t i, const Box& box) {
  BoxGroup& group = boxes_[i / kBoxesPerGroup];
  const Masks low = steps_of(box.low), high = steps_of(box.high);
  for (int axis = 0; axis < 3; ++axis) {
    group.low[axis][i % kBoxesPerGroup] = static_cast<std::int16_t>(low[axis]);
    group.high[axis][i % kBoxesPerGroup] = static_cast<std::int16_t>(high[axis]);
  }
}

std::span<const std::uint32_t> TriangleBatch::near(const Box& box) {
  near_.resize(boxes_.size() * kBoxesPerGroup);
  const Masks first_step = steps_of(box.low), last_step = steps_of(box.high);
  Steps low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = Steps{} + static_cast<std::int16_t>(first_step[axis]);
    high[axis] = Steps{} + static_cast<std::int16_t>(last_step[axis]);
  }
  // Without a branch: eight numbers are written for each group, and those that count are kept.
  std::uint32_t* end = near_.data();
  Numbers first{};
  for (const BoxGroup& group : boxes_) {
    const Steps beyond = (group.low[0] > high[0]) | (group.low[1] > high[1]) | (group.low[2] > high[2]) | (low[0] > group.high[0]) |
                         (low[1] > group.high[1]) | (low[2] > group.high[2]);
    const unsigned hits = ~lanes_set(beyond) & 0xFF;
    const std::array<Numbers, 2> numbers = {first + kBitPlaces.places[hits][0], first + kBitPlaces.places[hits][1]};
    std::memcpy(end, numbers.data(), sizeof numbers);
    end += kBitPlaces.count[hits];
    first += kBoxesPerGroup;
  }
  return {near_.data(), end};
}

void TriangleBatch::move_corner(std::size_t i, std::uint32_t corner, const Vec3& point, const Box& box) {
  const Eigen::Vector3f p = (point - center_).cast<float>();
  radius_ = std::max(radius_, largest_of(p));
  Entry& entry = entries_[i];
  const auto put = [&](std::size_t lane) {
    entry.x[lane] = p[0];
    entry.y[lane] = p[1];
    entry.z[lane] = p[2];
  };
  for (std::size_t lane = 0; lane < 3; ++lane)
    if (entry.corners[lane] == corner) put(lane);
  if (entry.corners[2] == corner) put(3);
  put_box(i, box);
}

}  // namespace smopt
