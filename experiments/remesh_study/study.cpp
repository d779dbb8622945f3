#include "experiments/remesh_study/study.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/method_cases.h"
#include "experiments/record_set.h"
#include "experiments/remesh_study/study_case.h"
#include "experiments/remesh_study/study_mesh.h"
#include "smopt/error.h"
#include "smopt/io/scratch_folder.h"

namespace smopt::experiments {
namespace {

namespace fs = std::filesystem;

class Study {
 public:
  Study(const RemeshStudyOptions& options, const MethodRegistry& registry, const RemeshStudyLog& tell)
      : options_(options), registry_(registry), tell_(tell) {}

  RemeshStudy run() {
    static_cast<void>(find_datasets(options_.datasets, options_.compared));  // throws where a name is wrong
    for (const Dataset& dataset : options_.datasets) study_molecule(dataset);
    for (const Dataset& dataset : options_.datasets)
      if (dataset.name == kCopied && options_.copied_vertices > 0) study_copies(dataset);
    if (!options_.archive.empty()) study_archive();
    if (!options_.meshes.empty()) study_folder();
    return std::move(study_);
  }

 private:
  void study_molecule(const Dataset& dataset) {
    tell_(fmt::format("{}: the surface", dataset.name));
    study_mesh(dataset, study_.molecules, full_plan(), [&] { return study_mesh_of(dataset); });
  }

  /// For the time: what is asked of one molecule is not asked of its copies.
  void study_copies(Dataset dataset) {
    tell_(fmt::format("{}: copies of the surface", dataset.name));
    StudyPlan plan;
    plan.with_distances = plan.with_tetrahedra = false;
    plan.with_two_threads = true;
    const Dataset copied = dataset;
    dataset.title = "Copies of " + dataset.title;
    dataset.name += "-copies";
    study_mesh(dataset, study_.molecules, plan, [&] { return study_copies_of(copied, options_.copied_vertices); });
  }

  void study_archive() {
    tell_(fmt::format("{}: the choice of meshes", options_.archive.string()));
    const ScratchFolder folder("meshes");
    study_.archive = options_.archive.filename().string();
    unpack_meshes(options_.archive, folder / ".");
    study_candidates(choose_meshes(folder / ".", {}));
  }

  void study_folder() {
    study_.folder = fs::absolute(options_.meshes / ".").lexically_normal().parent_path().filename().string();
    study_candidates(all_meshes(options_.meshes));
  }

  void study_candidates(std::vector<MeshCandidate> candidates) {
    for (MeshCandidate& candidate : candidates) {
      if (candidate.mesh) {
        Dataset dataset;
        dataset.name = dataset.title = candidate.name;
        study_mesh(dataset, study_.ready, full_plan(),
                   [&] { return study_mesh_of(candidate.name, candidate.file, std::move(*candidate.mesh)); });
        candidate.mesh.reset();
      }
      study_.candidates.push_back(std::move(candidate));
    }
  }

  /// Adds the studied method's record; the reason, where there is no mesh to run it on.
  template <class Make>
  void study_mesh(const Dataset& dataset, std::vector<Json>& records, const StudyPlan& plan, const Make& make) {
    std::optional<StudyMesh> mesh;
    Json record = record_header(dataset, options_.method);
    record_outcome(record, [&] { mesh.emplace(make()); });
    if (mesh) record = study_method(*mesh, plan);
    if (mesh && std::ranges::find(options_.compared, dataset.name) != options_.compared.end()) compare(*mesh, record);
    records.push_back(std::move(record));
  }

  /// All that there is to ask of a mesh.
  [[nodiscard]] StudyPlan full_plan() const {
    StudyPlan plan;
    plan.with_quality_tetrahedra = plan.with_two_threads = true;
    plan.with_solvation = options_.with_solvation;
    return plan;
  }

  Json study_method(const StudyMesh& mesh, const StudyPlan& plan) {
    Json record = run_case(mesh, options_.method, plan);
    if (text_at(&record, "/solvation/status").value_or("not computed") == "not computed") return record;
    StudyPlan for_reference;
    for_reference.with_solvation = true;
    const Json reference = run_case(mesh, options_.reference, for_reference);
    record["reference"] = {{"method", options_.reference}, {"solvation", reference.value("solvation", Json())}};
    return record;
  }

  /// Every method, and the studied one with a part left out.
  void compare(const StudyMesh& mesh, const Json& studied) {
    StudyPlan plan;
    plan.vertices = vertices_of(studied);
    study_.compared.push_back(run_case(mesh, std::string(kInitial), plan));
    study_.ablations.push_back(studied);
    for (const MethodCase& method_case : all_method_cases()) {
      if (method_case.name == options_.method)
        study_.compared.push_back(studied);
      else
        (method_case.is_ablation ? study_.ablations : study_.compared).push_back(run_case(mesh, method_case.name, plan));
    }
  }

  Json run_case(const StudyMesh& mesh, const std::string& name, const StudyPlan& plan) {
    tell_(fmt::format("{}: {}", mesh.dataset.name, name));
    return run_study_case(mesh, find_method_case(name), registry_, plan);
  }

  const RemeshStudyOptions& options_;
  const MethodRegistry& registry_;
  const RemeshStudyLog& tell_;
  RemeshStudy study_;
};

}  // namespace

RemeshStudy run_remesh_study(const RemeshStudyOptions& options, const MethodRegistry& registry, const RemeshStudyLog& tell) {
  return Study(options, registry, tell).run();
}

}  // namespace smopt::experiments
