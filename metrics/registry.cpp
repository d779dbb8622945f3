#include "metrics/registry.h"

#include <algorithm>
#include <array>

namespace smopt::metrics {
namespace {

using Number = std::optional<double>;
using M = Measurement;

constexpr std::nullopt_t kNoIdeal = std::nullopt;

template <class T>
Number number(const T& value) {
  return static_cast<double>(value);
}

template <class T>
Number number(const std::optional<T>& value) {
  return value ? Number(static_cast<double>(*value)) : Number();
}

template <class Getter>
Number if_measured(const M& m, Getter get) {
  return m.distance ? Number(get(*m.distance)) : Number();
}

const std::array kMetrics = {
    Metric{"vertices", "vertices", "count", kNoIdeal, Better::kNeutral, [](const M& m) { return number(m.topology.vertices); }},
    Metric{"triangles", "triangles", "count", kNoIdeal, Better::kNeutral, [](const M& m) { return number(m.topology.triangles); }},
    Metric{"edges", "edges", "count", kNoIdeal, Better::kNeutral, [](const M& m) { return number(m.topology.edges); }},
    Metric{"components", "components", "count", kNoIdeal, Better::kNeutral, [](const M& m) { return number(m.topology.components); }},
    Metric{"euler_characteristic", "Euler characteristic", "1", kNoIdeal, Better::kNeutral,
           [](const M& m) { return number(m.topology.euler_characteristic); }},
    Metric{"genus", "genus", "count", kNoIdeal, Better::kNeutral, [](const M& m) { return number(m.topology.genus); }},
    Metric{"closed", "closed", "yes/no", 1, Better::kHigher, [](const M& m) { return number(m.topology.closed); }},
    Metric{"edge_manifold", "edge-manifold", "yes/no", 1, Better::kHigher, [](const M& m) { return number(m.topology.edge_manifold); }},
    Metric{"vertex_manifold", "vertex-manifold", "yes/no", 1, Better::kHigher,
           [](const M& m) { return number(m.topology.vertex_manifold); }},
    Metric{"oriented", "consistently oriented", "yes/no", 1, Better::kHigher, [](const M& m) { return number(m.topology.oriented); }},
    Metric{"isolated_vertices", "isolated vertices", "count", 0, Better::kLower,
           [](const M& m) { return number(m.topology.isolated_vertices); }},
    Metric{"duplicate_vertices", "duplicate vertices", "count", 0, Better::kLower,
           [](const M& m) { return number(m.topology.duplicate_vertices); }},
    Metric{"degenerate_triangles", "degenerate triangles", "count", 0, Better::kLower,
           [](const M& m) { return number(m.topology.degenerate_triangles); }},
    Metric{"nonfinite_vertices", "vertices not finite", "count", 0, Better::kLower,
           [](const M& m) { return number(m.topology.nonfinite_vertices); }},
    Metric{"intersecting_pairs", "intersecting pairs", "count", 0, Better::kLower, [](const M& m) { return number(m.intersecting_pairs); }},
    Metric{"area", "area", "Å²", kNoIdeal, Better::kNeutral, [](const M& m) { return number(m.extent.area); }},
    Metric{"volume", "volume", "Å³", kNoIdeal, Better::kNeutral, [](const M& m) { return number(m.extent.volume); }},
    Metric{"edge_ratio.min", "edge ratio, smallest", "1", 1, Better::kHigher, [](const M& m) { return number(m.shape.edge_ratio.min); }},
    Metric{"edge_ratio.mean", "edge ratio, mean", "1", 1, Better::kHigher, [](const M& m) { return number(m.shape.edge_ratio.mean); }},
    Metric{"edge_ratio.median", "edge ratio, median", "1", 1, Better::kHigher,
           [](const M& m) { return number(m.shape.edge_ratio.median); }},
    Metric{"edge_ratio.below_0.1", "edge ratio below 0.1", "share", 0, Better::kLower,
           [](const M& m) { return number(m.shape.edge_ratio.share_below_01); }},
    Metric{"angle_deg.min", "smallest angle", "°", 60, Better::kHigher, [](const M& m) { return number(m.shape.angle.min); }},
    Metric{"angle_deg.max", "largest angle", "°", 60, Better::kLower, [](const M& m) { return number(m.shape.angle.max); }},
    Metric{"angle_deg.mean_min", "mean smallest angle", "°", 60, Better::kHigher,
           [](const M& m) { return number(m.shape.angle.mean_min); }},
    Metric{"min_angle_share.below_5", "smallest angle below 5°", "share", 0, Better::kLower,
           [](const M& m) { return number(m.shape.angle.smallest_below_5); }},
    Metric{"min_angle_share.below_10", "smallest angle below 10°", "share", 0, Better::kLower,
           [](const M& m) { return number(m.shape.angle.smallest_below_10); }},
    Metric{"min_angle_share.below_20", "smallest angle below 20°", "share", 0, Better::kLower,
           [](const M& m) { return number(m.shape.angle.smallest_below_20); }},
    Metric{"min_angle_share.below_30", "smallest angle below 30°", "share", 0, Better::kLower,
           [](const M& m) { return number(m.shape.angle.smallest_below_30); }},
    Metric{"max_angle_share.above_120", "largest angle above 120°", "share", 0, Better::kLower,
           [](const M& m) { return number(m.shape.angle.largest_above_120); }},
    Metric{"max_angle_share.above_150", "largest angle above 150°", "share", 0, Better::kLower,
           [](const M& m) { return number(m.shape.angle.largest_above_150); }},
    Metric{"valence.min", "valence, smallest", "count", kNoIdeal, Better::kNeutral, [](const M& m) { return number(m.valence.min); }},
    Metric{"valence.max", "valence, largest", "count", kNoIdeal, Better::kNeutral, [](const M& m) { return number(m.valence.max); }},
    Metric{"valence.share_6", "valence 6", "share", 1, Better::kHigher, [](const M& m) { return number(m.valence.share_6); }},
    Metric{"valence.share_5_6_7", "valence 5, 6 or 7", "share", 1, Better::kHigher,
           [](const M& m) { return number(m.valence.share_5_6_7); }},
    Metric{"distance.to_reference.max", "to the reference, largest", "Å", 0, Better::kLower,
           [](const M& m) { return if_measured(m, [](const SurfaceDistance& d) { return d.to_reference.max; }); }},
    Metric{"distance.to_reference.mean", "to the reference, mean", "Å", 0, Better::kLower,
           [](const M& m) { return if_measured(m, [](const SurfaceDistance& d) { return d.to_reference.mean; }); }},
    Metric{"distance.to_reference.rms", "to the reference, rms", "Å", 0, Better::kLower,
           [](const M& m) { return if_measured(m, [](const SurfaceDistance& d) { return d.to_reference.rms; }); }},
    Metric{"distance.from_reference.max", "from the reference, largest", "Å", 0, Better::kLower,
           [](const M& m) { return if_measured(m, [](const SurfaceDistance& d) { return d.from_reference.max; }); }},
    Metric{"distance.from_reference.mean", "from the reference, mean", "Å", 0, Better::kLower,
           [](const M& m) { return if_measured(m, [](const SurfaceDistance& d) { return d.from_reference.mean; }); }},
    Metric{"distance.from_reference.rms", "from the reference, rms", "Å", 0, Better::kLower,
           [](const M& m) { return if_measured(m, [](const SurfaceDistance& d) { return d.from_reference.rms; }); }},
    Metric{"distance.hausdorff", "Hausdorff distance", "Å", 0, Better::kLower,
           [](const M& m) { return if_measured(m, [](const SurfaceDistance& d) { return d.hausdorff; }); }},
};

}  // namespace

std::span<const Metric> metric_registry() {
  return kMetrics;
}

const Metric* find_metric(std::string_view name) {
  const auto found = std::find_if(kMetrics.begin(), kMetrics.end(), [name](const Metric& m) { return m.name == name; });
  return found == kMetrics.end() ? nullptr : &*found;
}

}  // namespace smopt::metrics
