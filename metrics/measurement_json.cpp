#include "metrics/measurement_json.h"

namespace smopt::metrics {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

Json json_of(const Histogram& h) {
  return {{"edges", h.edges}, {"counts", h.counts}};
}

Json json_of(const EdgeRatios& r) {
  return {{"min", or_null(r.min)},
          {"mean", or_null(r.mean)},
          {"median", or_null(r.median)},
          {"below_0.1", or_null(r.share_below_01)},
          {"histogram", json_of(r.histogram)}};
}

Json json_of(const Angles& a) {
  return {{"min", or_null(a.min)}, {"max", or_null(a.max)}, {"mean_min", or_null(a.mean_min)}, {"histogram", json_of(a.histogram)}};
}

Json smallest_angle_shares(const Angles& a) {
  return {{"below_5", or_null(a.smallest_below_5)},
          {"below_10", or_null(a.smallest_below_10)},
          {"below_20", or_null(a.smallest_below_20)},
          {"below_30", or_null(a.smallest_below_30)}};
}

Json largest_angle_shares(const Angles& a) {
  return {{"above_120", or_null(a.largest_above_120)}, {"above_150", or_null(a.largest_above_150)}};
}

Json json_of(const Valence& v) {
  return {{"min", or_null(v.min)}, {"max", or_null(v.max)}, {"share_6", or_null(v.share_6)}, {"share_5_6_7", or_null(v.share_5_6_7)}};
}

Json json_of(const OneSidedDistance& d) {
  return {{"max", d.max}, {"mean", d.mean}, {"rms", d.rms}};
}

Json json_of(const SurfaceDistance& d) {
  return {{"to_reference", json_of(d.to_reference)},
          {"from_reference", json_of(d.from_reference)},
          {"hausdorff", d.hausdorff},
          {"samples", d.samples}};
}

Json json_of(const Topology& t) {
  return {{"vertices", t.vertices},
          {"triangles", t.triangles},
          {"edges", t.edges},
          {"components", t.components},
          {"euler_characteristic", t.euler_characteristic},
          {"genus", or_null(t.genus)},
          {"closed", t.closed},
          {"edge_manifold", t.edge_manifold},
          {"vertex_manifold", t.vertex_manifold},
          {"oriented", t.oriented},
          {"isolated_vertices", t.isolated_vertices},
          {"duplicate_vertices", t.duplicate_vertices},
          {"degenerate_triangles", t.degenerate_triangles},
          {"nonfinite_vertices", t.nonfinite_vertices}};
}

}  // namespace

Json to_json(const Measurement& m) {
  Json json = json_of(m.topology);
  json["intersecting_pairs"] = or_null(m.intersecting_pairs);
  json["area"] = or_null(m.extent.area);
  json["volume"] = or_null(m.extent.volume);
  json["edge_ratio"] = json_of(m.shape.edge_ratio);
  json["angle_deg"] = json_of(m.shape.angle);
  json["min_angle_share"] = smallest_angle_shares(m.shape.angle);
  json["max_angle_share"] = largest_angle_shares(m.shape.angle);
  json["valence"] = json_of(m.valence);
  if (m.distance) json["distance"] = json_of(*m.distance);
  json["notes"] = m.notes;
  return json;
}

}  // namespace smopt::metrics
