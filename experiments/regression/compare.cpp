#include "experiments/regression/compare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace smopt::experiments {
namespace {

using Json = RecordSet::Json;

/// A case's two records.
struct Pair {
  CaseName of;
  const Json& reference;
  const Json& now;
  bool has_same_options = true;
};

/// How a value stands against the reference's.
enum class Standing { within, worse, better, incomparable };

/// By how much a number is worse than the reference's, in its unit; negative: better.
double loss(const Tolerance& tolerance, double reference, double now) {
  switch (tolerance.direction) {
    case Direction::lower:
      return now - reference;
    case Direction::higher:
      return reference - now;
    case Direction::nearer:
      return std::abs(now - tolerance.target) - std::abs(reference - tolerance.target);
    case Direction::equal:
    case Direction::ranked:
      break;
  }
  return std::abs(now - reference);
}

Standing standing_of_numbers(const Tolerance& tolerance, double reference, double now) {
  const double room = slack(tolerance, reference), lost = loss(tolerance, reference, now);
  if (lost > room) return Standing::worse;
  return lost < -room ? Standing::better : Standing::within;
}

/// A word's place in the order, from 0; all that are not listed share the last.
std::size_t rank_of(const Tolerance& tolerance, const std::string& word) {
  return static_cast<std::size_t>(std::find(tolerance.best_first.begin(), tolerance.best_first.end(), word) - tolerance.best_first.begin());
}

bool is_not_asked(const Tolerance& tolerance, const std::string& word) {
  return std::find(tolerance.not_asked.begin(), tolerance.not_asked.end(), word) != tolerance.not_asked.end();
}

Standing standing_of_words(const Tolerance& tolerance, const std::string& reference, const std::string& now) {
  if (reference != now && (is_not_asked(tolerance, reference) || is_not_asked(tolerance, now))) return Standing::incomparable;
  const std::size_t before = rank_of(tolerance, reference), after = rank_of(tolerance, now);
  if (before == after) return Standing::within;
  return after > before ? Standing::worse : Standing::better;
}

/// A value that was there and is gone is worse, one that has come is better.
Standing standing_of(const Tolerance& tolerance, const RecordValue& reference, const RecordValue& now) {
  const bool was_there = !std::holds_alternative<std::monostate>(reference), is_there = !std::holds_alternative<std::monostate>(now);
  if (was_there != is_there) return was_there ? Standing::worse : Standing::better;
  if (!was_there) return Standing::within;
  const auto *const number_before = std::get_if<double>(&reference), *const number_now = std::get_if<double>(&now);
  if (number_before != nullptr && number_now != nullptr) return standing_of_numbers(tolerance, *number_before, *number_now);
  const auto *const word_before = std::get_if<std::string>(&reference), *const word_now = std::get_if<std::string>(&now);
  if (word_before != nullptr && word_now != nullptr) return standing_of_words(tolerance, *word_before, *word_now);
  return Standing::incomparable;
}

/// What stands beside a status in the record: "/tetgen/p/reason" for "/tetgen/p/status" and "reason".
std::string beside(const std::string& pointer, const char* key) {
  return fmt::format("{}/{}", pointer.substr(0, pointer.rfind('/')), key);
}

std::string reason_beside(const Json& record, const std::string& pointer) {
  return text_at(&record, beside(pointer, "reason")).value_or("");
}

bool meets_condition(const Tolerance& tolerance, const Json& record) {
  return tolerance.condition_pointer.empty() || text_at(&record, tolerance.condition_pointer) == tolerance.condition_text;
}

double slack_of(const Tolerance& tolerance, const RecordValue& reference) {
  const auto* const number = std::get_if<double>(&reference);
  return number != nullptr ? slack(tolerance, *number) : 0;
}

Difference difference_of(const Pair& pair, const Tolerance& tolerance, RecordValue reference, RecordValue now) {
  const double room = slack_of(tolerance, reference);
  const std::string reason = tolerance.direction == Direction::ranked ? reason_beside(pair.now, tolerance.pointer) : "";
  return {pair.of, tolerance.quantity, tolerance.unit, std::move(reference), std::move(now), room, reason, tolerance.why};
}

std::string with_reason(const std::string& text, const std::string& reason) {
  return reason.empty() ? text : fmt::format("{} ({})", text, reason);
}

double seconds_beside(const Json& record, const std::string& pointer) {
  return number_at(&record, beside(pointer, "seconds")).value_or(0);
}

/// Whether a limit on time may have decided by how fast the machine is: the reference came near it.
bool is_slow_machine(const Tolerance& tolerance, const Json& reference, const Json& now) {
  constexpr double kNear = 0.1;  // of the time that it took until the limit
  return !tolerance.limited_by.empty() && reason_beside(now, tolerance.pointer).starts_with(tolerance.limited_by) &&
         seconds_beside(reference, tolerance.pointer) >= kNear * seconds_beside(now, tolerance.pointer);
}

/// Compares the records of cases one by one and collects what it finds.
class Comparer {
 public:
  Comparer(const std::vector<Tolerance>& tolerances, Comparison& result) : tolerances_(tolerances), result_(result) {}

