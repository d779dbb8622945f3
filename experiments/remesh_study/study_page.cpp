#include "experiments/remesh_study/study_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "experiments/record_set.h"
#include "experiments/remesh_study/goals.h"
#include "experiments/tables/markdown.h"
#include "experiments/tables/methods_table.h"

namespace smopt::experiments {
namespace {

constexpr const char* kIntroduction = R"(# What `smopt2` gives

Molecules as the experiments mesh them, and ready meshes, improved by `smopt improve --method smopt2` with its defaults, under the judge that all
methods have (pairs by CGAL's exact predicates, TetGen in a process of its own). Every method is given the initial mesh without its cavities, and
volume, area and distances are held against that mesh. The *distance to the level set* is the mean over the area (200 000 samples, not the
vertices); the *deviation* is the larger of the two one-sided distances to the mesh that was given, over as many samples and all vertices.
Seconds are those of the whole method and of what prepares the mesh, without reading and writing: on one thread the processor's, on two the
clock's.

A goal is in the column's head. **Bold with ✗**: the must is missed, and the list below says where and, as far as it is known, why. ✓: the
aim is reached. Neither: the must is met, or there is none. Seconds are judged on meshes of the size that the goal is for, TetGen `-pq1.4` up to
75 000 vertices. *Without a foot*: samples of which no way along the gradient leads to the level set; they are not in the mean, and more than 0.1 %
of them are a miss. *Angle between neighbours*: of two triangles at their common edge, 0° folded, 180° flat; it and the *closest vertices* tell how
near a surface comes to what TetGen refuses. *Solvation iterations*: in brackets those on the mesh of `smopt`, which must not be fewer (without
them the number is not judged); up to 70 000 vertices. Memory: the largest that the whole process had while the method ran.
)";

constexpr const char* kReadyText = R"(
## Ready meshes

Their shape is reported, not judged; pairs and TetGen are musts.)";

constexpr const char* kArchiveText = R"( From the archive `{}` are taken the meshes that
are clean (closed, manifold, oriented, every triangle with an area, no two vertices at one place, no intersecting pair), have at least 2000
vertices, and are smooth: at most 1 % of the edges turn by more than 60° from one triangle to the next. That leaves out machine parts with sharp
edges, and models of so few triangles that their limbs are prisms.)";

constexpr const char* kFolderText = R"( From the folder `{}` every OFF file
that can be read is taken as it is, without a choice.)";

constexpr const char* kComparedText = R"(
## Beside the other methods

Every method of the experiments on the same meshes; those that can be told a number of vertices get that of `smopt2`'s result
(ISO2mesh can only take vertices away).
)";

constexpr const char* kAblationText = R"(
## Without one of its operations
)";

/// Columns of the table of methods that the comparisons show.
constexpr const char* kComparedColumns[] = {"molecule",
                                            "method",
                                            "vertices",
                                            "intersecting_pairs",
                                            "min_angle_deg",
                                            "max_angle_deg",
                                            "below_30_percent",
                                            "valence_5_6_7_percent",
                                            "area_change_percent",
                                            "volume_change_percent",
                                            "level_set_distance_ratio",
                                            "tetgen_p",
                                            "tetgen_pY",
                                            "cpu_s_method",
                                            "ended"};

/// What makes a record long and is in no table.
constexpr const char* kLongKeys[] = {"/repeats",
                                     "/each_round",
                                     "/metrics/before/edge_ratio/histogram",
                                     "/metrics/before/angle_deg/histogram",
                                     "/metrics/after/edge_ratio/histogram",
                                     "/metrics/after/angle_deg/histogram",
                                     "/solvation/degenerate_vertex_ids"};

std::string title_of(const Json& record) {
  return text_at(&record, "/molecule/title").value_or("?");
}

/// "failed: why", or "not installed: why".
std::string ending_of(const Json& record) {
  return text_at(&record, "/status").value_or("failed") + ": " + text_at(&record, "/reason").value_or("no reason given");
}

std::vector<Cell> row_of(const Json& record, const std::vector<Quantity>& quantities) {
  std::vector<Cell> cells(quantities.size() + 1);
  cells[0] = title_of(record);
  if (!is_done(&record)) {
    cells[1] = "**" + ending_of(record) + " ✗**";
    return cells;
  }
  for (std::size_t i = 0; i < quantities.size(); ++i) cells[i + 1] = marked(quantities[i].judge(record));
  return cells;
}

Table goals_table(const std::vector<Json>& records, const std::string& caption, const std::vector<Quantity>& quantities) {
  Table table{"", caption, {{"mesh", "Mesh"}}, {}, {}};
  for (const Quantity& quantity : quantities)
    table.columns.push_back({quantity.head.id, quantity.head.title + (quantity.goal.empty() ? "" : ": " + quantity.goal)});
  for (const Json& record : records) table.rows.push_back(row_of(record, quantities));
  return table;
}

/// A line for each must that the record misses.
std::vector<std::string> misses_of(const Json& record, const std::vector<Quantity>& quantities) {
  if (!is_done(&record)) return {"no result: " + ending_of(record)};
  std::vector<std::string> lines;
  for (const Quantity& quantity : quantities) {
    const Judged judged = quantity.judge(record);
    if (judged.verdict != Verdict::missed) continue;
    lines.push_back(fmt::format("{}: **{}**{}{}", quantity.head.title, judged.text, quantity.goal.empty() ? "" : " for " + quantity.goal,
                                judged.detail.empty() ? "" : "; " + judged.detail));
  }
  return lines;
}

/// What the method itself says of its result.
std::string notes_of(const Json& record) {
  std::string text = text_at(&record, "/stopped_because").value_or("");
  if (const auto notes = record.find("notes"); notes != record.end() && notes->is_array())
    for (const Json& note : *notes) text += (text.empty() ? "" : "; ") + note.get<std::string>();
  return text;
}

