#include "experiments/runner.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <thread>

#include "experiments/record_set.h"
#include "experiments/run/case_line.h"
#include "experiments/run/graph_run.h"
#include "experiments/run/record_assembly.h"
#include "experiments/run/run_lock.h"
#include "experiments/run/step_run.h"
#include "experiments/run/workload.h"
#include "experiments/run_layout.h"
#include "smopt/error.h"
#include "smopt/io/file.h"
#include "smopt/io/mesh_io.h"
#include "smopt/physical_memory.h"

namespace smopt::experiments {
namespace {

namespace fs = std::filesystem;

constexpr double kBytesPerMb = 1 << 20;
constexpr double kMemoryShare = 2.0 / 3;  // of the machine: estimates are rough, and others use it too

void make_folder_of(const fs::path& file) {
  std::error_code ignored;  // if that fails, so does writing there, which says why
  fs::create_directories(file.parent_path(), ignored);
}

/// Reasons may quote what a program printed, which need not be UTF-8.
void write_record(const fs::path& directory, const Json& record) {
  const fs::path path = record_path(directory, record.at("molecule").at("name").get<std::string>(), record.at("method").get<std::string>());
  make_folder_of(path);
  write_file(path, record.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

void keep_mesh(const fs::path& directory, std::string_view molecule, std::string_view method) {
  const fs::path kept = directory / "meshes" / molecule / (std::string(method) + ".off");
  const auto mesh = find_mesh(directory, molecule, method);
  if (!mesh) return;
  make_folder_of(kept);
  write_mesh(kept, read_mesh(*mesh));
}

/// What a process that was killed had begun to write.
void remove_halves(const fs::path& directory) {
  std::error_code ignored;
  std::vector<fs::path> halves;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(directory / "steps", ignored))
    if (entry.path().extension() == ".tmp" || entry.path().extension() == ".beside") halves.push_back(entry.path());
  for (const fs::path& half : halves) fs::remove(half, ignored);
}

CaseOutcome outcome_of(const Json& record) {
  const auto status = record.at("status").get<std::string>();
  const std::string reason = status == "done" ? "" : record.at("reason").get<std::string>();
  return {record.at("molecule").at("name").get<std::string>(), record.at("method").get<std::string>(),
          status == "done"            ? CaseStatus::done
          : status == "not installed" ? CaseStatus::not_installed
                                      : CaseStatus::failed,
          reason};
}

/// By the size of the step's input meshes, which are there when it can start.
double memory_mb_of(const Step& step, const fs::path& directory) {
  double bytes = 0;
  for (const std::string& file : step.inputs) {
    std::error_code missing;
    const auto size = fs::file_size(directory / file, missing);
    if (!missing && fs::path(file).extension() == ".ply") bytes += static_cast<double>(size);
  }
  return step.needs.memory_base_mb + step.needs.memory_per_input * bytes / kBytesPerMb;
}

GraphMachine machine_for(const RunOptions& options) {
  const int cores = std::max(1U, std::thread::hardware_concurrency());
  const double bytes =
      options.memory_bytes > 0 ? static_cast<double>(options.memory_bytes) : kMemoryShare * static_cast<double>(physical_memory_bytes());
  return {options.jobs > 0 ? options.jobs : cores, bytes / kBytesPerMb};
}

std::vector<GraphNode> nodes_of(const RunPlan& plan, const fs::path& directory) {
  std::map<std::string, std::size_t> index;
  std::vector<GraphNode> nodes;
  for (const Step& step : plan.steps) {
    GraphNode node;
    for (const std::string& id : step.after) node.after.push_back(index.at(id));
    node.threads = step.needs.threads;
    node.is_alone = step.needs.is_alone;
    node.memory_mb = [&step, &directory] { return memory_mb_of(step, directory); };
    index[step.id] = nodes.size();
    nodes.push_back(std::move(node));
  }
  return nodes;
}

/// A run in progress: steps end in many threads.
class Run {
 public:
  Run(const RunOptions& options, const RunPlan& plan, const RunObserver& observer)
      : options_(options), plan_(plan), observer_(observer), place_(step_place(options.directory, options.program)), work_(plan) {
    place_.threads = options.jobs;
  }

  RunSummary go() {
    run_graph(
        nodes_of(plan_, place_.directory), machine_for(options_), [this](std::size_t step) { run_or_end_all(step); },
        [this](const std::vector<std::size_t>& running) { look(running); });
    for (const CasePlan& planned : plan_.cases) summary_.cases.push_back(outcomes_.at(planned.record));
    summary_.seconds = work_.seconds();
    return summary_;
  }

 private:
  /// In a thread of its own. What this run itself cannot do (a full disk, say) ends the steps beside it, too.
  void run_or_end_all(std::size_t index) try { run(index); } catch (...) {
    is_cancelled_ = true;
    throw;
  }

  void run(std::size_t index) {
    const Step& step = plan_.steps[index];
    if (step.command.empty()) {
      record(index);
      return;
    }
    const std::optional<StepOutcome> earlier = options_.resumes ? earlier_outcome(step, place_) : std::nullopt;
    const bool is_reused = earlier && (earlier->status == "done" || !options_.retries);
    if (!is_reused) run_step(step, place_, [this](std::string_view, double) { return !is_cancelled_; });
    const std::lock_guard lock(mutex_);
    (is_reused ? summary_.steps_reused : summary_.steps_run) += 1;
    work_.finish(index, is_reused);
  }

  void record(std::size_t index) {
    const CasePlan& planned = plan_.recorded_by(plan_.steps[index]);
    const Json record = assemble_record(planned, plan_, place_.directory);
    write_record(place_.directory, record);
    if (options_.keeps_meshes) keep_mesh(place_.directory, planned.dataset.name, planned.method_case.name);
    const std::lock_guard lock(mutex_);
    work_.finish(index, false);
    outcomes_[planned.record] = outcome_of(record);
    if (!observer_.line) return;
    const std::string left = outcomes_.size() == plan_.cases.size() ? "" : "; about " + duration_text(work_.seconds_left()) + " left";
    lines_.push_back(fmt::format("[{}/{}] {} {}: {}{}", outcomes_.size(), plan_.cases.size(), planned.dataset.name,
                                 planned.method_case.name, case_line(record), left));
  }

  /// In the thread that called for the run.
  void look(const std::vector<std::size_t>& running) {
    std::vector<std::string> lines;
    double fraction = 0;
    {
      const std::lock_guard lock(mutex_);
      lines.swap(lines_);
      fraction = work_.fraction();
    }
    for (const std::string& line : lines) observer_.line(line);
    std::vector<std::string> ids;
    for (const std::size_t index : running) ids.push_back(plan_.steps[index].id);
    if (observer_.progress && !observer_.progress(fmt::format("experiments: {}", fmt::join(ids, ", ")), fraction)) {
      is_cancelled_ = true;
      throw Cancelled();
    }
  }

  const RunOptions& options_;
  const RunPlan& plan_;
  const RunObserver& observer_;
  StepPlace place_;
  std::atomic<bool> is_cancelled_ = false;
  std::mutex mutex_;  ///< of what follows
  Workload work_;
  RunSummary summary_;
  std::map<std::string, CaseOutcome> outcomes_;
  std::vector<std::string> lines_;  ///< not yet told
};

RunPlan make_written_plan(const RunOptions& options) {
  require_files(options.datasets);
  RunPlan plan = make_plan(options);
  write_file(options.directory / "plan.json", to_json(plan).dump(1) + "\n");
  return plan;
}

}  // namespace

std::size_t RunSummary::count(CaseStatus status) const {
  return static_cast<std::size_t>(std::count_if(cases.begin(), cases.end(), [&](const CaseOutcome& c) { return c.status == status; }));
}

RunPlan write_plan(const RunOptions& options) {
  const RunLock lock(options.directory);
  return make_written_plan(options);
}

RunSummary run_cases(const RunOptions& options, const RunObserver& observer) {
  const RunLock lock(options.directory);
  const RunPlan plan = make_written_plan(options);
  remove_halves(options.directory);
  return Run(options, plan, observer).go();
}

std::string run_planned_step(const PlannedStep& planned, const ProgressCallback& progress) {
  const fs::path& plan_file = planned.plan_file;
  const RunPlan plan = parse_plan(read_file(plan_file), plan_file.string());
  const Step& step = plan.step(planned.id);
  StepPlace place = step_place(plan_file.has_parent_path() ? plan_file.parent_path() : ".", planned.program);
  place.threads = planned.threads;
  if (!step.command.empty()) {
    const StepOutcome outcome = run_step(step, place, progress);
    if (outcome.is_interrupted) throw Cancelled();
    return outcome.status;
  }
  const Json record = assemble_record(plan.recorded_by(step), plan, place.directory);
  write_record(place.directory, record);
  return record.at("status").get<std::string>();
}

}  // namespace smopt::experiments
