#include "experiments/ablation/findings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace smopt::experiments {
namespace {

constexpr double kPerCent = 100;

/// Interactions below are not worth a sentence.
constexpr double kLeastShare = 0.01;
/// From here on what three parts and more do together is told too.
constexpr double kMuchShare = 0.1;

std::string default_name(const AblationPlan& plan) {
  return design_case(plan, default_levels(plan)).method_case.name;
}

std::string upper_first(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text;
}

/// A level that is not the default, and its case.
struct SingleChange {
  std::size_t factor = 0;
  std::size_t level = 0;
  std::string name;
};

std::vector<SingleChange> single_changes(const AblationPlan& plan, const VariedFactor& varied) {
  std::vector<SingleChange> changes;
  for (const std::size_t level : varied.levels) {
    std::vector<std::size_t> levels = default_levels(plan);
    if (levels[varied.factor] == level) continue;
    levels[varied.factor] = level;
    changes.push_back({varied.factor, level, design_case(plan, levels).method_case.name});
  }
  return changes;
}

/// "intersecting pairs 12 pairs (default 0 pairs)", for each quantity that changes noticeably or is not there.
std::vector<std::string> changes_of(const Outcomes& outcomes, const std::string& name, const std::string& reference_name) {
  std::vector<std::string> changes;
  for (const Quantity& quantity : ablation_quantities()) {
    const auto value = outcomes.value(quantity, name), reference = outcomes.value(quantity, reference_name);
    if (!value)
      changes.push_back(fmt::format("{} {}", quantity.words, outcomes.why_no_value(quantity, name)));
    else if (!reference || is_noticeable(quantity, *value, *reference))
      changes.push_back(fmt::format("{} {} ({})", quantity.words, in_words(quantity, value), in_words(quantity, reference)));
  }
  return changes;
}

std::string sentence_of(const AblationPlan& plan, const Outcomes& outcomes, const SingleChange& change) {
  const std::string& title = plan.factors[change.factor].levels[change.level].title;
  if (!outcomes.is_done(change.name)) return fmt::format("{}: {}", upper_first(title), outcomes.ending(change.name));
  const std::vector<std::string> changes = changes_of(outcomes, change.name, default_name(plan));
  return changes.empty() ? fmt::format("{}: changes nothing noticeably.", upper_first(title))
                         : fmt::format("{}: {}.", upper_first(title), fmt::join(changes, "; "));
}

std::string largest_change(const AblationPlan& plan, const Outcomes& outcomes, const Quantity& quantity) {
  const auto reference = outcomes.value(quantity, default_name(plan));
  if (!reference) return fmt::format("{}: the default has no such number.", upper_first(quantity.words));
  double largest = 0;
  std::string found;
  for (const VariedFactor& varied : plan.one_at_a_time) {
    for (const SingleChange& change : single_changes(plan, varied)) {
      const auto value = outcomes.value(quantity, change.name);
      if (!value || change_size(quantity, *value, *reference) <= largest) continue;
      largest = change_size(quantity, *value, *reference);
      const Factor& factor = plan.factors[change.factor];
      found = fmt::format("{}: most changed by **{}: {}**, to {} from {}.", upper_first(quantity.words), factor.title,
                          factor.levels[change.level].title, in_words(quantity, value), in_words(quantity, reference));
    }
  }
  if (largest >= 1) return found;
  return fmt::format("{}: no single change moves it noticeably from {}.", upper_first(quantity.words), in_words(quantity, reference));
}

std::string percent(double share) {
  return fmt::format("{:.0f} %", kPerCent * share);
}

const Factor& factor_of(const AblationPlan& plan, std::size_t place) {
  return plan.factors[plan.factorial[place].factor];
}

/// "0 pairs with exact, 12 pairs with none".
std::string means_in_words(const AblationPlan& plan, const Quantity& quantity, const Effects& effects, std::size_t place) {
  std::vector<std::string> means;
  for (std::size_t level = 0; level < plan.factorial[place].levels.size(); ++level)
    if (const auto mean = level_mean(quantity, effects, place, level))
      means.push_back(fmt::format("{} with {}", mean_in_words(quantity, *mean),
                                  factor_of(plan, place).levels[plan.factorial[place].levels[level]].title));
  return fmt::format("{}", fmt::join(means, ", "));
}

/// Two factors and their part of the variation; the same factor twice for a main effect.
struct Share {
  std::size_t factor = 0;
  std::size_t other = 0;
  double share = 0;
};

std::optional<Share> largest_share(const Effects& effects, bool of_interactions) {
  std::optional<Share> largest;
  for (std::size_t i = 0; i < effects.shares.size(); ++i) {
    for (std::size_t j = i; j < effects.shares.size(); ++j) {
      const auto share = effects.shares[i][j];
      if ((i != j) == of_interactions && share && (!largest || *share > largest->share)) largest = {i, j, *share};
    }
  }
  return largest;
}

std::string interaction_words(const AblationPlan& plan, const Effects& effects) {
  const auto strongest = largest_share(effects, true);
  if (!strongest) return "interactions cannot be worked out";
  if (strongest->share < kLeastShare) return "no two parts act together noticeably";
  return fmt::format("the strongest interaction is {} × {} ({})", factor_of(plan, strongest->factor).title,
                     factor_of(plan, strongest->other).title, percent(strongest->share));
}

/// What three parts and more do together, where it is a lot.
std::string rest_words(const Effects& effects) {
  if (!effects.rest_share || *effects.rest_share < kMuchShare) return "";
  return fmt::format("; three parts and more together make {}", percent(*effects.rest_share));
}

std::string factorial_finding(const AblationPlan& plan, const Outcomes& outcomes, const Quantity& quantity) {
  const std::string head = upper_first(quantity.words);
  const std::optional<Effects> effects = effects_on(quantity, outcomes, plan, plan.factorial);
  if (!effects) return fmt::format("{}: cannot be told; no complete part of the design has the number.", head);
  if (!effects->varies) return fmt::format("{}: alike in all cases.", head);
  const auto [least, most] = *range_over(quantity, outcomes, full_factorial(plan, plan.factorial));
  if (!is_noticeable(quantity, most, least))
    return fmt::format("{}: hardly varies ({} to {}).", head, in_words(quantity, least), in_words(quantity, most));
  const auto main = largest_share(*effects, false);
  return fmt::format("{}: **{}** does the most ({} of the variation; on average {}); {}{}.", head, factor_of(plan, main->factor).title,
                     percent(main->share), means_in_words(plan, quantity, *effects, main->factor), interaction_words(plan, *effects),
                     rest_words(*effects));
}

/// "edge ratio 0.1, angle 10°".
std::string place_in_grid(const AblationPlan& plan, const DesignCase& design_case) {
  std::vector<std::string> parts;
  for (const auto& [factor, levels] : plan.thresholds)
    parts.push_back(fmt::format("{} {}", plan.factors[factor].name, plan.factors[factor].levels[design_case.levels[factor]].title));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string threshold_finding(const AblationPlan& plan, const Outcomes& outcomes, const Quantity& quantity) {
  const std::vector<DesignCase> cases = full_factorial(plan, plan.thresholds);
  const DesignCase* least = nullptr;
  const DesignCase* most = nullptr;
  const auto value = [&](const DesignCase* c) { return outcomes.value(quantity, c->method_case.name); };
  for (const DesignCase& design_case : cases) {
    if (!value(&design_case)) continue;
    if (least == nullptr || *value(&design_case) < *value(least)) least = &design_case;
    if (most == nullptr || *value(&design_case) > *value(most)) most = &design_case;
  }
  const std::string head = upper_first(quantity.words);
  if (least == nullptr) return fmt::format("{}: no case of the grid has such a number.", head);
  const std::string at_default = in_words(quantity, outcomes.value(quantity, default_name(plan)));
  if (!is_noticeable(quantity, *value(most), *value(least)))
    return fmt::format("{}: the thresholds do not move it noticeably ({} to {}; default {}).", head, in_words(quantity, value(least)),
                       in_words(quantity, value(most)), at_default);
  return fmt::format("{}: from {} ({}) to {} ({}); default {}.", head, in_words(quantity, value(least)), place_in_grid(plan, *least),
                     in_words(quantity, value(most)), place_in_grid(plan, *most), at_default);
}

template <class Finding>
std::vector<std::string> per_quantity(const Finding& finding) {
  std::vector<std::string> findings;
  for (const Quantity& quantity : ablation_quantities()) findings.push_back(finding(quantity));
  return findings;
}

}  // namespace

std::string whole_finding(const AblationPlan& plan, const Outcomes& outcomes) {
  const std::string name = default_name(plan);
  if (!outcomes.is_done(name)) return fmt::format("The case with all defaults has no result ({}).", outcomes.ending(name));
  std::vector<std::string> parts;
  for (const Quantity& quantity : ablation_quantities()) {
    const auto before = outcomes.given(quantity), after = outcomes.value(quantity, name);
    const std::string text = after ? in_words(quantity, after) : outcomes.why_no_value(quantity, name);
    parts.push_back(before ? fmt::format("{} {} (before: {})", quantity.words, text, in_words(quantity, before))
                           : fmt::format("{} {}", quantity.words, text));
  }
  return fmt::format("With all defaults: {}; stopped because: {}.", fmt::join(parts, ", "), outcomes.ending(name));
}

std::vector<FactorFinding> one_at_a_time_findings(const AblationPlan& plan, const Outcomes& outcomes) {
  std::vector<FactorFinding> findings;
  for (const VariedFactor& varied : plan.one_at_a_time) {
    const Factor& factor = plan.factors[varied.factor];
    FactorFinding finding{factor.title, factor.about, {}};
    for (const SingleChange& change : single_changes(plan, varied)) finding.sentences.push_back(sentence_of(plan, outcomes, change));
    findings.push_back(std::move(finding));
  }
  return findings;
}

std::vector<std::string> largest_change_findings(const AblationPlan& plan, const Outcomes& outcomes) {
  return per_quantity([&](const Quantity& quantity) { return largest_change(plan, outcomes, quantity); });
}

std::vector<std::string> factorial_findings(const AblationPlan& plan, const Outcomes& outcomes) {
  return per_quantity([&](const Quantity& quantity) { return factorial_finding(plan, outcomes, quantity); });
}

std::vector<std::string> threshold_findings(const AblationPlan& plan, const Outcomes& outcomes) {
  return per_quantity([&](const Quantity& quantity) { return threshold_finding(plan, outcomes, quantity); });
}

std::vector<std::string> failures(const std::vector<DesignCase>& cases, const Outcomes& outcomes) {
  std::vector<std::string> sentences;
  for (const DesignCase& design_case : cases)
    if (const std::string& name = design_case.method_case.name; !outcomes.is_done(name))
      sentences.push_back(fmt::format("{}, {}: {}", outcomes.title(), design_case.method_case.title, outcomes.ending(name)));
  return sentences;
}

}  // namespace smopt::experiments
