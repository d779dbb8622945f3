#include "experiments/run/record_assembly.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "experiments/run/step_run.h"
#include "experiments/run_report.h"
#include "smopt/error.h"
#include "smopt/io/file.h"

namespace smopt::experiments {
namespace {

/// What of `smopt improve --report` is about files and the program, or is said of the record's own.
constexpr std::array kNotOfTheRecord = {"method", "options", "input", "output", "version", "seconds", "cpu_seconds"};

/// What the steps of a case left behind.
class CaseFiles {
 public:
  CaseFiles(const CasePlan& planned, const RunPlan& plan, const std::filesystem::path& directory)
      : planned_(planned), plan_(plan), directory_(directory) {}

  [[nodiscard]] Json stamp(const std::string& id) const {
    const auto stamp = read_stamp(plan_.step(id), directory_);
    if (!stamp) throw InvalidInput(fmt::format("{}: has not been run", id));
    return *stamp;
  }
  [[nodiscard]] bool is_done(const std::string& id) const { return stamp(id).at("status") == "done"; }
  [[nodiscard]] Json report(const std::string& id) const {
    const std::filesystem::path file = directory_ / "steps" / (id + ".json");
    Json json = Json::parse(read_file(file), nullptr, false);
    if (!json.is_object()) throw InvalidInput(fmt::format("{}: not a report", file.string()));
    return json;
  }
  /// sha256 of the first file that a step makes: the mesh.
  [[nodiscard]] Json mesh_sha256(const std::string& id) const { return stamp(id).at("sha256").at(plan_.step(id).outputs.front()); }
  [[nodiscard]] const CasePlan& planned() const { return planned_; }
  [[nodiscard]] bool is_initial() const { return planned_.improve.empty(); }
  /// Those without which there is no result, in their order.
  [[nodiscard]] std::vector<std::string> necessary() const {
    std::vector<std::string> ids = {planned_.generate};
    for (const std::string* id : {&planned_.improve, &planned_.measure_input, &planned_.measure})
      if (!id->empty()) ids.push_back(*id);
    return ids;
  }
  /// The step that made the mesh.
  [[nodiscard]] const std::string& maker() const { return is_initial() ? planned_.generate : planned_.improve; }

