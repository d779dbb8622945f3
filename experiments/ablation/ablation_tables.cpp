#include "experiments/ablation/ablation_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace smopt::experiments {
namespace {

using Row = std::vector<Cell>;

constexpr int kShareDecimals = 1;  // of per cent
constexpr double kPerCent = 100;

/// "not counted" where pairs are not, or the number, or nothing where the row says why as a whole.
Cell value_cell(const Quantity& quantity, const Outcomes& outcomes, const std::string& name) {
  if (const auto value = outcomes.value(quantity, name)) return Decimal{rounded(*value, quantity.decimals), quantity.decimals};
  const std::string why = outcomes.why_no_value(quantity, name);
  return outcomes.is_done(name) && why == "not counted" ? Cell(why) : Cell();
}

void add_quantity_columns(Table& table) {
  for (const Quantity& quantity : ablation_quantities()) table.columns.push_back({quantity.id, quantity.title});
}

void add_case(Table& table, Row head, const Outcomes& outcomes, const std::string& name) {
  for (const Quantity& quantity : ablation_quantities()) head.push_back(value_cell(quantity, outcomes, name));
  head.emplace_back(outcomes.ending(name));
  table.rows.push_back(std::move(head));
}

void add_given(Table& table, Row head, const Outcomes& outcomes) {
  for (const Quantity& quantity : ablation_quantities()) head.push_back(decimal_cell(outcomes.given(quantity), quantity.decimals));
  head.emplace_back("given to the method");
  table.rows.push_back(std::move(head));
}

std::string about_numbers() {
  return "Changes of volume and area are held against the initial mesh without its cavities. Pairs are counted by CGAL's exact predicates. "
         "CPU seconds on one thread: validity, cavities, redundant points and smoothing. \"—\" where there is no such number.";
}

/// A column for each varied factor, then the quantities, then how the case ended.
Table design_table(const AblationPlan& plan, const std::vector<VariedFactor>& varied, std::string name, std::string caption,
                   const std::vector<Outcomes>& molecules) {
  Table table{std::move(name), std::move(caption), {{"molecule", "Molecule"}}, {}, {about_numbers()}};
  for (const auto& [factor, levels] : varied) table.columns.push_back({plan.factors[factor].name, plan.factors[factor].title});
  add_quantity_columns(table);
  table.columns.push_back({"ended", "Ended"});
  for (const Outcomes& outcomes : molecules) {
    for (const DesignCase& design_case : full_factorial(plan, varied)) {
      Row head = {outcomes.title()};
      for (const auto& [factor, levels] : varied) head.emplace_back(plan.factors[factor].levels[design_case.levels[factor]].title);
      add_case(table, std::move(head), outcomes, design_case.method_case.name);
    }
  }
  return table;
}

/// Which levels the effects on some quantities leave out, a sentence a molecule; empty where none.
std::vector<std::string> left_out_notes(const AblationPlan& plan, const std::vector<Outcomes>& molecules) {
  std::vector<std::string> notes;
  for (const Outcomes& outcomes : molecules) {
    for (const Quantity& quantity : ablation_quantities()) {
      const std::optional<Effects> effects = effects_on(quantity, outcomes, plan, plan.factorial);
      if (!effects) {
        notes.push_back(fmt::format("{}: the effects on {} cannot be worked out: no complete part of the design has the number.",
                                    outcomes.title(), quantity.words));
        continue;
      }
      std::vector<std::string> levels;
      for (const auto& [factor, level] : effects->left_out) {
        const Factor& named = plan.factors[plan.factorial[factor].factor];
        levels.push_back(fmt::format("{}: {}", named.title, named.levels[plan.factorial[factor].levels[level]].title));
      }
      if (!levels.empty())
        notes.push_back(fmt::format("{}: the effects on {} are worked out without {}, of which cases have no such number.",
                                    outcomes.title(), quantity.words, fmt::join(levels, "; ")));
    }
  }
  return notes;
}

/// The effects of the factorial design on every quantity, of one molecule.
std::vector<std::optional<Effects>> all_effects(const AblationPlan& plan, const Outcomes& outcomes) {
  std::vector<std::optional<Effects>> effects;
  for (const Quantity& quantity : ablation_quantities()) effects.push_back(effects_on(quantity, outcomes, plan, plan.factorial));
  return effects;
}

Row main_effect_row(const AblationPlan& plan, const std::vector<std::optional<Effects>>& effects, std::size_t factor, std::size_t level) {
  const auto& [which, levels] = plan.factorial[factor];
  Row row = {plan.factors[which].title, plan.factors[which].levels[levels[level]].title};
  for (std::size_t q = 0; q < effects.size(); ++q) {
    const Quantity& quantity = ablation_quantities()[q];
    const auto mean = effects[q] ? level_mean(quantity, *effects[q], factor, level) : std::nullopt;
    row.push_back(mean ? Cell(Decimal{rounded(*mean, mean_decimals(quantity)), mean_decimals(quantity)}) : Cell());
  }
  return row;
}

Cell share_cell(const std::optional<double>& share) {
  return share ? Cell(Decimal{kPerCent * *share, kShareDecimals}) : Cell();
}

Row share_row(const AblationPlan& plan, const std::vector<std::optional<Effects>>& effects, std::size_t factor, std::size_t other) {
  const auto title = [&](std::size_t i) { return plan.factors[plan.factorial[i].factor].title; };
  Row row = {factor == other ? title(factor) : fmt::format("{} × {}", title(factor), title(other))};
  for (const std::optional<Effects>& e : effects) row.push_back(e ? share_cell(e->shares[factor][other]) : Cell());
  return row;
}

Row rest_row(const std::vector<std::optional<Effects>>& effects) {
  Row row = {"three factors and more"};
  for (const std::optional<Effects>& e : effects) row.push_back(e ? share_cell(e->rest_share) : Cell());
  return row;
}

void add_with_title(Table& table, const Outcomes& outcomes, Row row) {
  row.insert(row.begin(), Cell(outcomes.title()));
  table.rows.push_back(std::move(row));
}

/// Main effects first, then each two factors, then the rest.
void add_shares(Table& table, const AblationPlan& plan, const Outcomes& outcomes) {
  const std::vector<std::optional<Effects>> effects = all_effects(plan, outcomes);
  const std::size_t factors = plan.factorial.size();
  for (std::size_t i = 0; i < factors; ++i) add_with_title(table, outcomes, share_row(plan, effects, i, i));
  for (std::size_t i = 0; i < factors; ++i)
    for (std::size_t j = i + 1; j < factors; ++j) add_with_title(table, outcomes, share_row(plan, effects, i, j));
  add_with_title(table, outcomes, rest_row(effects));
}

}  // namespace

