#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace smopt::experiments {

/// Which way a quantity of a record gets better.
enum class Direction {
  lower,
  higher,
  equal,   ///< any change is for the worse
  nearer,  ///< to a value
  ranked   ///< a word: those of a list, the best first, then any other
};

/// What a quantity of a record may lose against the reference, for some cases. One entry of tolerances.json gives one for each quantity that it
/// names.
struct Tolerance {
  std::string quantity;                    ///< a metric of the judge's registry, or a name of its own
  std::string pointer;                     ///< where it stands in a record: "/metrics/after/angle_deg/min"
  std::string unit;                        ///< as in the registry of metrics; "change" for a share of the value at `change_from`
  Direction direction = Direction::equal;  ///< of a metric: the registry's
  double target = 0;                       ///< for `nearer`
  std::vector<std::string> best_first;     ///< for `ranked`
  std::vector<std::string> not_asked;      ///< words that say that there is nothing to compare
  std::string limited_by;                  ///< how a reason begins that may tell of the machine and not of the mesh; empty: none does
  std::string change_from;                 ///< the quantity is the relative change from the value there; empty: the value itself
  double absolute = 0;                     ///< in the quantity's unit
  double relative = 0;                     ///< of the reference's value
  std::vector<std::string> methods;        ///< names of cases or of registered methods; empty: all
  std::vector<std::string> molecules;      ///< empty: all
  std::string condition_pointer, condition_text;  ///< compared where both records have this text there; empty: everywhere
  bool needs_same_options = false;                ///< between other options it is shown and never red
  bool gates = true;                              ///< false: shown, never red
  std::string why;
};

/// What the reference's value may get worse by: the larger of the absolute tolerance and the relative one.
double slack(const Tolerance& tolerance, double reference);

/// Reads a text of the form of tolerances.json (its "about" says what that is). \throws InvalidInput naming `source` and the entry.
std::vector<Tolerance> parse_tolerances(std::string_view json, std::string_view source);

/// Those of tolerances.json.
const std::vector<Tolerance>& default_tolerances();

/// Whose record is compared.
struct CaseKey {
  std::string molecule;
  std::string method;
  std::string registered_method;  ///< "iso2mesh" of the case "iso2mesh-hc"
};

/// For each quantity the first tolerance whose scope the case is in.
std::vector<const Tolerance*> tolerances_for(const std::vector<Tolerance>& tolerances, const CaseKey& key);

}  // namespace smopt::experiments
