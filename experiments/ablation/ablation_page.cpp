#include "experiments/ablation/ablation_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/ablation/findings.h"

namespace smopt::experiments {
namespace {

std::string bullets(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += fmt::format("- {}\n", sentence);
  return text + "\n";
}

std::string links(const std::string& figure, const std::vector<std::string>& tables) {
  std::vector<std::string> list;
  for (const std::string& table : tables) list.push_back(fmt::format("[{0}](tables/{0}.md)", table));
  return fmt::format("![{0}](figures/{0}.svg)\n\nNumbers: {1}.\n\n", figure, fmt::join(list, ", "));
}

std::string heading(const Outcomes& outcomes) {
  return fmt::format("### {}\n\n", outcomes.title());
}

std::string factor_list(const AblationPlan& plan, const std::vector<VariedFactor>& varied) {
  std::vector<std::string> parts;
  for (const auto& [factor, levels] : varied) {
    std::vector<std::string> titles;
    for (const std::size_t level : levels) titles.push_back(plan.factors[factor].levels[level].title);
    parts.push_back(fmt::format("{} ({})", plan.factors[factor].title, fmt::join(titles, ", ")));
  }
  return fmt::format("{}", fmt::join(parts, " × "));
}

std::string factor_paragraphs(const AblationPlan& plan, const Outcomes& outcomes) {
  std::string text;
  for (const FactorFinding& finding : one_at_a_time_findings(plan, outcomes))
    text += fmt::format("**{}** ({}):\n\n{}", finding.title, finding.about, bullets(finding.sentences));
  return text;
}

std::string one_at_a_time_section(const AblationPlan& plan, const std::vector<Outcomes>& molecules) {
  std::string text =
      "## One part at a time\n\n"
      "Everything at its default, and one part of SMOPT set otherwise. In brackets the value with all defaults; what is not named differs "
      "by "
      "less than shows.\n\n" +
      links("ablation-one-at-a-time", {"ablation-one-at-a-time"});
  for (const Outcomes& outcomes : molecules)
    text += heading(outcomes) + whole_finding(plan, outcomes) + "\n\n" + bullets(largest_change_findings(plan, outcomes)) +
            factor_paragraphs(plan, outcomes);
  return text;
}

std::string factorial_section(const AblationPlan& plan, const std::vector<Outcomes>& molecules) {
  std::string text = fmt::format(
      "## Parts together\n\n"
      "Every combination of {}: {} cases a molecule. Parts of the variation are of the sum of squares over these cases, of times and moves "
      "on "
      "a logarithmic scale; they hold for these levels. The cases are computed, so there is no error term and no test of significance; "
      "interactions of three parts and more are told together.\n\n",
      factor_list(plan, plan.factorial), full_factorial(plan, plan.factorial).size());
  text += "![ablation-main-effects](figures/ablation-main-effects.svg)\n\n";
  text += links("ablation-interactions", {"ablation-main-effects", "ablation-interactions", "ablation-factorial"});
  for (const Outcomes& outcomes : molecules) text += heading(outcomes) + bullets(factorial_findings(plan, outcomes));
  return text;
}

std::string thresholds_section(const AblationPlan& plan, const std::vector<Outcomes>& molecules) {
  std::string text = fmt::format(
      "## The thresholds of screening\n\n"
      "{}. The threshold of the angle is also the angle below which a step may not make things worse (`--bad-angles keep`), so at 0 "
      "nothing is "
      "refused for its angles.\n\n",
      factor_list(plan, plan.thresholds));
  text += links("ablation-thresholds", {"ablation-thresholds"});
  for (const Outcomes& outcomes : molecules) text += heading(outcomes) + bullets(threshold_findings(plan, outcomes));
  return text;
}

std::string failures_section(const AblationPlan& plan, const std::vector<Outcomes>& molecules, const ChosenDesigns& designs) {
  std::vector<std::string> sentences;
  for (const Outcomes& outcomes : molecules)
    for (std::string& sentence : failures(chosen_cases(plan, designs), outcomes)) sentences.push_back(std::move(sentence));
  return "## Cases without a result\n\n" + (sentences.empty() ? "None.\n" : bullets(sentences));
}

}  // namespace

std::string ablation_page(const AblationPlan& plan, const std::vector<Outcomes>& molecules, const ChosenDesigns& designs) {
  std::string text =
      "# What each part of SMOPT contributes\n\n"
      "Written by `smopt ablate` from the records of this folder. Volume and area are held against the initial mesh without its cavities; "
      "pairs are counted by CGAL's exact predicates; times are processor seconds on one thread.\n\n";
  if (designs.one_at_a_time) text += one_at_a_time_section(plan, molecules);
  if (designs.factorial) text += factorial_section(plan, molecules);
  if (designs.thresholds) text += thresholds_section(plan, molecules);
  return text + failures_section(plan, molecules, designs);
}

}  // namespace smopt::experiments
