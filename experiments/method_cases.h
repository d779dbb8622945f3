#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace smopt::experiments {

/// The pseudo-method: the mesh as it was generated.
inline constexpr std::string_view kInitial = "initial";

/// The mesh that the methods get: the initial one without its cavities. No case; a run has its mesh by this name.
inline constexpr std::string_view kWithoutCavities = "without-cavities";

/// The cases of this project's own methods.
inline constexpr std::string_view kSmopt = "smopt";
inline constexpr std::string_view kSmopt2 = "smopt2";

/// A method as the experiments run it: with which options, and what it is called.
struct MethodCase {
  std::string name;                            ///< as on the command line and in file names
  std::string title;                           ///< as in tables and figures
  std::string method;                          ///< its name in the registry of methods
  std::map<std::string, std::string> options;  ///< those that are not the method's defaults
  std::string vertices_of;                     ///< the case as many vertices as whose result are asked for; empty: none is
  std::string cavities = "delete";             ///< as `smopt improve --cavities`
  bool is_timed = false;                       ///< its time is in a table, so that it runs alone
  bool is_in_paper_tables = false;             ///< shown in Table 3 and Figures 5 to 7, which are the paper's
  bool is_ablation = false;                    ///< run when it is named, not with "all": a method with a part of it left out
};

/// The cases of methods.json, in its order, which is that of tables and figures.
const std::vector<MethodCase>& all_method_cases();

/// What "all" means: the initial mesh, and every case of methods.json but the ablations.
std::vector<std::string> all_compared_methods();

/// Reads a text of the form of methods.json. \throws InvalidInput saying which entry is wrong.
std::vector<MethodCase> parse_method_cases(std::string_view json);

/// An entry of the form of methods.json that `parse_method_cases` reads back.
nlohmann::ordered_json to_json(const MethodCase& method_case);

/// The case of this name; for another name the registered method of that name with its defaults (which need not be there).
MethodCase find_method_case(std::string_view name);

}  // namespace smopt::experiments
