#include "experiments/convergence/study_markdown.h"

#include <fmt/format.h>

#include <string_view>

#include "experiments/convergence/change_tables.h"
#include "experiments/convergence/convergence_tables.h"
#include "experiments/convergence/edge_ratio_bars.h"
#include "experiments/convergence/embedded.h"
#include "experiments/convergence/published_table.h"
#include "experiments/tables/markdown.h"

namespace smopt::experiments {
namespace {

constexpr std::size_t kHardestChanges = 10;

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
}

std::string convergence_tables(std::span<const MoleculeStudy> studies) {
  std::string text;
  for (const MoleculeStudy& study : studies) text += (text.empty() ? "" : "\n") + to_markdown(convergence_table(study));
  return text;
}

/// For the first molecule that the published program's meshes are known of.
std::string histograms(std::span<const MoleculeStudy> studies) {
  for (const MoleculeStudy& study : studies) {
    if (study.published.empty()) continue;
    const AdaptiveRow& adaptive = study.published.front().ours;
    const UniformRow& uniform = study.uniform.front();
    return fmt::format("{}, adaptive, E = {} Å:\n```\n{}```\n\n{}, uniform grid, {} Å:\n```\n{}```\n", study.dataset.title, adaptive.error,
                       edge_ratio_bars(adaptive.surface.edge_ratio), study.dataset.title, uniform.spacing,
                       edge_ratio_bars(uniform.surface.edge_ratio));
  }
  return {};
}

}  // namespace

std::string study_markdown(std::span<const MoleculeStudy> studies, const std::string& command) {
  std::string text(embedded::study_text());
  replace_all(text, "{{command}}", command);
  replace_all(text, "{{convergence}}", convergence_tables(studies));
  replace_all(text, "{{limits}}", to_markdown(limit_table(studies)));
  replace_all(text, "{{changes}}", to_markdown(change_table(studies)));
  replace_all(text, "{{events}}", to_markdown(event_table(studies)));
  replace_all(text, "{{hardest}}", to_markdown(hardest_changes_table(studies, kHardestChanges)));
  replace_all(text, "{{published}}", to_markdown(published_table(studies)));
  replace_all(text, "{{source}}", published_figures().source);
  replace_all(text, "{{histograms}}", histograms(studies));
  return text;
}

}  // namespace smopt::experiments
