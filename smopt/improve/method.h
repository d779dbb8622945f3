#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "smopt/improve/cavities.h"
#include "smopt/improve/remesh/remesh.h"
#include "smopt/improve/smoothing.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"
#include "smopt/timing.h"

namespace smopt {

/// One option of a method, as the program, the experiments and the documentation show it.
struct MethodOption {
  enum class Kind { integer, number, choice, text };

  std::string name;  ///< as on the command line, without the dashes
  Kind kind = Kind::text;
  std::string default_value;  ///< the only place where the default is written
  std::string unit;           ///< empty where there is none
  std::string help;
  std::vector<std::string> choices;  ///< for Kind::choice
};

/// The values of a method's options by name, defaults filled in.
class OptionValues {
 public:
  OptionValues() = default;
  /// \throws InvalidOption for a name that is none of the options, a value of the wrong kind or a choice that is none.
  OptionValues(const std::vector<MethodOption>& options, const std::map<std::string, std::string>& given);

  /// \throws InvalidOption when the value is no whole number (number) of at least `at_least`.
  [[nodiscard]] int integer(const std::string& name, int at_least) const;
  [[nodiscard]] double number(const std::string& name, double at_least) const;
  [[nodiscard]] const std::string& text(const std::string& name) const;
  [[nodiscard]] const std::map<std::string, std::string>& all() const { return values_; }

 private:
  std::map<std::string, std::string> values_;
};

/// What a method reports, whichever it is.
struct MethodReport {
  std::size_t redundant_valence3 = 0;
  std::size_t redundant_valence4 = 0;
  std::size_t rounds_run = 0;
  std::vector<RoundReport> rounds;  ///< each; empty where all are alike or the method does not say
  MoveCounts moves;
  std::size_t stuck = 0;
  double volume_before = 0;  ///< enclosed before smoothing, Å³; both 0 where a method does not say
  double volume_after = 0;
  std::map<std::string, OperationCounts> operations;  ///< that change connectivity, by their names; empty where there are none
  std::vector<GoalOutcome> goals;                     ///< of methods that have goals
  /// Two-sided distance of input and output, Å: proved to lie between these bounds.
  struct Deviation {
    double lower = 0;
    double upper = 0;
  };
  std::optional<Deviation> deviation;  ///< where a bound was asked for
  std::string stopped_because;
  std::optional<int> diverged_at_step;  ///< the first step (from 1) after which a coordinate was out of bounds (`DivergenceWatch`)
  std::vector<std::string> notes;       ///< what the user of the result should know, a sentence each
  StageTimes seconds;                   ///< at least "smoothing"
};

/// One way of improving a mesh.
struct Method {
  std::string name;
  std::string summary;  ///< one line
  std::string source;   ///< where it comes from, with the year
  CavityPolicy default_cavities = CavityPolicy::keep;
  std::vector<MethodOption> options;
  /// Improves a mesh that `prepare` has passed. \throws InvalidOption; MethodFailed; Cancelled.
  std::function<MethodReport(TriangleMesh&, const OptionValues&, const ProgressCallback&)> run;
  std::string note = {};  ///< where it departs from its source, or what is missing here; empty where there is nothing to say
};

/// The methods by name, in the order in which they were added.
class MethodRegistry {
 public:
  void add(Method method) { methods_.push_back(std::move(method)); }
  [[nodiscard]] const std::vector<Method>& all() const { return methods_; }
  /// \throws InvalidOption that lists the names when there is no such method.
  [[nodiscard]] const Method& find(std::string_view name) const;

 private:
  std::vector<Method> methods_;
};

/// Add `smopt` and `smopt2`.
void register_smopt(MethodRegistry& registry);
void register_smopt2(MethodRegistry& registry);

/// "delete", "keep" or "main". \throws InvalidOption for anything else.
CavityPolicy parse_cavity_policy(std::string_view text);
std::string_view to_string(CavityPolicy policy);

}  // namespace smopt
