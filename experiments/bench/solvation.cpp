#include <benchmark/benchmark.h>
#include <malloc.h>

#include <array>
#include <cmath>
#include <string>

#include "baselines/baselines.h"
#include "experiments/bench/benchmarks.h"
#include "experiments/bench/registration.h"
#include "experiments/bench/threads.h"
#include "experiments/datasets.h"
#include "experiments/machine.h"
#include "metrics/solvation/solvate.h"
#include "smopt/improve/prepare.h"
#include "smopt/peak_memory.h"
#include "smopt/surface/gaussian_surface.h"

namespace smopt::bench {
namespace {

/// Of the AChE monomer, thousandths of an ångström: 16 000, 65 000, 260 000 and 1 million vertices.
const std::vector<std::int64_t> kSpacings = {1450, 745, 375, 190};

/// A made-up molecule that needs no file.
constexpr std::int64_t kMadeUp = 0;

/// Charged spheres on a helix.
Molecule charged_helix() {
  constexpr int kAtoms = 40;
  Molecule molecule;
  for (int i = 0; i < kAtoms; ++i) {
    molecule.centers.emplace_back(6 * std::cos(0.4 * i), 6 * std::sin(0.4 * i), 0.5 * i);
    molecule.charges.push_back(i % 3 - 1);
    molecule.radii.push_back(1.7);
  }
  return molecule;
}

struct Subject {
  Molecule molecule;
  TriangleMesh mesh;  ///< improved by SMOPT with its defaults
};

Subject make(std::int64_t spacing) {
  Subject subject;
  GaussianSurfaceOptions options;
  if (spacing == kMadeUp) {
    subject.molecule = charged_helix();
  } else {
    const std::array<std::string, 1> names{"ache-monomer"};
    const experiments::Dataset dataset = experiments::find_datasets(experiments::all_datasets(), names).front();
    subject.molecule = read_molecule(dataset.path);
    options = dataset.surface;
    options.spacing = 1e-3 * static_cast<double>(spacing);
  }
  subject.mesh = gaussian_surface(subject.molecule, options);
  prepare(subject.mesh, CavityPolicy::delete_cavities);
  const Method& smopt = baselines::all_methods().find("smopt");
  smopt.run(subject.mesh, OptionValues(smopt.options, {}), {});
  malloc_trim(0);
  return subject;
}

void measure_solvation(benchmark::State& state) {
  const ThreadLimit limit(state.range(0));
  const Subject subject = make(state.range(1));
  metrics::Solvation result;
  experiments::reset_peak_memory();
  for (auto _ : state) {
    result = metrics::solvate(subject.mesh, subject.molecule);
    state.SetIterationTime(result.seconds);
  }
  const auto vertices = static_cast<double>(subject.mesh.vertex_count());
  state.counters["vertices"] = vertices;
  state.counters["microseconds_per_vertex"] = 1e6 * result.seconds / vertices;
  state.counters["iterations"] = result.iterations;
  state.counters["polar"] = result.polar;
  state.counters["peak_megabytes"] = peak_memory_mb();
  state.counters["predicted_megabytes"] = result.predicted_memory_mb;
}

}  // namespace

void register_solvation(const Sizes& sizes) {
  const bool is_tiny = sizes == Sizes{0};
  timed_once(benchmark::RegisterBenchmark("solvation", measure_solvation))
      ->ArgNames({"threads", "spacing_mA"})
      ->ArgsProduct({{2}, is_tiny ? std::vector<std::int64_t>{kMadeUp} : kSpacings});
}

}  // namespace smopt::bench
