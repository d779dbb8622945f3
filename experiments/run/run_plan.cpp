#include "experiments/run/run_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "baselines/baselines.h"
#include "experiments/run_layout.h"
#include "experiments/tetgen_trials.h"
#include "smopt/error.h"
#include "smopt/io/file.h"

namespace smopt::experiments {
namespace {

namespace fs = std::filesystem;

constexpr int kTimedThreads = 1;  ///< Table 2 counts seconds on one processor, as the paper's does

/// What a step takes, MB: so much, and so many times its input meshes (50 bytes a vertex as PLY). Measured on the AChE monomer and connexin, rounded up.
struct MemoryUse {
  double base_mb, per_input;
};
constexpr MemoryUse kLightMemory{100, 8};
constexpr MemoryUse kImproveMemory{150, 40};  // CGAL's remeshing; smopt takes a quarter of it
constexpr MemoryUse kMeasureMemory{200, 30};
constexpr MemoryUse kTetgenMemory{200, 110};   // 1.3 million vertices: 6.5 GB, this program's checks included
constexpr MemoryUse kQualityMemory{200, 210};  // tetrahedra of bounded shape: all the 12 GB that it may have
constexpr MemoryUse kSolveMemory{300, 110};    // 830 000 vertices that take 100 iterations: 4.4 GB

/// How long steps take beside each other on one molecule, roughly: for the time left alone.
constexpr double kShortWeight = 1, kImproveWeight = 4, kMeasureWeight = 4, kTetgenWeight = 10, kQualityWeight = 40, kSolveWeight = 40;

/// A PDB file ($0), unpacked ($1), becomes a molecule with charges and radii ($2), without crystal water.
constexpr const char* kPrepare =
    R"(command -v pdb2pqr > /dev/null || { echo "not installed: pdb2pqr, which prepares PDB files" >&2; exit 1; }
gzip -cdf "$0" > "$1" && pdb2pqr --ff=AMBER --nodebump --noopt --drop-water "$1" "$2.beside" && mv "$2.beside" "$2")";

/// The steps of one molecule.
class MoleculePlanner {
 public:
  MoleculePlanner(RunPlan& plan, const Dataset& dataset) : plan_(plan), options_(plan.options), dataset_(dataset) {}

  void add_all() {
    add_molecule();
    add_surface();
    for (const MethodCase& method_case : options_.cases) add_case(method_case);
  }

 private:
  [[nodiscard]] std::string id(std::string_view subject, std::string_view rule) const {
    return fmt::format("{}/{}.{}", dataset_.name, subject, rule);
  }
  [[nodiscard]] std::string mesh_of(std::string_view subject) const { return fmt::format("steps/{}/{}.ply", dataset_.name, subject); }

  Step step(std::string_view subject, const std::string& rule, const std::string& suffix, const MemoryUse& memory, double weight) const {
    Step step;
    step.id = id(subject, rule + suffix);
    step.rule = rule;
    step.molecule = dataset_.name;
    step.subject = subject;
    step.needs.memory_base_mb = memory.base_mb;
    step.needs.memory_per_input = memory.per_input;
    step.needs.weight = weight;
    if (!dataset_.package.empty()) step.hint = fmt::format("the Debian package {} brings it", dataset_.package);
    step.limits = {options_.step_seconds, options_.step_memory_mb};
    return step;
  }

  std::string add(Step step) {
    const std::string id = step.id;
    plan_.steps.push_back(std::move(step));
    return id;
  }

  static std::string report_of(const std::string& id) { return "steps/" + id + ".json"; }

  /// Command, report and program's part of a step that this program does.
  static void command(Step& step, std::vector<std::string> words, int threads) {
    step.command = {kThisProgram};
    step.command.insert(step.command.end(), words.begin(), words.end());
    for (const std::string& word : {std::string("--report"), report_of(step.id), std::string("--quiet")}) step.command.push_back(word);
    if (threads > 0) {
      step.command.insert(step.command.end(), {"--threads", fmt::format("{}", threads)});
    }
    step.needs.threads = std::max(threads, 1);
    step.outputs.push_back(report_of(step.id));
  }

  [[nodiscard]] bool has_molecule() const { return !dataset_.path.empty(); }

