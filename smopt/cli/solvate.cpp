#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "metrics/solvation/solvate.h"
#include "metrics/solvation/solvation_json.h"
#include "metrics/solvation/surface_sums.h"
#include "smopt/cli/command.h"
#include "smopt/cli/progress_bar.h"
#include "smopt/error.h"
#include "smopt/io/file.h"
#include "smopt/io/mesh_io.h"
#include "smopt/peak_memory.h"

namespace smopt::cli {
namespace {

using metrics::Solvation;
using metrics::SolvationStatus;

constexpr double kBytesPerMb = 1 << 20;

struct Arguments {
  std::string mesh;
  std::string molecule;
  std::string output;
  std::string report;
  metrics::SolvationOptions options;
  bool is_json = false;
};

/// What would be found out only after the work.
void require_arguments(const Arguments& arguments) {
  if (arguments.mesh == "-" && arguments.molecule == "-")
    throw InvalidOption("the mesh and the molecule cannot both come from standard input");
  if (!arguments.report.empty()) require_writable_place(arguments.report);
  if (arguments.output.empty()) return;
  if (!is_scalar_mesh_format(arguments.output))
    throw InvalidOption(
        fmt::format("{}: a potential is written to a mesh of the formats {}", arguments.output, scalar_mesh_format_names()));
  require_writable_place(arguments.output);
}

Molecule read_charges(const std::string& file, const Context& context) {
  MoleculeReadReport report;
  Molecule molecule = read_molecule(file, {}, &report);
  if (!context.is_quiet)
    for (const std::string& note : report.notes) fmt::print(stderr, "note: {}\n", note);
  return molecule;
}

Solvation solve(const Arguments& arguments, const TriangleMesh& mesh, const Molecule& molecule) try {
  return metrics::solvate(mesh, molecule, arguments.options);
} catch (const InvalidMesh& error) {
  throw InvalidMesh(fmt::format("{}: {}", display_name(arguments.mesh), error.what()));
}

/// Whether it needs more memory than --max-memory allows; the report and what is printed say so then, with the estimate.
bool is_over_limit(const Arguments& arguments, const TriangleMesh& mesh, const Molecule& molecule) {
  const std::uint64_t limit = arguments.options.max_memory_bytes;
  const double needed = limit == 0 ? 0 : metrics::predicted_solvation_bytes(mesh, molecule, arguments.options);
  if (needed <= static_cast<double>(limit)) return false;
  const double needed_mb = std::ceil(needed / kBytesPerMb);
  const nlohmann::ordered_json report = {
      {"status", "over limit"}, {"reason", fmt::format("needs {:.0f} MB", needed_mb)}, {"predicted_memory_mb", needed_mb}};
  write_file(arguments.report, report.dump(2) + "\n");
  if (arguments.is_json)
    fmt::print("{}\n", report.dump(2));
  else
    fmt::print("over limit: needs {:.0f} MB\n", needed_mb);
  return true;
}

void write_report(const Arguments& arguments, const Solvation& result) {
  nlohmann::ordered_json report = metrics::to_json(result);
  report["options"] = metrics::to_json(arguments.options);
  report["threads"] = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  report["peak_memory_mb"] = peak_memory_mb();
  write_file(arguments.report, report.dump(2) + "\n");
}

/// Only PQR has charges; whoever gives another format should hear of it.
void explain_no_charges(Solvation& result, const std::string& molecule) {
  if (result.status != SolvationStatus::no_charges || molecule == "-" || format_ending(molecule) == "pqr") return;
  result.reason += fmt::format("; {} files have none, PQR files do (PDB2PQR makes them)", format_ending(molecule));
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

void write_potential(const Arguments& arguments, const TriangleMesh& mesh, const Solvation& result) {
  const double per_kt = 1 / arguments.options.medium.thermal_energy();
  const std::vector<double> potential = scaled(result.potential, per_kt);
  const std::vector<double> derivative = scaled(result.normal_derivative, per_kt);
  const std::array<VertexScalars, 2> scalars = {{{"potential_kT_per_e", potential}, {"normal_derivative_kT_per_e_A", derivative}}};
  write_mesh_with_scalars(arguments.output, mesh, scalars);
}

/// Whether there is a potential to look at: one that did not converge shows where, one that is not finite shows nothing.
bool has_potential(const Solvation& result) {
  return result.status == SolvationStatus::success || result.status == SolvationStatus::not_converged;
}

/// The first few of a list that may be long.
std::string beginning_of(const std::vector<VertexId>& vertices) {
  constexpr std::size_t kShown = 10;
  const std::size_t shown = std::min(vertices.size(), kShown);
  return fmt::format("{}{}", fmt::join(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                     vertices.size() > shown ? ", …" : "");
}

/// An energy, its point below those of the others.
std::string energy(double value) {
  return std::isfinite(value) ? fmt::format("{:14.4f} kcal/mol", value) : fmt::format("{:>9}", "none");
}

void print(const Solvation& result, const Molecule& molecule) {
  const auto charges = std::ranges::count_if(molecule.charges, [](double q) { return q != 0; });
  fmt::print("{}{}{}\n", metrics::to_string(result.status), result.reason.empty() ? "" : ": ", result.reason);
  fmt::print("polar                {}\n", energy(result.polar));
  fmt::print("nonpolar             {}, of {:.1f} Å² and {:.1f} Å³\n", energy(result.nonpolar), result.area, result.volume);
  fmt::print("total                {}\n", energy(result.total()));
  fmt::print("iterations           {:>9}, relative residual {:.2g}\n", result.iterations, result.relative_residual);
  fmt::print("charges outside      {:>9} of {}\n", result.charges_outside, charges);
  fmt::print("degenerate vertices  {:>9}{}{}\n", result.degenerate_vertices.size(), result.degenerate_vertices.empty() ? "" : ": ",
             beginning_of(result.degenerate_vertices));
  fmt::print("time                 {:12.2f} s\n", result.seconds);
}

void run(Arguments& arguments, Context& context) {
  require_arguments(arguments);
  ProgressBar bar(context.is_quiet);
  arguments.options.progress = bar.callback();
  const TriangleMesh mesh = read_mesh(arguments.mesh);
  const Molecule molecule = read_charges(arguments.molecule, context);
  if (!arguments.report.empty() && is_over_limit(arguments, mesh, molecule)) {
    context.exit_code = ExitCode::answer_is_no;
    return;
  }
  Solvation result = solve(arguments, mesh, molecule);
  explain_no_charges(result, arguments.molecule);
  if (!arguments.output.empty() && has_potential(result)) write_potential(arguments, mesh, result);
  if (!arguments.report.empty()) write_report(arguments, result);
  if (arguments.is_json)
    fmt::print("{}\n", metrics::to_json(result).dump(2));
  else
    print(result, molecule);
  if (result.status != SolvationStatus::success) context.exit_code = ExitCode::answer_is_no;
}

void add_medium_options(CLI::App& command, metrics::SolvationOptions& options) {
  command.add_option("--inner", options.medium.inner, "relative permittivity of the molecule")->capture_default_str();
  command.add_option("--outer", options.medium.outer, "relative permittivity of the solvent")->capture_default_str();
  command.add_option("--ionic-strength", options.medium.ionic_strength, "of the solvent, mmol/l; 0: no salt")->capture_default_str();
  command.add_option("--temperature", options.medium.temperature, "kelvin")->capture_default_str();
  command.add_option("--surface-tension", options.surface_tension, "of the nonpolar part, kcal/mol/Å²")->capture_default_str();
  command.add_option("--pressure", options.pressure, "of the nonpolar part, kcal/mol/Å³")->capture_default_str();
}

void add_solver_options(CLI::App& command, metrics::SolvationOptions& options) {
  command
      .add_option(
          "--accuracy", options.accuracy,
          fmt::format("what the sums may change of the energy, relative; {} to {}", metrics::kBestAccuracy, metrics::kWorstAccuracy))
      ->capture_default_str();
  command.add_flag("--direct", options.is_direct, "sum what is not integrated pair by pair: for reference, and slow");
  command.add_option("--residual", options.residual, "relative residual at which the linear system counts as solved")
      ->capture_default_str();
  command.add_option("--max-iterations", options.max_iterations, "of GMRES; more is \"not_converged\"")->capture_default_str();
  command.add_option("--restart", options.restart, "directions that GMRES keeps")->capture_default_str();
  command.add_option("--block", options.block, "vertices in a block of the preconditioner; 1: each by itself")->capture_default_str();
  command
      .add_option("--max-memory", options.max_memory_bytes,
                  "refuse, before the work, what would need more memory than this (such as 500MB or 4GB; default: what the machine has)")
      ->transform(CLI::AsSizeValue(false));
}

}  // namespace

void add_solvate(CLI::App& app, Context& context) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("solvate", "Solvation energy of a molecule by boundary elements on its surface");
  command->footer(
      "Solves the linearised Poisson–Boltzmann equation with the potential and its normal derivative at the vertices as unknowns, as "
      "AFMPB\n"
      "does and with its defaults. polar is the electrostatic part, nonpolar is surface tension · area + pressure · volume. degenerate "
      "vertices\n"
      "are those at which AFMPB would end with NaN; charges outside are charges that the surface does not enclose. The status is success,\n"
      "not_converged, nonfinite or no_charges, with the reason; the exit code is 1 unless it is success.\n"
      "\n"
      "Examples:\n"
      "  smopt generate molecule.pqr -o surface.off --improve && smopt solvate surface.off molecule.pqr\n"
      "  smopt solvate surface.off molecule.pqr -o potential.vtp            a surface to colour by its potential in ParaView\n"
      "  smopt solvate surface.off molecule.pqr --ionic-strength 0 --json");
  command->add_option("mesh", arguments->mesh, "the molecule's surface, closed (" + mesh_format_names() + ", each also .gz; - for OFF)")
      ->required();
  command
      ->add_option("molecule", arguments->molecule,
                   "the charges, as PQR (" + molecule_format_names() + " are read, each also .gz; - for PQR)")
      ->required();
  command->add_option("-o,--output", arguments->output,
                      "write the mesh with the potential, kT/e, and its normal derivative just inside, kT/e/Å, at the vertices (" +
                          scalar_mesh_format_names() + ", each also .gz)");
  add_medium_options(*command, arguments->options);
  add_solver_options(*command, arguments->options);
  command->add_option(
      "--report", arguments->report,
      "write the result, the options and the memory used as JSON to this file; a solve that needs more than --max-memory is a result, too");
  command->add_flag("--json", arguments->is_json, "as JSON");
  command->callback([arguments, &context] { run(*arguments, context); });
}

}  // namespace smopt::cli
