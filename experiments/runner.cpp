#include "experiments/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "experiments/case_run.h"
#include "experiments/level_set_run.h"
#include "experiments/record.h"
#include "experiments/record_set.h"
#include "experiments/run_layout.h"
#include "smopt/error.h"
#include "smopt/io/file.h"
#include "smopt/io/mesh_io.h"
#include "smopt/timing.h"

namespace smopt::experiments {
namespace {

/// How much of the run is done, by the sizes of the molecules' files: what a case costs grows about as they do.
class Workload {
 public:
  explicit Workload(const RunOptions& options) : cases_(options.datasets.size() * options.methods.size()) {
    for (const Dataset& dataset : options.datasets) total_ += weight(dataset) * static_cast<double>(options.methods.size());
  }

  void finish(const Dataset& dataset) {
    done_ += weight(dataset);
    ++finished_;
  }
  [[nodiscard]] double fraction() const { return done_ / total_; }
  [[nodiscard]] double seconds_left() const { return clock_.elapsed().wall * (total_ - done_) / done_; }
  [[nodiscard]] double seconds() const { return clock_.elapsed().wall; }
  [[nodiscard]] std::size_t finished() const { return finished_; }
  [[nodiscard]] std::size_t cases() const { return cases_; }

 private:
  static double weight(const Dataset& dataset) {
    std::error_code missing;
    const auto bytes = std::filesystem::file_size(dataset.path, missing);
    return missing ? 1.0 : static_cast<double>(bytes) + 1.0;
  }

  Stopwatch clock_;
  std::size_t cases_;
  std::size_t finished_ = 0;
  double total_ = 0;
  double done_ = 0;
};

/// What the cases of one molecule share; made when the first of them asks for it. A failure is remembered: it fails all that ask.
class SharedMeshes {
 public:
  SharedMeshes(const Dataset& dataset, int repeats, const ProgressCallback& progress)
      : dataset_(dataset), repeats_(repeats), progress_(progress) {}

  const GeneratedSurface& surface() {
    return remembered(surface_, [&] { return generate_surface(dataset_, repeats_, progress_); });
  }
  const JudgedMesh& initial() {
    return remembered(initial_, [&] { return judge(surface().mesh); });
  }
  const JudgedMesh& input() {
    return remembered(input_, [&] { return prepare_input(surface().mesh); });
  }
  const LevelSet& level_set() {
    return remembered(level_set_, [&] { return LevelSet(surface().molecule, dataset_.surface); });
  }
  /// Of the mesh that the methods get.
  const Json& distance_of_input() {
    return remembered(distance_of_input_, [&] { return to_json(level_set().distance(input().mesh)); });
  }
  /// How many vertices the result of a case has.
  std::size_t vertices_of(const std::string& name, const MethodRegistry& registry) {
    return remembered(vertices_[name], [&] {
      const MethodCase method_case = find_method_case(name);
      const Method& method = registry.find(method_case.method);
      return vertices_after(method, OptionValues(method.options, method_case.options), surface().mesh, progress_);
    });
  }
  void remember_vertices_of(const std::string& name, std::size_t vertices) { vertices_[name].value = vertices; }

 private:
  template <class T>
  struct Remembered {
    std::optional<T> value;
    std::exception_ptr failure;
  };

  template <class T, class Make>
  static const T& remembered(Remembered<T>& slot, const Make& make) {
    if (slot.failure) std::rethrow_exception(slot.failure);
    if (!slot.value) {
      try {
        slot.value = make();
      } catch (const Cancelled&) {
        throw;
      } catch (...) {
        slot.failure = std::current_exception();
        throw;
      }
    }
    return *slot.value;
  }

