#include "experiments/apbs/apbs.h"

#include <fmt/format.h>

#include "baselines/external/external_tool.h"
#include "smopt/error.h"
#include "smopt/io/file.h"
#include "smopt/io/scratch_folder.h"

namespace smopt::experiments {
namespace {

constexpr const char* kProgram = "apbs";
constexpr const char* kHowToGet = "Debian: apt install apbs";

void require_memory(const ApbsGrid& grid, const ProcessLimits& limits) {
  if (limits.memory_mb == 0 || grid.memory_mb() <= static_cast<double>(limits.memory_mb)) return;
  throw MethodFailed(fmt::format("APBS: {} × {} × {} nodes need about {:.0f} MB, {} MB are allowed", grid.nodes[0], grid.nodes[1],
                                 grid.nodes[2], grid.memory_mb(), limits.memory_mb));
}

void require_good_end(const ProcessOutcome& outcome, const ProcessLimits& limits) {
  if (outcome.out_of_time) throw MethodFailed(fmt::format("APBS: ran out of its {:g} s", limits.seconds));
  if (outcome.signal) throw MethodFailed(fmt::format("APBS: was ended by signal {} with {} MB allowed", *outcome.signal, limits.memory_mb));
  if (outcome.exit_status != 0) throw MethodFailed(fmt::format("APBS: ended with exit status {}", outcome.exit_status.value_or(-1)));
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
  require_memory(result.grid, options.limits);

  const ScratchFolder folder("apbs");
  const std::filesystem::path here = folder / "";
  write_file(folder / "molecule.pqr", format_pqr(molecule));
  write_file(folder / "energy.in", apbs_input("molecule.pqr", options.medium, options.surface, result.grid));
  const ProcessOutcome outcome = run_process({program.string(), "energy.in"}, options.limits, "APBS", progress, {{{"LC_ALL", "C"}}, here});
  require_good_end(outcome, options.limits);
  result.polar = parse_apbs_energy(outcome.output);
  result.seconds = outcome.seconds;
  result.peak_memory_mb = outcome.peak_memory_mb;
  return result;
}

}  // namespace smopt::experiments
