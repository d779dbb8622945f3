#include "experiments/improve_run.h"

#include <fmt/format.h>

#include <charconv>

#include "baselines/baselines.h"
#include "experiments/run_report.h"
#include "metrics/intersections.h"
#include "smopt/error.h"
#include "smopt/io/mesh_io.h"
#include "smopt/io/off.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

PreparationReport prepare_file(TriangleMesh& mesh, CavityPolicy cavities, const std::filesystem::path& file) {
  try {
    return prepare(mesh, cavities);
  } catch (const InvalidMesh& error) {
    throw InvalidMesh(fmt::format("{}: {}", is_stream(file) ? "standard input" : file.string(), error.what()));
  }
}

/// The mesh as whoever reads the output will see it.
TriangleMesh read_back(const TriangleMesh& mesh, const ImproveRun& run) {
  if (!is_stream(run.output)) return read_mesh(run.output);
  return parse_off(format_off(mesh, {run.digits}), run.output.string());
}

Json number_or_text(const MethodOption& option, const std::string& value) {
  double number = 0;
  const bool is_numeric = option.kind == MethodOption::Kind::integer || option.kind == MethodOption::Kind::number;
  if (!is_numeric || std::from_chars(value.data(), value.data() + value.size(), number).ec != std::errc()) return value;
  return option.kind == MethodOption::Kind::integer ? Json(static_cast<long>(number)) : Json(number);
}

Json number_or_null(const std::optional<std::size_t>& number) {
  return number ? Json(*number) : Json();
}

Json rounds_json(const std::vector<RoundReport>& rounds) {
  Json list = Json::array();
  for (const RoundReport& round : rounds) {
    list.push_back({{"active", round.active},
                    {"accepted", round.moves.accepted},
                    {"shortened", round.moves.shortened},
                    {"refused", round.moves.refused},
                    {"stuck", round.stuck},
                    {"longest_move", round.longest_move}});
  }
  return list;
}

Json operations_json(const std::map<std::string, OperationCounts>& operations) {
  Json json = Json::object();
  for (const auto& [name, counts] : operations) json[name] = {{"done", counts.done}, {"refused", counts.refused}};
  return json;
}

Json goals_json(const std::vector<GoalOutcome>& goals) {
  Json json = Json::array();
  for (const GoalOutcome& goal : goals) {
    json.push_back({{"name", goal.name},
                    {"goal", goal.goal},
                    {"reached", goal.reached},
                    {"missing", goal.missing},
                    {"explanation", goal.explanation}});
  }
  return json;
}

/// Of one repeat, from the mesh as read to the mesh as written.
StageTimes all_times(const PreparationReport& preparation, const MethodReport& outcome, const Stopwatch& watch) {
  StageTimes times = preparation.seconds;
  times.insert(times.end(), outcome.seconds.begin(), outcome.seconds.end());
  times.emplace_back("total", watch.elapsed());
  return times;
}

/// The medians over the repeats, and `around`: what is done once (reading, writing, and the total of it all).
void add_times(Json& report, const std::vector<StageTimes>& repeats, const StageTimes& around) {
  add_repeats(report, repeats);
  add_medians(report);
  for (const auto& [stage, seconds] : around) {
    report["seconds"][stage] = seconds.wall;
    report["cpu_seconds"][stage] = seconds.cpu;
  }
}

}  // namespace

void add_outcome(Json& report, const PreparationReport& preparation, const MethodReport& outcome) {
  const CavityReport& cavities = preparation.cavities;
  report["turned"] = {{"whole_mesh", preparation.was_inward}, {"triangles", preparation.turned_triangles}};
  report["removed"] = {{"cavities", cavities.cavities},
                       {"islands", cavities.islands},
                       {"cavity_vertices", cavities.cavity_vertices},
                       {"outer_components", cavities.outer_components},
                       {"outer_component_vertices", cavities.outer_component_vertices},
                       {"isolated_vertices", preparation.isolated_vertices},
                       {"redundant_valence3", outcome.redundant_valence3},
                       {"redundant_valence4", outcome.redundant_valence4}};
  report["rounds"] = outcome.rounds_run;
  report["moves"] = {{"accepted", outcome.moves.accepted},
                     {"shortened", outcome.moves.shortened},
                     {"refused", outcome.moves.refused},
                     {"stuck", outcome.stuck}};
  if (!outcome.operations.empty()) report["operations"] = operations_json(outcome.operations);
  if (!outcome.goals.empty()) report["goals"] = goals_json(outcome.goals);
  if (outcome.deviation) report["deviation"] = {{"lower", outcome.deviation->lower}, {"upper", outcome.deviation->upper}};
  report["stopped_because"] = outcome.stopped_because;
  report["diverged_at_step"] = outcome.diverged_at_step ? Json(*outcome.diverged_at_step) : Json();
  report["notes"] = outcome.notes;
  if (outcome.volume_before != 0) {
    report["volume"] = {{"before_smoothing", outcome.volume_before},
                        {"after_smoothing", outcome.volume_after},
                        {"relative_change", outcome.volume_after / outcome.volume_before - 1}};
  }
  report["each_round"] = rounds_json(outcome.rounds);
}

Json options_json(const Method& method, const OptionValues& values) {
  Json options = Json::object();
  for (const MethodOption& option : method.options) options[option.name] = number_or_text(option, values.text(option.name));
  return options;
}

ImproveRunResult run_improvement(const ImproveRun& run, const ProgressCallback& progress) {
  const Method& method = baselines::all_methods().find(run.method);
  const OptionValues values(method.options, run.options);
  const CavityPolicy cavities = run.cavities.value_or(method.default_cavities);
  if (!is_writable_mesh_format(run.output))
    throw InvalidOption(fmt::format("{}: not a mesh format that can be written ({})", run.output.string(), mesh_format_names()));

  ImproveRunResult result;
  const Stopwatch total;
  StageTimes times;
  const TriangleMesh initial = timed(times, "read", [&] { return read_mesh(run.input); });
  Json input = mesh_json(initial, run.input);
  TriangleMesh mesh;
  PreparationReport preparation;
  MethodReport outcome;
  std::vector<StageTimes> repeats;
  for (int i = 0; i < run.repeats; ++i) {
    const Stopwatch repeat;
    mesh = initial;
    preparation = prepare_file(mesh, cavities, run.input);
    if (run.verify && i == 0) result.pairs_before = metrics::find_intersections(mesh, {0}).count;
    outcome = method.run(mesh, values, progress);
    repeats.push_back(all_times(preparation, outcome, repeat));
  }
  input["euler_characteristic"] = input["euler_characteristic"].get<long>() - static_cast<long>(preparation.isolated_vertices);
  report_progress(progress, "write", 0);  // an interrupt is still answered here
  timed(times, "write", [&] { write_mesh(run.output, mesh, {run.digits}); });
  if (run.verify) result.pairs_after = metrics::find_intersections(read_back(mesh, run), {0}).count;

  Json& report = result.report;
  report["method"] = method.name;
  report["options"] = options_json(method, values);
  report["options"]["cavities"] = to_string(cavities);
  report["options"]["digits"] = run.digits;
  report["input"] = input;
  report["output"] = mesh_json(mesh, run.output);
  add_outcome(report, preparation, outcome);
  times.emplace_back("total", total.elapsed());
  add_times(report, repeats, times);
  if (run.verify)
    report["verified"] = {{"pairs_before", number_or_null(result.pairs_before)}, {"pairs_after", number_or_null(result.pairs_after)}};
  add_program(report);
  return result;
}

}  // namespace smopt::experiments
