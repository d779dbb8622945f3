#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace smopt::experiments {

/// One setting of a factor.
struct Level {
  std::string name;                            ///< as in file names
  std::string title;                           ///< as in tables and figures; the name, with the factor's unit, where none is given
  std::map<std::string, std::string> options;  ///< of the method
  std::string cavities;                        ///< as `smopt improve --cavities`; empty: as the default
  std::optional<double> value;                 ///< the number that the name is, if it is one
};

/// A part of the method that can be set otherwise.
struct Factor {
  std::string name;
  std::string title;
  std::string about;  ///< what it does, in a few words
  std::string unit;   ///< of levels that are numbers; empty where there is none
  std::vector<Level> levels;
  std::size_t default_level = 0;
};

/// A factor that a design varies, and the levels that it gives it (places in AblationPlan::factors and Factor::levels).
struct VariedFactor {
  std::size_t factor = 0;
  std::vector<std::size_t> levels;
};

/// What is varied of which method, in which designs.
struct AblationPlan {
  std::string method;  ///< its name in the registry
  std::vector<std::string> molecules;
  std::vector<Factor> factors;
  std::vector<VariedFactor> one_at_a_time;
  std::vector<VariedFactor> factorial;
  std::vector<VariedFactor> thresholds;  ///< two factors whose levels are numbers: the axes of the grid, x and y
};

/// The plan of ablation.json, and its quick one: fewer levels of fewer factors.
const AblationPlan& ablation_plan(bool is_quick);

/// Reads a text of the form of ablation.json. \throws InvalidInput naming the entry that is wrong: unknown keys of the method, values that are
/// none of its options', a default level that is not the method's default, two factors of a design that set the same option, a name twice.
AblationPlan parse_ablation_plan(std::string_view json, bool is_quick);

}  // namespace smopt::experiments
