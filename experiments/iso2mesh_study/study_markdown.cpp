#include "experiments/iso2mesh_study/study_markdown.h"

#include <fmt/format.h>

#include "experiments/tables/markdown.h"

namespace smopt::experiments {
namespace {

using baselines::CollapsePlacement;
using baselines::SmoothsurfMethod;

/// The paper's: "the Laplacian smoothing method is chosen and the meshes are smoothed 100 rounds".
constexpr int kPaperRounds = 100;
constexpr double kDefaultAlpha = 0.5;

/// Of the settings whose pairs are nearest to the paper's: enough to see which methods can give that many.
constexpr std::size_t kNearestShown = 4;

constexpr const char* kIntroduction =
    "# Which setting of ISO2mesh keeps area and volume?\n"
    "\n"
    "Liu et al. 2017 improve their meshes with ISO2mesh too: `meshresample` to about as many vertices as SMOPT leaves, then 100 rounds of\n"
    "`smoothsurf` with the Laplacian method. Their Figure 5 shows that \"ISO2mesh preserves both the mesh area and volume\"; their Table 3 "
    "counts\n"
    "57 intersecting pairs for the AChE monomer. They state neither alpha nor the way of resampling. This page tries both ways of "
    "resampling,\n"
    "the three methods, and values of alpha and of the rounds, and says how far area and volume move from those of the mesh that ISO2mesh "
    "was\n"
    "given (the initial mesh without its cavities). The closest setting is the one whose larger change of the two is smallest. Resampled\n"
    "positions are not rounded here to the six digits of ISO2mesh's text file: that can make vertices of needles equal, and once they are\n"
    "merged the mesh encloses no volume. Pairs are not counted where the area has more than doubled, which is a tangle.\n";

const char* name_of(CollapsePlacement placement) {
  return placement == CollapsePlacement::midpoint ? "midpoint" : "lindstrom-turk";
}

const char* name_of(SmoothsurfMethod method) {
  switch (method) {
    case SmoothsurfMethod::laplacian:
      return "laplacian";
    case SmoothsurfMethod::lowpass:
      return "lowpass";
    case SmoothsurfMethod::laplacianhc:
      return "laplacianhc";
  }
  return "";
}

std::string percent(const std::optional<double>& change) {
  return change ? fmt::format("{:+.2f} %", 100 * *change) : "—";
}

std::string pairs_text(const Iso2meshOutcome& outcome) {
  return outcome.pairs ? fmt::format("{}", *outcome.pairs) : "—";
}

std::string summary_of(const Iso2meshOutcome& outcome) {
  return fmt::format("area {}, volume {}, {} intersecting pairs", percent(outcome.area_change), percent(outcome.volume_change),
                     pairs_text(outcome));
}

bool is_paper_setting(const Iso2meshSetting& setting) {
  return setting.smoothing.method == SmoothsurfMethod::laplacian && setting.smoothing.alpha == kDefaultAlpha &&
         setting.smoothing.rounds == kPaperRounds;
}

std::vector<Iso2meshOutcome> of_method(const std::vector<Iso2meshOutcome>& outcomes, SmoothsurfMethod method) {
  std::vector<Iso2meshOutcome> result;
  for (const Iso2meshOutcome& outcome : outcomes)
    if (outcome.setting.smoothing.method == method) result.push_back(outcome);
  return result;
}

std::string findings(const Iso2meshMoleculeStudy& study) {
  std::string text;
  for (const Iso2meshOutcome& outcome : study.outcomes) {
    if (outcome.setting.smoothing.rounds == 0)
      text += fmt::format("- Resampling alone ({}): {}.\n", name_of(outcome.setting.placement), summary_of(outcome));
    if (is_paper_setting(outcome.setting))
      text += fmt::format("- The paper's words with the default alpha ({}): {}.\n", describe(outcome.setting), summary_of(outcome));
  }
  const std::vector<Iso2meshOutcome> laplacian = of_method(study.outcomes, SmoothsurfMethod::laplacian);
  if (const Iso2meshOutcome* best = closest(laplacian, kPaperRounds))
    text += fmt::format("- Closest of its Laplacian method after {} rounds: {}: {}.\n", kPaperRounds, describe(best->setting),
                        summary_of(*best));
  if (const Iso2meshOutcome* best = closest(study.outcomes, kPaperRounds))
    text += fmt::format("- **Closest to Figure 5 of all after {} rounds: {}: {}.**\n", kPaperRounds, describe(best->setting),
                        summary_of(*best));
  if (study.paper_pairs) {
    text += fmt::format("- Nearest to the paper's {} intersecting pairs after {} rounds:\n", *study.paper_pairs, kPaperRounds);
    for (const Iso2meshOutcome* outcome : nearest_by_pairs(study.outcomes, kPaperRounds, *study.paper_pairs, kNearestShown))
      text += fmt::format("  - {}: {}.\n", describe(outcome->setting), summary_of(*outcome));
  }
  return text;
}

Cell percent_cell(const std::optional<double>& change) {
  return change ? Cell(Decimal{100 * *change, 2}) : Cell();
}

std::vector<Cell> row_of(const Iso2meshOutcome& outcome) {
  const Iso2meshSetting& setting = outcome.setting;
  const bool is_smoothed = setting.smoothing.rounds > 0;
  return {std::string(name_of(setting.placement)),
          is_smoothed ? Cell(std::string(name_of(setting.smoothing.method))) : Cell(),
          is_smoothed ? Cell(Decimal{setting.smoothing.alpha, 2}) : Cell(),
          static_cast<long>(setting.smoothing.rounds),
          percent_cell(outcome.area_change),
          percent_cell(outcome.volume_change),
          outcome.pairs ? Cell(static_cast<long>(*outcome.pairs)) : Cell(),
          decimal_cell(outcome.min_angle_deg, 3),
          decimal_cell(outcome.median_edge_ratio, 2),
          outcome.diverged_at_step ? Cell(fmt::format("diverged at step {}", *outcome.diverged_at_step)) : Cell()};
}

Table table_of(const Iso2meshMoleculeStudy& study) {
  Table table{"iso2mesh",
              fmt::format("{}: every setting", study.title),
              {{"placement", "Resampling"},
               {"smoother", "Method"},
               {"alpha", "Alpha"},
               {"rounds", "Rounds"},
               {"area_change_percent", "Area (%)"},
               {"volume_change_percent", "Volume (%)"},
               {"intersecting_pairs", "Intersecting pairs"},
               {"min_angle_deg", "Smallest angle (°)"},
               {"median_edge_ratio", "Median edge ratio"},
               {"ended", "Ended"}},
              {},
              {}};
  for (const Iso2meshOutcome& outcome : study.outcomes) table.rows.push_back(row_of(outcome));
  return table;
}

std::string section(const Iso2meshMoleculeStudy& study) {
  return fmt::format(
      "\n## {}\n\n{} vertices given, {} asked for (SMOPT's number).\n\n{}\n<details><summary>All settings</summary>\n\n{}\n</details>\n",
      study.title, study.vertices_given, study.vertices_asked, findings(study), to_markdown(table_of(study)));
}

}  // namespace

std::string describe(const Iso2meshSetting& setting) {
  if (setting.smoothing.rounds == 0) return fmt::format("{}, not smoothed", name_of(setting.placement));
  return fmt::format("{}, {}, alpha {}, {} rounds", name_of(setting.placement), name_of(setting.smoothing.method), setting.smoothing.alpha,
                     setting.smoothing.rounds);
}

std::string study_markdown(const std::vector<Iso2meshMoleculeStudy>& studies, const std::string& command) {
  std::string page = kIntroduction;
  for (const Iso2meshMoleculeStudy& study : studies) page += section(study);
  return page + fmt::format("\nMade by `{}`.\n", command);
}

}  // namespace smopt::experiments
