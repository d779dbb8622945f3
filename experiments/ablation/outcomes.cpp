#include "experiments/ablation/outcomes.h"

#include <algorithm>
#include <cmath>

#include "experiments/datasets.h"

namespace smopt::experiments {
namespace {

/// The metrics of the initial mesh without its cavities, which every record of a run has as those before.
const RecordSet::Json* given_metrics(const RecordSet& records, const std::string& molecule) {
  for (const std::string& name : records.methods()) {
    const RecordSet::Json* const record = records.find(molecule, name);
    if (is_done(record) && record->at("metrics").contains("before")) return &record->at("metrics").at("before");
  }
  return nullptr;
}

std::string title_of(const RecordSet& records, const std::string& molecule) {
  const RecordSet::Json& record = records.any_of(molecule);
  return labelled_title(text_at(&record, "/molecule/title").value_or(molecule), text_at(&record, "/molecule/role").value_or(""));
}

}  // namespace

Outcomes::Outcomes(const RecordSet& records, std::string molecule)
    : records_(&records), molecule_(std::move(molecule)), title_(title_of(records, molecule_)), given_(given_metrics(records, molecule_)) {}

bool Outcomes::is_done(std::string_view name) const {
  return experiments::is_done(records_->find(molecule_, name));
}

std::optional<double> Outcomes::value(const Quantity& quantity, std::string_view name) const {
  return is_done(name) ? quantity.of_case(*records_->find(molecule_, name), given_) : std::nullopt;
}

std::optional<double> Outcomes::given(const Quantity& quantity) const {
  return given_ != nullptr ? quantity.of_given(*given_) : std::nullopt;
}

std::string Outcomes::ending(std::string_view name) const {
  const RecordSet::Json* const record = records_->find(molecule_, name);
  if (record == nullptr) return "not run";
  if (experiments::is_done(record)) return text_at(record, "/stopped_because").value_or("done");
  return text_at(record, "/status").value_or("failed") + ": " + text_at(record, "/reason").value_or("no reason given");
}

std::string Outcomes::why_no_value(const Quantity& quantity, std::string_view name) const {
  if (value(quantity, name)) return "";
  const RecordSet::Json* const record = records_->find(molecule_, name);
  if (record == nullptr) return "not run";
  if (!experiments::is_done(record)) return text_at(record, "/status").value_or("failed");
  return quantity.id == "intersecting_pairs" ? "not counted" : "none";
}

std::vector<Outcomes> outcomes_of(const RecordSet& records) {
  std::vector<Outcomes> outcomes;
  for (const std::string& molecule : records.molecules()) outcomes.emplace_back(records, molecule);
  return outcomes;
}

std::optional<std::pair<double, double>> range_over(const Quantity& quantity, const Outcomes& outcomes,
                                                    const std::vector<DesignCase>& cases) {
  std::optional<std::pair<double, double>> range;
  for (const DesignCase& design_case : cases) {
    const auto value = outcomes.value(quantity, design_case.method_case.name);
    if (!value) continue;
    range = range ? std::pair(std::min(range->first, *value), std::max(range->second, *value)) : std::pair(*value, *value);
  }
  return range;
}

std::optional<Effects> effects_on(const Quantity& quantity, const Outcomes& outcomes, const AblationPlan& plan,
                                  const std::vector<VariedFactor>& varied) {
  FactorialResponse response;
  for (const VariedFactor& factor : varied) response.level_counts.push_back(factor.levels.size());
  for (const DesignCase& design_case : full_factorial(plan, varied)) {
    std::optional<double> value = outcomes.value(quantity, design_case.method_case.name);
    if (quantity.scale == QuantityScale::logarithmic && value) value = *value > 0 ? std::optional(std::log10(*value)) : std::nullopt;
    response.values.push_back(value);
  }
  return effects_of(response);
}

std::optional<double> level_mean(const Quantity& quantity, const Effects& effects, std::size_t factor, std::size_t level) {
  const std::optional<double> mean = effects.level_means[factor][level];
  return mean && quantity.scale == QuantityScale::logarithmic ? std::optional(std::pow(10.0, *mean)) : mean;
}

}  // namespace smopt::experiments