  /// A PDB file is prepared where its entry says so; all others are read as they are.
  void add_molecule() {
    molecule_ = dataset_.path.empty() ? "" : fs::absolute(dataset_.path).string();
    if (!dataset_.is_prepared_by_pdb2pqr) return;
    Step prepare = step("molecule", "prepare", "", kLightMemory, kImproveWeight);
    const std::string unpacked = fmt::format("steps/{}/molecule.{}", dataset_.name, format_ending(dataset_.path));
    const std::string pqr = fmt::format("steps/{}/molecule.pqr", dataset_.name);
    prepare.command = {"/bin/sh", "-c", kPrepare, molecule_, unpacked, pqr};
    prepare.inputs = {molecule_};
    prepare.outputs = {pqr};
    molecule_ = pqr;
    prepared_ = add(std::move(prepare));
  }

  [[nodiscard]] std::vector<std::string> after_molecule() const {
    return prepared_.empty() ? std::vector<std::string>() : std::vector<std::string>{prepared_};
  }

  void add_surface() {
    Step generate = step(kInitial, "generate", "", kLightMemory, kShortWeight);
    generate.needs.is_alone = true;
    const std::string mesh = mesh_of(kInitial);
    generate.outputs = {mesh};
    generate.after = after_molecule();
    if (dataset_.mesh.empty()) {
      command(generate,
              {"generate", molecule_, "-o", mesh, "--decay", fmt::format("{}", dataset_.surface.decay), "--isovalue",
               fmt::format("{}", dataset_.surface.isovalue), "--spacing", fmt::format("{}", dataset_.surface.spacing), "--repeats",
               fmt::format("{}", options_.repeats)},
              kTimedThreads);
      generate.inputs = {molecule_};
    } else {
      const std::string file = fs::absolute(dataset_.mesh).string();
      generate.command = {kThisProgram, "convert", file, mesh, "--quiet"};
      generate.inputs = {file};
      generate.hint.clear();  // no package brings it
    }
    generate_ = add(std::move(generate));
    Step prepare = step(kWithoutCavities, "improve", "", kLightMemory, kShortWeight);
    prepare.outputs = {mesh_of(kWithoutCavities)};
    command(prepare,
            {"improve", mesh, "-o", mesh_of(kWithoutCavities), "--method", "smopt", "--rounds", "0", "--redundant", "keep", "--cavities",
             "delete"},
            kTimedThreads);
    prepare.inputs = {mesh};
    prepare.after = {generate_};
    input_ = add(std::move(prepare));
    measure_input_ = add_measure(kWithoutCavities, input_);
  }

  std::string add_measure(std::string_view subject, const std::string& after) {
    Step measure = step(subject, "measure", "", kMeasureMemory, kMeasureWeight);
    std::vector<std::string> words = {"measure", mesh_of(subject)};
    measure.inputs = {mesh_of(subject)};
    measure.after = {after};
    if (options_.simulates && has_molecule()) {
      words.insert(words.end(), {"--molecule", molecule_, "--decay", fmt::format("{}", dataset_.surface.decay), "--isovalue",
                                 fmt::format("{}", dataset_.surface.isovalue)});
      measure.inputs.push_back(molecule_);
    }
    command(measure, std::move(words), 1);
    return add(std::move(measure));
  }

  /// \return the step that improves the initial mesh by the method; made once, as another case may ask for as many vertices as it leaves.
  std::string improve(const MethodCase& method_case) {
    if (const auto made = improved_.find(method_case.name); made != improved_.end()) return made->second;
    Step improve = step(method_case.name, "improve", "", kImproveMemory, kImproveWeight);
    improve.needs.is_alone = method_case.is_timed;
    improve.inputs = {mesh_of(kInitial)};
    improve.after = {generate_};
    improve.outputs = {mesh_of(method_case.name)};
    std::vector<std::string> words = {
        "improve",    mesh_of(kInitial),    "-o",        mesh_of(method_case.name),          "--method", method_case.method,
        "--cavities", method_case.cavities, "--repeats", fmt::format("{}", options_.repeats)};
    for (const auto& [name, value] : method_case.options) words.insert(words.end(), {"--" + name, value});
    if (!method_case.vertices_of.empty()) {
      const MethodCase other = case_of_name(method_case.vertices_of);
      improve.after.push_back(this->improve(other));
      improve.inputs.push_back(mesh_of(other.name));
      words.insert(words.end(), {"--match", mesh_of(other.name)});
    }
    command(improve, std::move(words), kTimedThreads);
    return improved_[method_case.name] = add(std::move(improve));
  }

  [[nodiscard]] MethodCase case_of_name(const std::string& name) const {
    const auto found = std::ranges::find(options_.cases, name, &MethodCase::name);
    return found == options_.cases.end() ? find_method_case(name) : *found;
  }