  const Dataset& dataset_;
  int repeats_;
  const ProgressCallback& progress_;
  Remembered<GeneratedSurface> surface_;
  Remembered<JudgedMesh> initial_;
  Remembered<JudgedMesh> input_;
  Remembered<LevelSet> level_set_;
  Remembered<Json> distance_of_input_;
  std::map<std::string, Remembered<std::size_t>> vertices_;
};

/// The options of a case, the number of vertices that it takes from another among them.
OptionValues options_of(const MethodCase& method_case, const MethodRegistry& registry, SharedMeshes& meshes) {
  std::map<std::string, std::string> given = method_case.options;
  if (!method_case.vertices_of.empty()) given["vertices"] = fmt::format("{}", meshes.vertices_of(method_case.vertices_of, registry));
  return {registry.find(method_case.method).options, given};
}

/// Makes the folder that `path` is to be in; if that fails, so does writing there, which says why.
void make_folder_of(const std::filesystem::path& path) {
  std::error_code ignored;
  std::filesystem::create_directories(path.parent_path(), ignored);
}

/// Reasons may quote what a program printed, which need not be UTF-8.
void write_record(const std::filesystem::path& directory, const Json& record) {
  const std::filesystem::path path =
      record_path(directory, record.at("molecule").at("name").get<std::string>(), record.at("method").get<std::string>());
  make_folder_of(path);
  write_file(path, record.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

void keep_mesh(const RunOptions& options, const Dataset& dataset, std::string_view name, const TriangleMesh& mesh) {
  if (!options.keeps_meshes) return;
  const std::filesystem::path path = options.directory / "meshes" / dataset.name / (std::string(name) + ".off");
  make_folder_of(path);
  write_mesh(path, mesh);
}

/// How far the case's mesh is from the level set, and how far what it was made of is; of the mesh as generated the two are the same.
void add_level_set_distance(Json& record, const TriangleMesh& mesh, std::string_view method, SharedMeshes& meshes) {
  const Json after = to_json(meshes.level_set().distance(mesh));
  record["level_set_distance"] = {{"before", method == kInitial ? after : meshes.distance_of_input()}, {"after", after}};
}

/// Fills the record of one case as far as it gets. \throws what it fails of.
void run_case(Json& record, const RunOptions& options, const MethodRegistry& registry, const Dataset& dataset, const std::string& method,
              SharedMeshes& meshes, const ProgressCallback& progress) {
  add_surface(record, meshes.surface());
  const auto simulate = [&](const TriangleMesh& mesh) {
    add_level_set_distance(record, mesh, method, meshes);
    add_simulations(record, mesh, meshes.surface().molecule, solvation_plan(dataset, method, options.solvation), progress);
  };
  if (method == kInitial) {
    run_initial_case(record, meshes.initial(), meshes.surface());
    keep_mesh(options, dataset, method, meshes.initial().mesh);
    simulate(meshes.initial().mesh);
    return;
  }
  const JudgedMesh& input = meshes.input();
  keep_mesh(options, dataset, "without-cavities", input.mesh);
  const MethodCase method_case = find_method_case(method);
  const TriangleMesh improved = run_method_case(record, registry.find(method_case.method), options_of(method_case, registry, meshes),
                                                meshes.surface().mesh, input, options.repeats, progress);
  meshes.remember_vertices_of(method, improved.vertex_count());
  keep_mesh(options, dataset, method, improved);
  simulate(improved);
}

/// The record of one case, whatever becomes of it.
Json record_case(const RunOptions& options, const MethodRegistry& registry, const Dataset& dataset, const std::string& method,
                 SharedMeshes& meshes, const ProgressCallback& progress) {
  Json record = record_header(dataset, method);
  record_outcome(record, [&] { run_case(record, options, registry, dataset, method, meshes, progress); });
  return record;
}

std::string pairs_text(const Json& record) {
  const Json& pairs = record.at("metrics").at("after").at("intersecting_pairs");
  return pairs.is_null() ? "intersecting pairs not counted" : fmt::format("{} intersecting pairs", pairs.get<long>());
}

/// "; solvation -512.3 kcal/mol", or how it ended; nothing where it is not computed.
std::string solvation_text(const Json& record) {
  const std::string status = text_at(&record, "/solvation/status").value_or("not computed");
  if (status == "not computed") return "";
  const auto energy = number_at(&record, "/solvation/total_kcal_per_mol");
  return status == "success" && energy ? fmt::format("; solvation {:.1f} kcal/mol", *energy) : fmt::format("; solvation {}", status);
}

std::string divergence_text(const Json& record) {
  const auto step = number_at(&record, "/diverged_at_step");
  return step ? fmt::format("; diverged at step {:.0f}", *step) : "";
}

std::string case_line(const Json& record, const Workload& work) {
  const std::string name = fmt::format("[{}/{}] {} {}", work.finished(), work.cases(), record.at("molecule").at("name").get<std::string>(),
                                       record.at("method").get<std::string>());
  const std::string left = work.finished() == work.cases() ? "" : fmt::format("; about {:.0f} s left", work.seconds_left());
  const auto status = record.at("status").get<std::string>();
  if (status != "done") return fmt::format("{}: {}: {}{}", name, status, record.at("reason").get<std::string>(), left);
  return fmt::format("{}: {} vertices, {}, TetGen p {}, pY {}{}; {:.2f} s CPU{}{}", name, record.at("output").at("vertices").get<long>(),
                     pairs_text(record), record.at("tetgen").at("p").at("status").get<std::string>(),
                     record.at("tetgen").at("pY").at("status").get<std::string>(), solvation_text(record),
                     record.at("cpu_seconds").at(record.at("method") == kInitial ? "generate" : "total").get<double>(),
                     divergence_text(record), left);
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

void require_known(const RunOptions& options, const MethodRegistry& registry) {
  if (options.repeats < 1) throw InvalidOption(fmt::format("--repeats: expected at least 1, got {}", options.repeats));
  for (const std::string& method : options.methods)
    if (method != kInitial) static_cast<void>(registry.find(find_method_case(method).method));  // throws where there is none
}

}  // namespace

std::size_t RunSummary::count(CaseStatus status) const {
  return static_cast<std::size_t>(std::count_if(cases.begin(), cases.end(), [&](const CaseOutcome& c) { return c.status == status; }));
}

RunSummary run_cases(const RunOptions& options, const MethodRegistry& registry, const RunObserver& observer) {
  require_known(options, registry);
  Workload work(options);
  const ProgressCallback progress = [&](std::string_view, double) {
    return !observer.progress || observer.progress("experiments", work.fraction());
  };
  RunSummary summary;
  for (const Dataset& dataset : options.datasets) {
    SharedMeshes meshes(dataset, options.repeats, progress);
    for (const std::string& method : options.methods) {
      report_progress(progress, "", 0);
      const Json record = record_case(options, registry, dataset, method, meshes, progress);
      write_record(options.directory, record);
      work.finish(dataset);
      summary.cases.push_back(outcome_of(record));
      if (observer.line) observer.line(case_line(record, work));
    }
  }
  summary.seconds = work.seconds();
  return summary;
}

}  // namespace smopt::experiments
