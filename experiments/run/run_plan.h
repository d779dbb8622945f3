#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/datasets.h"
#include "experiments/method_cases.h"
#include "experiments/run/step.h"
#include "experiments/solvation_plan.h"

namespace smopt::experiments {

/// What a run is asked for: the cases, and what is done with each. Nothing here depends on the machine.
struct PlanOptions {
  std::vector<Dataset> datasets;
  std::vector<MethodCase> cases;  ///< the initial mesh among them: `initial_case()`
  int repeats = 1;                ///< of everything that is timed; ≥ 1
  bool simulates = true;          ///< TetGen, solvation, and the distance to the level set
  SolvationSettings solvation;
  double step_seconds = 1800;             ///< after which any step is ended
  std::size_t step_memory_mb = 12 << 10;  ///< address space that any step may take
};

/// The steps that one case's record is made of, by their ids; empty where there is no such step.
struct CasePlan {
  Dataset dataset;
  MethodCase method_case;
  std::string generate, improve, measure;
  std::string input, measure_input;                   ///< of the mesh without cavities
  std::string matched;                                ///< of the case that the number of vertices is taken from
  std::map<std::string, std::string> tetrahedralize;  ///< by TetGen's switches
  std::string solvate;
  std::string why_no_solvation;  ///< in words, where there is no `solvate`
  std::string record;
};

/// All steps of a run, each after those it needs.
struct RunPlan {
  PlanOptions options;
  std::vector<CasePlan> cases;  ///< molecule by molecule
  std::vector<Step> steps;

  /// \throws InvalidOption when there is none.
  [[nodiscard]] const Step& step(const std::string& id) const;
  /// The case that a step of the rule "record" records.
  [[nodiscard]] const CasePlan& recorded_by(const Step& step) const;
};

/// The pseudo-case of the mesh as it was generated.
MethodCase initial_case();

/// For each molecule: its file prepared, its surface generated, the cavities deleted, then each case improved, measured, given to TetGen and to the
/// solver, and recorded. \throws InvalidOption for a method that the registry does not have, or options that it does not take.
RunPlan make_plan(PlanOptions options);

/// plan.json: the options and the steps, for programs that run them elsewhere.
nlohmann::ordered_json to_json(const RunPlan& plan);

/// The plan of the options in a text that `to_json` made. \throws InvalidInput naming `source`.
RunPlan parse_plan(const std::string& text, const std::string& source);

}  // namespace smopt::experiments