  void compare_case(Pair pair) {
    result_.compared.push_back(pair.of);
    pair.has_same_options = tell_changes(pair);
    if (!compare_status(pair)) return;
    const CaseKey key = {pair.of.molecule, pair.of.method, text_at(&pair.reference, "/registered_method").value_or(pair.of.method)};
    for (const Tolerance* tolerance : tolerances_for(tolerances_, key))
      if (meets_condition(*tolerance, pair.reference) && meets_condition(*tolerance, pair.now)) compare_quantity(pair, *tolerance);
  }

 private:
  /// What the two were given, where it is not the same; whether the options are.
  bool tell_changes(const Pair& pair) {
    constexpr std::array<std::pair<const char*, const char*>, 2> kDigests = {
        {{"/molecule/sha256", "the molecule's file"}, {"/input/sha256", "the mesh that the method was given"}}};
    for (const auto& [pointer, name] : kDigests)
      if (text_at(&pair.reference, pointer) != text_at(&pair.now, pointer)) remark_changed(pair, fmt::format("{} is another one", name));
    for (const char* key : {"decay_per_A2", "isovalue", "spacing_A", "error_A"})
      tell_change(pair, fmt::format("the surface's {}", key), fmt::format("/surface/{}", key));
    const std::size_t before = result_.changed.size();
    for (const std::string& option : option_names(pair)) tell_change(pair, fmt::format("--{}", option), fmt::format("/options/{}", option));
    return result_.changed.size() == before;
  }

  static std::vector<std::string> option_names(const Pair& pair) {
    std::vector<std::string> names;
    for (const Json* record : {&pair.reference, &pair.now})
      if (record->contains("options"))
        for (const auto& [name, value] : record->at("options").items())
          if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    return names;
  }

  void tell_change(const Pair& pair, const std::string& name, const std::string& pointer) {
    const Json::json_pointer path(pointer);
    const Json before = pair.reference.contains(path) ? pair.reference.at(path) : Json(),
               now = pair.now.contains(path) ? pair.now.at(path) : Json();
    if (before != now) remark_changed(pair, fmt::format("{}: {} → {}", name, before.dump(), now.dump()));
  }

  void remark_changed(const Pair& pair, std::string text) { result_.changed.push_back({pair.of, std::move(text)}); }

  /// Whether both are done, so that there is more to compare.
  bool compare_status(const Pair& pair) {
    static const Tolerance kStatus = [] {
      Tolerance status;
      status.quantity = "case";
      status.pointer = "/status";
      status.direction = Direction::ranked;
      status.best_first = {"done"};
      status.not_asked = {"not installed"};
      status.why = "a case that was done must be done again";
      return status;
    }();
    compare_quantity(pair, kStatus);
    return is_done(&pair.reference) && is_done(&pair.now);
  }

  void compare_quantity(const Pair& pair, const Tolerance& tolerance) {
    RecordValue reference = value_of(pair.reference, tolerance), now = value_of(pair.now, tolerance);
    const Standing standing = standing_of(tolerance, reference, now);
    if (standing == Standing::incomparable || (standing == Standing::worse && is_slow_machine(tolerance, pair.reference, pair.now))) {
      remark_not_compared(pair, tolerance, reference, now);
      return;
    }
    if (!std::holds_alternative<std::monostate>(reference)) ++result_.values;
    if (standing == Standing::within) return;
    const bool gates = tolerance.gates && (pair.has_same_options || !tolerance.needs_same_options);
    std::vector<Difference>& list = !gates ? result_.shown : standing == Standing::worse ? result_.worse : result_.better;
    list.push_back(difference_of(pair, tolerance, std::move(reference), std::move(now)));
  }

  void remark_not_compared(const Pair& pair, const Tolerance& tolerance, const RecordValue& reference, const RecordValue& now) {
    result_.not_compared.push_back(
        {pair.of, fmt::format("{}: {} → {}", tolerance.quantity,
                              with_reason(text_of(reference, tolerance.unit), reason_beside(pair.reference, tolerance.pointer)),
                              with_reason(text_of(now, tolerance.unit), reason_beside(pair.now, tolerance.pointer)))});
  }

  const std::vector<Tolerance>& tolerances_;
  Comparison& result_;
};

/// The cases of `records`, molecule by molecule.
std::vector<CaseName> cases_of(const RecordSet& records) {
  std::vector<CaseName> cases;
  const std::vector<std::string> methods = records.methods();
  for (const std::string& molecule : records.molecules())
    for (const std::string& method : methods)
      if (records.find(molecule, method) != nullptr) cases.push_back({molecule, method});
  return cases;
}

}  // namespace

Comparison compare(const RecordSet& run, const RecordSet& reference, const std::vector<Tolerance>& tolerances) {
  Comparison result;
  Comparer comparer(tolerances, result);
  for (const CaseName& name : cases_of(reference)) {
    const Json* const now = run.find(name.molecule, name.method);
    if (now == nullptr)
      result.only_in_reference.push_back(name);
    else
      comparer.compare_case({name, *reference.find(name.molecule, name.method), *now});
  }
  for (const CaseName& name : cases_of(run))
    if (reference.find(name.molecule, name.method) == nullptr) result.only_in_run.push_back(name);
  return result;
}

bool is_red(const Comparison& comparison, bool complete) {
  return !comparison.worse.empty() || (complete && !comparison.only_in_reference.empty());
}

}  // namespace smopt::experiments