/// The goals that none of the meshes has the size for.
std::string unmeasured_text(const std::vector<Json>& records, const std::vector<Quantity>& quantities) {
  std::string text;
  for (const Quantity& quantity : unmeasured(quantities, records))
    text += fmt::format("- {}: {}: **not measured**\n", quantity.head.title, quantity.goal);
  return text.empty() ? "" : "\nGoals for which no mesh of their size has a result:\n\n" + text;
}

std::string misses_text(const std::vector<Json>& records, const std::vector<Quantity>& quantities) {
  std::string text;
  for (const Json& record : records) {
    const std::vector<std::string> misses = misses_of(record, quantities);
    if (misses.empty()) continue;
    text += fmt::format("- {}\n", title_of(record));
    for (const std::string& miss : misses) text += fmt::format("  - {}\n", miss);
    if (const std::string notes = notes_of(record); !notes.empty()) text += fmt::format("  - the method says: {}\n", notes);
  }
  return text.empty() ? "\nNo must is missed.\n" : "\nMusts that are missed:\n\n" + text;
}

/// Both tables and what is missed.
std::string goals_section(const std::vector<Json>& records, StudiedMeshes meshes) {
  std::vector<Quantity> shape = shape_quantities(meshes), use = use_quantities(meshes);
  std::string text = "\n" + to_markdown(goals_table(records, "The surface", shape)) + "\n" +
                     to_markdown(goals_table(records, "What it is good for, and what it costs", use));
  shape.insert(shape.end(), use.begin(), use.end());
  return text + misses_text(records, shape) + unmeasured_text(records, shape);
}

/// The ready meshes that were left, by reason.
std::string left_text(const std::vector<MeshCandidate>& candidates) {
  std::map<std::string, std::vector<std::string>> left;
  for (const MeshCandidate& candidate : candidates)
    if (const auto& [reason, detail] = candidate.fault; !reason.empty())
      left[reason].push_back(detail.empty() ? candidate.name : fmt::format("{} ({})", candidate.name, detail));
  std::string text;
  for (const auto& [reason, names] : left) text += fmt::format("- {}: {}\n", reason, fmt::join(names, ", "));
  return text.empty() ? "" : "\n<details><summary>Meshes that were left</summary>\n\n" + text + "\n</details>\n";
}

/// Where the ready meshes are from and which of them were taken.
std::string sources_text(const RemeshStudy& study) {
  std::string text;
  if (!study.archive.empty()) text += fmt::format(kArchiveText, study.archive);
  if (!study.folder.empty()) text += fmt::format(kFolderText, study.folder);
  return text + "\n";
}

std::string ready_section(const RemeshStudy& study) {
  if (study.ready.empty() && study.candidates.empty()) return "";
  return kReadyText + sources_text(study) + goals_section(study.ready, StudiedMeshes::ready) + left_text(study.candidates);
}

RecordSet record_set_of(const std::vector<Json>& list) {
  RecordSet records;
  for (const Json& record : list) records.add(record, "the study");
  return records;
}

Table with_columns(const Table& table, std::span<const char* const> ids) {
  Table result{table.name, table.caption, {}, std::vector<std::vector<Cell>>(table.rows.size()), table.notes};
  for (const char* id : ids) {
    const auto column = std::ranges::find(table.columns, id, &Column::id);
    const auto index = static_cast<std::size_t>(column - table.columns.begin());
    result.columns.push_back(*column);
    for (std::size_t row = 0; row < table.rows.size(); ++row) result.rows[row].push_back(table.rows[row][index]);
  }
  return result;
}

std::string comparison(const std::vector<Json>& records) {
  return "\n" + to_markdown(with_columns(methods_table(record_set_of(records)), kComparedColumns));
}

std::string compared_section(const RemeshStudy& study) {
  if (study.compared.empty()) return "";
  const std::string figure = study.figure.empty() ? "" : fmt::format("\n![All methods beside each other]({})\n", study.figure);
  return kComparedText + figure + comparison(study.compared);
}

std::string ablation_section(const RemeshStudy& study) {
  return study.ablations.empty() ? "" : kAblationText + comparison(study.ablations);
}

Json shortened(const std::vector<Json>& records) {
  Json list = Json::array();
  for (Json record : records) {
    for (const char* key : kLongKeys) {
      const Json::json_pointer pointer(key);
      if (record.contains(pointer)) record.at(pointer.parent_pointer()).erase(pointer.back());
    }
    list.push_back(std::move(record));
  }
  return list;
}

Json candidates_json(const std::vector<MeshCandidate>& candidates) {
  Json list = Json::array();
  for (const MeshCandidate& candidate : candidates)
    list.push_back({{"name", candidate.name},
                    {"vertices", candidate.vertices},
                    {"left_because", candidate.fault.reason.empty() ? Json() : Json(candidate.fault.reason)},
                    {"detail", candidate.fault.detail}});
  return list;
}

}  // namespace

std::string study_page(const RemeshStudy& study, const std::string& command) {
  std::string page = kIntroduction;
  if (!study.molecules.empty()) page += "\n## Molecules\n" + goals_section(study.molecules, StudiedMeshes::molecules);
  page += ready_section(study) + compared_section(study) + ablation_section(study);
  return page + fmt::format("\nMade by `{}`.\n", command);
}

Json study_json(const RemeshStudy& study) {
  return {{"molecules", shortened(study.molecules)},
          {"ready", shortened(study.ready)},
          {"candidates", candidates_json(study.candidates)},
          {"compared", shortened(study.compared)},
          {"ablations", shortened(study.ablations)}};
}

}  // namespace smopt::experiments
