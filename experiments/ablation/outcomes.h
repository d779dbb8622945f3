#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/ablation/design.h"
#include "experiments/ablation/effects.h"
#include "experiments/ablation/quantities.h"
#include "experiments/record_set.h"

namespace smopt::experiments {

/// What became of the cases of one molecule.
class Outcomes {
 public:
  Outcomes(const RecordSet& records, std::string molecule);

  [[nodiscard]] const std::string& title() const { return title_; }  ///< the molecule's
  /// Of a case; nothing when it was not run, failed, or has no such number.
  [[nodiscard]] std::optional<double> value(const Quantity& quantity, std::string_view name) const;
  /// Of the initial mesh without its cavities, which changes are held against.
  [[nodiscard]] std::optional<double> given(const Quantity& quantity) const;
  /// How a case ended: the reason why it stopped, "failed: …", "not run".
  [[nodiscard]] std::string ending(std::string_view name) const;
  [[nodiscard]] bool is_done(std::string_view name) const;
  /// Why a case has no such number, in a word or two: "failed", "not run", "not counted", "none"; empty where it has.
  [[nodiscard]] std::string why_no_value(const Quantity& quantity, std::string_view name) const;

 private:
  const RecordSet* records_;
  std::string molecule_;
  std::string title_;
  const RecordSet::Json* given_ = nullptr;  ///< its metrics
};

/// Those of every molecule of the records, in their order.
std::vector<Outcomes> outcomes_of(const RecordSet& records);

/// The smallest and the largest value of some cases; nothing where none has one.
std::optional<std::pair<double, double>> range_over(const Quantity& quantity, const Outcomes& outcomes,
                                                    const std::vector<DesignCase>& cases);

/// The effects of a full factorial design's factors on a quantity; of a logarithmic one on its decimal logarithm. Indices are those of `varied`.
std::optional<Effects> effects_on(const Quantity& quantity, const Outcomes& outcomes, const AblationPlan& plan,
                                  const std::vector<VariedFactor>& varied);

/// A level's mean as a value of the quantity: the geometric mean of a logarithmic one.
std::optional<double> level_mean(const Quantity& quantity, const Effects& effects, std::size_t factor, std::size_t level);

}  // namespace smopt::experiments