 private:
  const CasePlan& planned_;
  const RunPlan& plan_;
  const std::filesystem::path& directory_;
};

void add_molecule(Json& record, const CaseFiles& files) {
  const Dataset& dataset = files.planned().dataset;
  if (!dataset.mesh.empty()) {
    record["surface"] = {{"file", dataset.mesh.filename().string()}};
    return;
  }
  const Json report = files.report(files.planned().generate);
  record["molecule"]["atoms"] = report.at("molecule").at("atoms");
  record["molecule"]["sha256"] = report.at("molecule").at("sha256");
  record["surface"]["report"] = report.at("sampling");
}

/// What a measurement says of the mesh alone, and apart from that how far it is from the molecule's level set.
struct Measured {
  Json metrics, distance;
};

Measured measured_by(const CaseFiles& files, const std::string& measure) {
  Measured measured{files.report(measure), {}};
  measured.distance = measured.metrics.value("level_set_distance", Json());
  measured.metrics.erase("level_set_distance");
  return measured;
}

Json mesh_json(const Json& metrics, const Json& sha256) {
  return {{"vertices", metrics.at("vertices")},
          {"triangles", metrics.at("triangles")},
          {"euler_characteristic", metrics.at("euler_characteristic")},
          {"sha256", sha256}};
}

void add_metrics(Json& record, const CaseFiles& files) {
  const CasePlan& planned = files.planned();
  const Measured after = measured_by(files, planned.measure);
  const Measured before = files.is_initial() ? after : measured_by(files, planned.measure_input);
  record["input"] = mesh_json(before.metrics, files.mesh_sha256(files.is_initial() ? planned.generate : planned.input));
  record["output"] = mesh_json(after.metrics, files.mesh_sha256(files.maker()));
  record["metrics"] = {{"before", before.metrics}, {"after", after.metrics}};
  record["level_set_distance"] = {{"before", before.distance}, {"after", after.distance}};
}

/// The times of every repeat and their medians, of the method alone: the step reads and writes files besides.
void add_times(Json& record, const Json& report) {
  record["repeats"] = report.at("repeats");
  add_medians(record);
}

void add_generated(Json& record, const CaseFiles& files) {
  record["options"] = Json::object();
  if (!files.planned().dataset.mesh.empty()) return;
  const Json report = files.report(files.planned().generate);
  record["threads"] = report.at("threads");
  add_times(record, report);
  record["peak_memory_mb"] = report.at("peak_memory_mb");
}

/// A number of vertices that was taken from another case's mesh is told as a number.
Json told_options(const Json& report, const CaseFiles& files) {
  Json options = report.at("options");
  if (const std::string& matched = files.planned().matched; !matched.empty()) {
    options["vertices"] = files.report(matched).at("output").at("vertices");
    options.erase("match");
  }
  return options;
}

void add_improved(Json& record, const CaseFiles& files) {
  const Json report = files.report(files.planned().improve);
  record["options"] = told_options(report, files);
  for (const auto& [key, value] : report.items())
    if (std::ranges::find(kNotOfTheRecord, key) == kNotOfTheRecord.end()) record[key] = value;
  add_times(record, report);
}

Json failed_trial(const Json& stamp, const std::string& switches) {
  return {{"status", "failed"}, {"reason", stamp.at("reason")}, {"switches", switches}};
}

void add_tetgen(Json& record, const CaseFiles& files) {
  for (const auto& [switches, id] : files.planned().tetrahedralize)
    record["tetgen"][switches] = files.is_done(id) ? files.report(id) : failed_trial(files.stamp(id), switches);
}

void add_solvation(Json& record, const CaseFiles& files) {
  const CasePlan& planned = files.planned();
  if (planned.solvate.empty()) {
    record["solvation"] = {{"status", "not computed"}, {"reason", planned.why_no_solvation}};
    return;
  }
  const Json stamp = files.stamp(planned.solvate);
  if (stamp.at("status") == "done")
    record["solvation"] = files.report(planned.solvate);
  else
    record["solvation"] = {{"status", stamp.value("out_of_time", false) ? "over limit" : "failed"}, {"reason", stamp.at("reason")}};
}

/// A user's folder means nothing elsewhere.
void hide_folder_of_data(Json& step, const Dataset& dataset) {
  if (!step.contains("command")) return;
  const std::filesystem::path molecule = dataset.package.empty() ? dataset.path : std::filesystem::path();
  for (Json& word : step["command"])
    for (const std::filesystem::path& file : {molecule, dataset.mesh})
      if (!file.empty() && word == std::filesystem::absolute(file).string()) word = file.filename().string();
}

/// By which commands the case was made, and what each took as a process.
void add_provenance(Json& record, const CaseFiles& files, const RunPlan& plan) {
  const Json made = files.stamp(files.maker());
  if (made.contains("machine")) record["machine"] = made.at("machine");
  record["provenance"]["program_sha256"] = made.value("program_sha256", Json());
  for (const std::string& id : plan.step(files.planned().record).after) {
    const Json stamp = files.stamp(id);
    Json& step = record["provenance"]["steps"][id];
    for (const char* key : {"status", "reason", "command", "key", "exit_status", "seconds", "cpu_seconds", "peak_memory_mb"})
      if (stamp.contains(key)) step[key] = stamp.at(key);
    hide_folder_of_data(step, files.planned().dataset);
  }
}

void mark_as(Json& record, const Json& stamp) {
  const auto reason = stamp.at("reason").get<std::string>();
  if (stamp.at("status") == "not installed")
    mark_not_installed(record, reason);
  else
    mark_failed(record, reason);
}

/// As far as the necessary steps got. \return whether that is all of it.
bool fill(Json& record, const CaseFiles& files) {
  for (const std::string& id : files.necessary()) {
    if (!files.is_done(id)) {
      mark_as(record, files.stamp(id));
      return false;
    }
    if (id == files.planned().generate) add_molecule(record, files);
    if (id == files.maker()) files.is_initial() ? add_generated(record, files) : add_improved(record, files);
  }
  add_metrics(record, files);
  return true;
}

}  // namespace

Json assemble_record(const CasePlan& planned, const RunPlan& plan, const std::filesystem::path& directory) {
  Json record = record_header(planned.dataset, planned.method_case);
  const CaseFiles files(planned, plan, directory);
  if (fill(record, files)) {
    if (plan.options.simulates) {
      add_tetgen(record, files);
      add_solvation(record, files);
    }
    mark_done(record);
  }
  add_provenance(record, files, plan);
  return record;
}

}  // namespace smopt::experiments
