#pragma once

#include <boost/property_map/property_map.hpp>
#include <string_view>
#include <utility>

#include "smopt/progress.h"

namespace smopt::baselines {

/// Looks into a call of CGAL's through the property maps it was given: counts what CGAL reads or writes there, reports progress, and lets
/// the user's interrupt out as Cancelled (thrown through CGAL; its mesh is then given up).
class CallWatch {
 public:
  /// `expected`: the counts of the whole call, 0 where nobody knows.
  CallWatch(const ProgressCallback& progress, std::string_view stage, std::size_t expected)
      : progress_(progress), stage_(stage), expected_(expected) {
    report_progress(progress_, stage_, 0);
  }

  void count() {
    if (++count_ % kCountsPerReport == 0) report_progress(progress_, stage_, fraction());
  }

  [[nodiscard]] std::size_t counted() const { return count_; }

 private:
  /// A callback costs as much as some hundred visits of CGAL's; this many take a few milliseconds.
  static constexpr std::size_t kCountsPerReport = 4096;

  [[nodiscard]] double fraction() const {
    if (expected_ == 0 || count_ >= expected_) return expected_ == 0 ? 0.0 : 1.0;
    return static_cast<double>(count_) / static_cast<double>(expected_);
  }

  const ProgressCallback& progress_;
  std::string_view stage_;
  std::size_t expected_;
  std::size_t count_ = 0;
};

/// The positions of a CGAL surface as a property map that counts the writes.
template <class Surface>
struct WatchedPoints {
  using key_type = typename Surface::Vertex_index;
  using value_type = typename Surface::Point;
  using reference = const value_type&;
  using category = boost::read_write_property_map_tag;

  Surface* surface = nullptr;
  CallWatch* watch = nullptr;

  friend reference get(const WatchedPoints& map, key_type v) { return std::as_const(*map.surface).point(v); }
  friend void put(const WatchedPoints& map, key_type v, const value_type& point) {
    map.watch->count();
    map.surface->point(v) = point;
  }
};

/// No vertex is constrained; counts how often CGAL asks.
template <class Surface>
struct WatchedVisits {
  using key_type = typename Surface::Vertex_index;
  using value_type = bool;
  using reference = bool;
  using category = boost::read_write_property_map_tag;

  CallWatch* watch = nullptr;

  friend bool get(const WatchedVisits& map, key_type /*v*/) {
    map.watch->count();
    return false;
  }
  friend void put(const WatchedVisits& /*map*/, key_type /*v*/, bool /*is_constrained*/) {}
};

}  // namespace smopt::baselines
