#include "experiments/apbs/apbs.h"

#include <fmt/format.h>

#include "baselines/external/external_tool.h"
#include "experiments/apbs/gaussian_maps.h"
#include "smopt/error.h"
#include "smopt/io/file.h"
#include "smopt/io/scratch_folder.h"

namespace smopt::experiments {
namespace {

constexpr const char* kProgram = "apbs";
constexpr const char* kHowToGet = "Debian: apt install apbs";

void require_memory(const ApbsGrid& grid, ApbsSurface surface, const ProcessLimits& limits) {
  if (limits.memory_mb == 0 || grid.memory_mb(surface) <= static_cast<double>(limits.memory_mb)) return;
  throw MethodFailed(fmt::format("APBS: {} × {} × {} nodes need about {:.0f} MB, {} MB are allowed", grid.nodes[0], grid.nodes[1],
                                 grid.nodes[2], grid.memory_mb(surface), limits.memory_mb));
}

void require_good_end(const ProcessOutcome& outcome, const ProcessLimits& limits) {
  if (outcome.out_of_time) throw MethodFailed(fmt::format("APBS: ran out of its {:g} s", limits.seconds));
  if (outcome.signal) throw MethodFailed(fmt::format("APBS: was ended by signal {} with {} MB allowed", *outcome.signal, limits.memory_mb));
  if (outcome.exit_status != 0) throw MethodFailed(fmt::format("APBS: ended with exit status {}", outcome.exit_status.value_or(-1)));
}

/// More threads than one gain APBS nothing, and wait in a loop where others compute.
ProcessSurroundings surroundings_in(const std::filesystem::path& folder) {
  return {{{"LC_ALL", "C"}, {"OMP_NUM_THREADS", "1"}}, folder};
}

}  // namespace

bool has_apbs() {
  return baselines::find_program(kProgram).has_value();
}

ApbsResult run_apbs(const Molecule& molecule, const ApbsOptions& options, const ProgressCallback& progress) {
  const std::filesystem::path program = baselines::require_program("APBS", kProgram, kHowToGet);
  if (molecule.atom_count() == 0) throw InvalidInput("APBS: a molecule without atoms");
  ApbsResult result;
  result.grid = apbs_grid(molecule, options.spacing);
  require_memory(result.grid, options.surface, options.limits);

  const ScratchFolder folder("apbs");
  const std::filesystem::path here = folder / "";
  write_file(folder / "molecule.pqr", format_pqr(molecule));
  if (options.surface == ApbsSurface::gaussian) write_gaussian_maps(here, molecule, options.gaussian, options.medium, result.grid);
  write_file(folder / "energy.in", apbs_input("molecule.pqr", options.medium, options.surface, result.grid));
  const ProcessOutcome outcome = run_process({program.string(), "energy.in"}, options.limits, "APBS", progress, surroundings_in(here));
  require_good_end(outcome, options.limits);
  result.polar = parse_apbs_energy(outcome.output);
  result.seconds = outcome.seconds;
  result.peak_memory_mb = outcome.peak_memory_mb;
  return result;
}

}  // namespace smopt::experiments
