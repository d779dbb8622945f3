#include "tests/experiments/page/made_run.h"

#include <fstream>
#include <limits>

#include "experiments/run_layout.h"
#include "metrics/measure.h"
#include "metrics/measurement_json.h"
#include "smopt/io/mesh_io.h"
#include "tests/experiments/made_records.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

using experiments::Dataset;
using experiments::Json;

/// A case's record and mesh, its metrics as the judge finds them.
void save_case(const std::filesystem::path& run, const Dataset& dataset, const std::string& method, const TriangleMesh& initial,
               const TriangleMesh& mesh) {
  Json record = made_record(dataset, method);
  record["metrics"] = {{"before", metrics::to_json(metrics::measure(initial))}, {"after", metrics::to_json(metrics::measure(mesh))}};
  record["level_set_distance"] = {{"before", {{"mean", 0.05}}}, {"after", {{"mean", 0.06}}}};
  set_cpu_seconds(record, {{0.01, 0.02, 0.03, 0.4}});
  save_record(run, record);
  save_mesh(run, dataset.name, method, mesh);
}

void make_ball(const std::filesystem::path& run) {
  const Dataset dataset = made_dataset("ball", experiments::Role::stand_in);
  const TriangleMesh initial = noisy(icosphere(3, 10), 0.4, 1);
  save_case(run, dataset, "initial", initial, initial);
  save_case(run, dataset, "smopt", initial, icosphere(3, 10));
  save_case(run, dataset, "laplacian", initial, joined(icosphere(3, 10), icosphere(2, 6, Vec3(8, 0.1, 0.2))));
}

void make_ring(const std::filesystem::path& run) {
  const Dataset dataset = made_dataset("ring");
  const TriangleMesh initial = noisy(torus(10, 4, 48, 24), 0.1, 2);
  save_case(run, dataset, "initial", initial, initial);
  save_case(run, dataset, "smopt", initial, torus(10, 4, 48, 24));
  save_record(run, failed_record(dataset, "laplacian", kMarkupReason));
  TriangleMesh wild = initial;
  wild.points[7] = Vec3(1e20, 0, 0);
  Json record = made_record(dataset, "meshlab");
  record["diverged_at_step"] = 12;
  save_record(run, record);
  save_mesh(run, "ring", "meshlab", wild);
}

}  // namespace

void save_record(const std::filesystem::path& run, const Json& record) {
  const auto path =
      experiments::record_path(run, record.at("molecule").at("name").get<std::string>(), record.at("method").get<std::string>());
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << record.dump();
}

void save_mesh(const std::filesystem::path& run, const std::string& molecule, const std::string& method, const TriangleMesh& mesh) {
  const std::filesystem::path folder = run / "meshes" / molecule;
  std::filesystem::create_directories(folder);
  write_mesh(folder / (method + ".off"), mesh);
}

void make_run(const std::filesystem::path& run) {
  make_ball(run);
  make_ring(run);
}

}  // namespace smopt::testing
