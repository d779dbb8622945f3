#include "tests/experiments/made_records.h"

#include <numeric>

#include "experiments/run_report.h"

namespace smopt::testing {
namespace {

using experiments::Json;

Json made_histogram(double high, std::size_t bins) {
  std::vector<double> edges(bins + 1);
  for (std::size_t i = 0; i <= bins; ++i) edges[i] = high * static_cast<double>(i) / static_cast<double>(bins);
  std::vector<int> counts(bins);
  std::iota(counts.begin(), counts.end(), 1);
  return {{"edges", edges}, {"counts", counts}};
}

Json made_metrics(int vertices, int triangles, double area, double volume) {
  return {{"vertices", vertices},
          {"triangles", triangles},
          {"intersecting_pairs", 7},
          {"area", area},
          {"volume", volume},
          {"edge_ratio", {{"histogram", made_histogram(1, 50)}}},
          {"angle_deg", {{"histogram", made_histogram(180, 90)}}}};
}

}  // namespace

experiments::Dataset made_dataset(const std::string& name, experiments::Role role) {
  experiments::Dataset dataset;
  dataset.name = name;
  dataset.title = "The " + name;
  dataset.role = role;
  dataset.about = "made for a test";
  return dataset;
}

experiments::Dataset ache_monomer() {
  experiments::Dataset dataset = made_dataset("ache-monomer", experiments::Role::real);
  dataset.title = "AChE monomer";
  dataset.paper_row = "AChE monomer";
  return dataset;
}

Json made_record(const experiments::Dataset& dataset, const std::string& method) {
  Json record = experiments::record_header(dataset, method);
  record["molecule"]["atoms"] = 1000;
  record["options"] = {{"rounds", 100}};
  record["metrics"] = {{"before", made_metrics(500, 1000, 300.5, 900.25)}, {"after", made_metrics(400, 800, 290, 880)}};
  record["tetgen"] = {{"p", {{"status", "failed"}, {"reason", "too sharp"}}}, {"pY", {{"status", "success"}, {"reason", nullptr}}}};
  record["solvation"] = {{"status", "not computed"}, {"reason", "not asked for"}};
  set_cpu_seconds(record, {{}});
  experiments::mark_done(record);
  return record;
}

Json failed_record(const experiments::Dataset& dataset, const std::string& method, const std::string& reason) {
  Json record = experiments::record_header(dataset, method);
  experiments::mark_failed(record, reason);
  return record;
}

void set_solvation(Json& record, double total, int iterations, int degenerate_vertices) {
  record["solvation"] = {{"status", "success"},
                         {"reason", nullptr},
                         {"polar_kcal_per_mol", total - 300},
                         {"nonpolar_kcal_per_mol", 300},
                         {"total_kcal_per_mol", total},
                         {"iterations", iterations},
                         {"degenerate_vertices", degenerate_vertices}};
}

void set_cpu_seconds(Json& record, const std::vector<CpuSeconds>& repeats) {
  std::vector<StageTimes> times;
  for (const CpuSeconds& s : repeats) {
    times.push_back(
        {{"validity", {0, s.validity}}, {"cavities", {0, s.cavities}}, {"redundant", {0, s.redundant}}, {"smoothing", {0, s.smoothing}}});
  }
  experiments::add_repeats(record, times);
  experiments::add_medians(record);
}

}  // namespace smopt::testing