  std::string add_tetrahedralize(const std::string& subject, const std::string& after, const TetgenTrial& trial) {
    const bool is_quality = trial.switches == kQualitySwitches;
    Step tetrahedralize = step(subject, "tetrahedralize", "-" + trial.switches, is_quality ? kQualityMemory : kTetgenMemory,
                               is_quality ? kQualityWeight : kTetgenWeight);
    command(tetrahedralize,
            {"tetrahedralize", mesh_of(subject), "--switches", trial.switches, "--time-limit", fmt::format("{}", trial.time_limit_seconds),
             "--max-memory", fmt::format("{}", options_.step_memory_mb)},
            1);
    tetrahedralize.inputs = {mesh_of(subject)};
    tetrahedralize.after = {after};
    tetrahedralize.may_say_no = true;
    return add(std::move(tetrahedralize));
  }

  std::string add_solvate(const std::string& subject, const std::string& after) {
    Step solvate = step(subject, "solvate", "", kSolveMemory, kSolveWeight);
    command(solvate, {"solvate", mesh_of(subject), molecule_, "--max-memory", fmt::format("{}", options_.solvation.max_memory_bytes)}, 0);
    solvate.inputs = {mesh_of(subject), molecule_};
    solvate.after = {after};
    solvate.may_say_no = true;
    solvate.needs.threads = kAllThreads;
    solvate.limits.memory_mb = 0;  // it predicts what it takes
    return add(std::move(solvate));
  }

  void add_case(const MethodCase& method_case) {
    CasePlan planned;
    planned.dataset = dataset_;
    planned.method_case = method_case;
    planned.generate = generate_;
    const bool is_initial = method_case.name == kInitial;
    if (!is_initial) {
      planned.improve = improve(method_case);
      if (!method_case.vertices_of.empty()) planned.matched = improved_.at(method_case.vertices_of);
      planned.input = input_;
      planned.measure_input = measure_input_;
    }
    const std::string& made_by = is_initial ? generate_ : planned.improve;
    planned.measure = add_measure(method_case.name, made_by);
    if (options_.simulates) add_simulations(planned, made_by);
    add_record(planned);
    plan_.cases.push_back(std::move(planned));
  }

  void add_simulations(CasePlan& planned, const std::string& made_by) {
    const std::string& subject = planned.method_case.name;
    for (const TetgenTrial& trial : tetgen_trials(subject))
      planned.tetrahedralize[trial.switches] = add_tetrahedralize(subject, made_by, trial);
    planned.why_no_solvation = why_no_solvation(dataset_, subject, options_.solvation);
    if (planned.why_no_solvation.empty()) planned.solvate = add_solvate(subject, made_by);
  }

  void add_record(CasePlan& planned) {
    Step record = step(planned.method_case.name, "record", "", kLightMemory, 0);
    for (const std::string* id : {&planned.generate, &planned.improve, &planned.measure, &planned.measure_input, &planned.solvate})
      if (!id->empty()) record.after.push_back(*id);
    for (const auto& [switches, id] : planned.tetrahedralize) record.after.push_back(id);
    record.outputs = {record_path("", dataset_.name, planned.method_case.name).string()};
    planned.record = add(std::move(record));
  }

  RunPlan& plan_;
  const PlanOptions& options_;
  const Dataset& dataset_;
  std::string molecule_;  ///< the file that surfaces are made of; empty where there is none
  std::string prepared_, generate_, input_, measure_input_;
  std::map<std::string, std::string> improved_;
};

void require_known(const PlanOptions& options) {
  if (options.repeats < 1) throw InvalidOption(fmt::format("--repeats: expected at least 1, got {}", options.repeats));
  for (const MethodCase& method_case : options.cases) {
    if (method_case.name == kInitial) continue;
    const Method& method = baselines::all_methods().find(method_case.method);  // throws where there is none
    static_cast<void>(OptionValues(method.options, method_case.options));      // throws where they do not fit
  }
}

}  // namespace

MethodCase initial_case() {
  return find_method_case(kInitial);
}

const Step& RunPlan::step(const std::string& id) const {
  const auto found = std::ranges::find(steps, id, &Step::id);
  if (found == steps.end()) throw InvalidOption(fmt::format("no step '{}' in the plan", id));
  return *found;
}

const CasePlan& RunPlan::recorded_by(const Step& step) const {
  return *std::ranges::find(cases, step.id, &CasePlan::record);
}

RunPlan make_plan(PlanOptions options) {
  require_known(options);
  RunPlan plan;
  plan.options = std::move(options);
  for (const Dataset& dataset : plan.options.datasets) MoleculePlanner(plan, dataset).add_all();
  return plan;
}

}  // namespace smopt::experiments