Table one_at_a_time_table(const AblationPlan& plan, const std::vector<Outcomes>& molecules) {
  Table table{"ablation-one-at-a-time",
              "One at a time: SMOPT with all defaults, and with one part of it set otherwise",
              {{"molecule", "Molecule"}, {"factor", "Part"}, {"level", "Set to"}},
              {},
              {about_numbers()}};
  add_quantity_columns(table);
  table.columns.push_back({"ended", "Ended"});
  for (const Outcomes& outcomes : molecules) {
    add_given(table, {outcomes.title(), "none", "before SMOPT"}, outcomes);
    const std::vector<std::size_t> defaults = default_levels(plan);
    add_case(table, {outcomes.title(), "all", "defaults"}, outcomes, design_case(plan, defaults).method_case.name);
    for (const auto& [factor, levels] : plan.one_at_a_time) {
      for (const std::size_t level : levels) {
        if (level == defaults[factor]) continue;
        std::vector<std::size_t> changed = defaults;
        changed[factor] = level;
        add_case(table, {outcomes.title(), plan.factors[factor].title, plan.factors[factor].levels[level].title}, outcomes,
                 design_case(plan, changed).method_case.name);
      }
    }
  }
  return table;
}

Table factorial_table(const AblationPlan& plan, const std::vector<Outcomes>& molecules) {
  return design_table(plan, plan.factorial, "ablation-factorial", "Full factorial: every case", molecules);
}

Table thresholds_table(const AblationPlan& plan, const std::vector<Outcomes>& molecules) {
  Table table = design_table(plan, plan.thresholds, "ablation-thresholds", "Thresholds: every case of the grid", molecules);
  table.notes.push_back(
      "The threshold of the angle is also the angle below which a step may not make things worse (`--bad-angles`); at 0 no step is refused "
      "for its angles.");
  return table;
}

Table main_effects_table(const AblationPlan& plan, const std::vector<Outcomes>& molecules) {
  Table table{"ablation-main-effects",
              "Full factorial: the mean of every quantity over all cases with that level",
              {{"molecule", "Molecule"}, {"factor", "Part"}, {"level", "Set to"}},
              {},
              {"Means over all settings of the other parts: geometric means of times and moves, arithmetic ones of the others."}};
  add_quantity_columns(table);
  for (const Outcomes& outcomes : molecules) {
    const std::vector<std::optional<Effects>> effects = all_effects(plan, outcomes);
    for (std::size_t i = 0; i < plan.factorial.size(); ++i)
      for (std::size_t level = 0; level < plan.factorial[i].levels.size(); ++level)
        add_with_title(table, outcomes, main_effect_row(plan, effects, i, level));
  }
  for (std::string& note : left_out_notes(plan, molecules)) table.notes.push_back(std::move(note));
  return table;
}

Table interactions_table(const AblationPlan& plan, const std::vector<Outcomes>& molecules) {
  Table table{"ablation-interactions",
              "Full factorial: whose the variation between the cases is (per cent of the sum of squares)",
              {{"molecule", "Molecule"}, {"effect", "Effect of"}},
              {},
              {"Times and moves on a logarithmic scale. \"—\" where nothing varies, or where too few cases have the number. The cases are "
               "computed, not drawn: no effect has an error, and none is tested."}};
  add_quantity_columns(table);
  for (const Outcomes& outcomes : molecules) add_shares(table, plan, outcomes);
  for (std::string& note : left_out_notes(plan, molecules)) table.notes.push_back(std::move(note));
  return table;
}

}  // namespace smopt::experiments
