#include "experiments/solvation_study/born_study.h"

#include <fmt/format.h>

#include <cmath>

#include "experiments/solvation_study/icosphere.h"

namespace smopt::experiments {
namespace {

double mean_edge(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) sum += (mesh.points[t[i]] - mesh.points[t[(i + 1) % 3]]).norm();
  return sum / (3 * static_cast<double>(mesh.triangle_count()));
}

BornRow solve_on(const TriangleMesh& sphere, const BornIon& ion) {
  constexpr double kAccuracy = 1e-3;  // finer than the default, so that the mesh's error shows
  metrics::SolvationOptions options;
  options.medium = ion.medium;
  options.accuracy = kAccuracy;
  BornRow row;
  row.edge = mean_edge(sphere);
  row.solve = solve(sphere, {{Vec3::Zero()}, {ion.charge}, {ion.radius}}, options);
  if (row.solve.is_success()) row.error = std::abs(row.solve.result->polar / ion.energy() - 1);
  return row;
}

}  // namespace

double BornIon::energy() const {
  return metrics::kCoulombConstant * charge * charge / (2 * radius) *
         (1 / (medium.outer * (1 + medium.kappa() * radius)) - 1 / medium.inner);
}

BornSeries study_born(const BornIon& ion, const std::vector<int>& divisions, const StudyLog& log) {
  BornSeries series{ion, {}};
  for (const int level : divisions) {
    BornRow row = solve_on(icosphere(level, ion.radius), ion);
    log(fmt::format("Born ion, kappa {:.6f}, {} vertices: {}", ion.medium.kappa(), row.solve.vertices, describe(row.solve)));
    if (!series.rows.empty() && row.error && series.rows.back().error.value_or(0) > kErrorOfSums)
      row.order = std::log(*series.rows.back().error / *row.error) / std::log(series.rows.back().edge / row.edge);
    series.rows.push_back(std::move(row));
  }
  return series;
}

}  // namespace smopt::experiments
