#include "experiments/remesh_study/goals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "experiments/level_set_run.h"
#include "experiments/record_set.h"
#include "experiments/tetgen_trials.h"

namespace smopt::experiments {
namespace {

using Number = std::optional<double>;

constexpr double kPerCent = 100;

constexpr double kPerMillion = 1e6;

/// A goal that is for a number of vertices is judged on meshes of about as many.
struct SizeBand {
  double least, most;  ///< vertices of the mesh that the method was given
  const char* text;

  [[nodiscard]] bool has(const Json& record) const {
    const Number vertices = number_at(&record, "/metrics/before/vertices");
    return vertices && least <= *vertices && *vertices <= most;
  }
};

/// The goals for 65 000 vertices: the experiments' monomer without its cavities has as many.
constexpr SizeBand kMonomerBand{60'000, 75'000, "60 000 to 75 000 vertices"};

/// The goal for a million vertices: a tenth less or more.
constexpr SizeBand kMillionBand{900'000, 1'100'000, "0.9 to 1.1 million vertices"};

/// Of the samples, those without a foot on the level set: they are left out of the mean, and a mean without more than these is none.
constexpr double kMostUnresolvedShare = 0.001;

enum class Side { at_least, at_most };

/// A must and an aim.
struct Goal {
  Side side;
  double must;
  double aim;

  [[nodiscard]] bool meets(double value, double bound) const { return side == Side::at_least ? value >= bound : value <= bound; }
  [[nodiscard]] Verdict judge(double value) const {
    return meets(value, aim) ? Verdict::aim : meets(value, must) ? Verdict::must : Verdict::missed;
  }
  [[nodiscard]] std::string text() const {
    const char* sign = side == Side::at_least ? "≥" : "≤";
    return must == aim ? fmt::format("{} {}", sign, must) : fmt::format("{} {}, aim {} {}", sign, must, sign, aim);
  }
};

/// How a number is read, shown and judged.
struct Measured {
  Column head;
  std::function<Number(const Json&)> value;
  int decimals = 2;
  std::optional<Goal> goal;
  std::function<std::string(const Json&)> detail = {};  ///< where a must is missed
  std::function<bool(const Json&)> is_judged = {};      ///< empty: every record is
};

Judged judged(const Measured& measured, const Json& record) {
  const bool has_goal = measured.goal && (!measured.is_judged || measured.is_judged(record));
  const Number value = measured.value(record);
  Judged result;
  if (value) result.text = fmt::format("{:.{}f}", *value, measured.decimals);
  if (!has_goal) return result;
  // Signed changes are judged by their amount.
  result.verdict = value ? measured.goal->judge(measured.goal->side == Side::at_most ? std::abs(*value) : *value) : Verdict::missed;
  if (result.verdict == Verdict::missed)
    result.detail = !value ? "there is no such number" : measured.detail ? measured.detail(record) : "";
  return result;
}

Quantity quantity(Measured measured) {
  const Column head = measured.head;
  const std::string goal = measured.goal ? measured.goal->text() : "";
  return {head, goal, [measured = std::move(measured)](const Json& record) { return judged(measured, record); }};
}

std::function<Number(const Json&)> at(const std::string& pointer, double factor = 1) {
  return [=](const Json& record) {
    const Number value = number_at(&record, pointer);
    return value ? Number(factor * *value) : Number();
  };
}

/// The first number as a multiple of the second.
std::function<Number(const Json&)> ratio(const std::string& of, const std::string& to) {
  return [=](const Json& record) {
    const Number numerator = number_at(&record, of), denominator = number_at(&record, to);
    return numerator && denominator && *denominator != 0 ? Number(*numerator / *denominator) : Number();
  };
}

/// Per cent.
std::function<Number(const Json&)> change(const std::string& metric) {
  return [after = ratio("/metrics/after/" + metric, "/metrics/before/" + metric)](const Json& record) {
    const Number value = after(record);
    return value ? Number(kPerCent * (*value - 1)) : Number();
  };
}

/// "triangle 12 at (1.0, 2.0, 3.0)"
std::function<std::string(const Json&)> place(const std::string& key) {
  return [key](const Json& record) {
    const std::string pointer = "/worst/" + key;
    const Number triangle = number_at(&record, pointer + "/triangle");
    if (!triangle) return std::string();
    const auto coordinate = [&](int axis) { return number_at(&record, fmt::format("{}/point/{}", pointer, axis)).value_or(0); };
    return fmt::format("triangle {:.0f} at ({:.2f}, {:.2f}, {:.2f})", *triangle, coordinate(0), coordinate(1), coordinate(2));
  };
}

bool has_at_most(const Json& record, double vertices) {
  return number_at(&record, "/metrics/before/vertices").value_or(HUGE_VAL) <= vertices;
}

bool has_value(const Json& record, const std::string& pointer) {
  return record.contains(Json::json_pointer(pointer));
}

std::vector<Measured> measured_shape() {
  return {
      {{"vertices_before", "Vertices before"}, at("/metrics/before/vertices"), 0, {}},
      {{"vertices_after", "After"}, at("/metrics/after/vertices"), 0, {}},
      {{"intersecting_pairs", "Intersecting pairs"},
       at("/metrics/after/intersecting_pairs"),
       0,
       Goal{Side::at_most, 0, 0},
       place("intersection")},
      {{"min_angle_deg", "Smallest angle (°)"},
       at("/metrics/after/angle_deg/min"),
       3,
       Goal{Side::at_least, 15, 30},
       place("smallest_angle")},
      {{"max_angle_deg", "Largest angle (°)"},
       at("/metrics/after/angle_deg/max"),
       2,
       Goal{Side::at_most, 140, 110},
       place("largest_angle")},
      {{"below_30_percent", "Smallest angle < 30° (%)"},
       at("/metrics/after/min_angle_share/below_30", kPerCent),
       3,
       Goal{Side::at_most, 0.5, 0}},
      {{"valence_5_6_7_percent", "Valence 5–7 (%)"}, at("/metrics/after/valence/share_5_6_7", kPerCent), 2, Goal{Side::at_least, 97, 99.5}},
      {{"volume_change_percent", "Volume (%)"}, change("volume"), 5, Goal{Side::at_most, 0.01, 0.001}},
      {{"area_change_percent", "Area (%)"}, change("area"), 2, Goal{Side::at_most, 3, 1.5}},
  };
}

/// Of the meshes that are held against their level set at all.
Measured level_set_ratio() {
  return {{"level_set_distance_ratio", "Distance to the level set (× before)"},
          ratio("/level_set_distance/after/mean", "/level_set_distance/before/mean"),
          3,
          Goal{Side::at_most, 1.5, 1},
          {},
          [](const Json& record) { return has_value(record, "/level_set_distance"); }};
}

/// "0.98 (12 samples without a foot)"
Judged with_unresolved(Judged judged, const Json& record) {
  const double unresolved = number_at(&record, "/level_set_distance/after/unresolved").value_or(0);
  if (unresolved == 0) return judged;
  judged.text += fmt::format(" ({:.0f} {} without a foot)", unresolved, unresolved == 1 ? "sample" : "samples");
  if (unresolved <= kMostUnresolvedShare * static_cast<double>(kLevelSetSamples)) return judged;
  judged.verdict = Verdict::missed;
  judged.detail = fmt::format("more than {} % of the samples have no foot and are not in the mean", kPerCent * kMostUnresolvedShare);
  return judged;
}

Quantity level_set_quantity() {
  Quantity result = quantity(level_set_ratio());
  result.judge = [judge = std::move(result.judge)](const Json& record) { return with_unresolved(judge(record), record); };
  return result;
}

/// What TetGen stumbles over.
std::vector<Measured> measured_readiness() {
  return {{{"smallest_dihedral_deg", "Smallest angle between neighbours (°)"}, at("/tetgen_ready/smallest_dihedral_deg"), 2, {}},
          {{"vertex_spacing_ppm", "Closest vertices (10⁻⁶ of the diagonal)"}, at("/tetgen_ready/vertex_spacing", kPerMillion), 2, {}}};
}

Measured deviation_in_angstroms() {
  return {{"deviation_A", "Deviation from the input (Å)"}, at("/distance_to_input/largest"), 3, {}};
}

Measured deviation_of_diagonal() {
  return {{"deviation_percent", "Deviation from the input (% of the diagonal)"},
          [of = ratio("/distance_to_input/largest", "/distance_to_input/diagonal")](const Json& record) {
            const Number value = of(record);
            return value ? Number(kPerCent * *value) : Number();
          },
          3,
          {}};
}

/// `most_vertices`: of the meshes on which it must succeed.
Quantity tetgen_quantity(const std::string& switches, double most_vertices) {
  const auto judge = [=](const Json& record) {
    const std::string pointer = "/tetgen/" + switches;
    const auto status = text_at(&record, pointer + "/status");
    if (!status) return Judged();
    if (*status == "success")
      return Judged{fmt::format("{:.1f} s", number_at(&record, pointer + "/seconds").value_or(0)), Verdict::aim, ""};
    const bool is_must = has_at_most(record, most_vertices);
    return Judged{"failed", is_must ? Verdict::missed : Verdict::not_judged, text_at(&record, pointer + "/reason").value_or("")};
  };
  return {{"tetgen_" + switches, "TetGen -" + switches}, "", judge};
}

/// Of the reference method's solver; nothing where it did not converge, or was not run.
Number reference_iterations(const Json& record) {
  const bool has_converged = text_at(&record, "/reference/solvation/status") == "success";
  return has_converged ? number_at(&record, "/reference/solvation/iterations") : Number();
}

/// Iterations beside those on the reference method's mesh, which must not be fewer; not judged where there are none.
Judged judge_solvation(const Json& record) {
  const std::string status = text_at(&record, "/solvation/status").value_or("not computed");
  if (status == "not computed") return {};
  const Number iterations = number_at(&record, "/solvation/iterations"), reference = reference_iterations(record);
  const std::string beside = reference ? fmt::format(" ({:.0f})", *reference) : " (—)";
  if (status != "success" || !iterations) return {status + beside, Verdict::missed, text_at(&record, "/solvation/reason").value_or("")};
  if (!reference) return {fmt::format("{:.0f}", *iterations) + beside, Verdict::not_judged, ""};
  const bool is_more = *iterations > *reference;
  return {fmt::format("{:.0f}", *iterations) + beside, is_more ? Verdict::missed : Verdict::aim, is_more ? "more iterations" : ""};
}

/// Judged on the meshes of a size alone.
Quantity seconds_quantity(Measured measured, const SizeBand& band) {
  measured.is_judged = [band](const Json& record) { return band.has(record); };
  Quantity result = quantity(std::move(measured));
  result.applies_to = band.text;
  result.goal += fmt::format(" ({})", band.text);
  return result;
}

/// Ready meshes have no goal.
std::vector<Quantity> seconds_quantities(StudiedMeshes meshes) {
  Measured one{{"seconds_1_thread", "Seconds, one thread"}, at("/cpu_seconds/total"), 2, Goal{Side::at_most, 2, 0.6}};
  Measured two{{"seconds_2_threads", "Seconds, two threads"}, at("/two_threads/seconds"), 2, Goal{Side::at_most, 30, 8}};
  if (meshes == StudiedMeshes::molecules)
    return {seconds_quantity(std::move(one), kMonomerBand), seconds_quantity(std::move(two), kMillionBand)};
  one.goal.reset();
  two.goal.reset();
  return {quantity(std::move(one)), quantity(std::move(two))};
}

Judged judge_bytes(const Json& record) {
  const nlohmann::ordered_json::json_pointer pointer("/two_threads/same_bytes");
  if (!record.contains(pointer)) return {};
  return record.at(pointer).get<bool>() ? Judged{"same", Verdict::aim, ""} : Judged{"others", Verdict::missed, ""};
}

}  // namespace

std::vector<Quantity> shape_quantities(StudiedMeshes meshes) {
  const bool is_molecule = meshes == StudiedMeshes::molecules;
  std::vector<Quantity> quantities;
  for (Measured& m : measured_shape()) {
    if (!is_molecule && m.head.id != "intersecting_pairs") m.goal.reset();
    quantities.push_back(quantity(std::move(m)));
  }
  if (is_molecule) quantities.push_back(level_set_quantity());
  quantities.push_back(quantity(is_molecule ? deviation_in_angstroms() : deviation_of_diagonal()));
  return quantities;
}

std::vector<Quantity> use_quantities(StudiedMeshes meshes) {
  std::vector<Quantity> quantities;
  for (Measured& m : measured_readiness()) quantities.push_back(quantity(std::move(m)));
  for (const char* switches : {"p", "pY"}) quantities.push_back(tetgen_quantity(switches, HUGE_VAL));
  quantities.push_back(tetgen_quantity(kQualitySwitches, kMonomerBand.most));
  if (meshes == StudiedMeshes::molecules)
    quantities.push_back({{"solvation_iterations", "Solvation iterations (on SMOPT's mesh)"}, "", judge_solvation});
  for (Quantity& seconds : seconds_quantities(meshes)) quantities.push_back(std::move(seconds));
  quantities.push_back({{"same_bytes", "Bytes on two threads"}, "", judge_bytes});
  quantities.push_back(quantity({{"peak_memory_mb", "Peak memory (MB)"}, at("/peak_memory_mb"), 0, {}}));
  return quantities;
}

std::vector<Quantity> unmeasured(std::span<const Quantity> quantities, std::span<const Json> records) {
  std::vector<Quantity> result;
  for (const Quantity& quantity : quantities) {
    const bool is_measured = std::ranges::any_of(
        records, [&](const Json& record) { return is_done(&record) && quantity.judge(record).verdict != Verdict::not_judged; });
    if (!quantity.applies_to.empty() && !is_measured) result.push_back(quantity);
  }
  return result;
}

std::string marked(const Judged& judged) {
  switch (judged.verdict) {
    case Verdict::missed:
      return fmt::format("**{} ✗**", judged.text);
    case Verdict::aim:
      return judged.text + " ✓";
    case Verdict::must:
    case Verdict::not_judged:
      break;
  }
  return judged.text;
}

}  // namespace smopt::experiments
