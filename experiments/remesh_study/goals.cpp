#include "experiments/remesh_study/goals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "experiments/record_set.h"
#include "experiments/tetgen_run.h"

namespace smopt::experiments {
namespace {

using Number = std::optional<double>;

constexpr double kPerCent = 100;

/// Meshes to which the goals for 65 000 vertices apply: the experiments' monomer has 60 000 to 75 000.
constexpr double kMostVerticesOfMonomer = 75'000;

/// Meshes to which the goal for a million vertices applies.
constexpr double kMostVerticesOfMillion = 1'100'000;

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

Measured level_set_ratio() {
  return {{"level_set_distance_ratio", "Distance to the level set (× before)"},
          ratio("/level_set_distance/after/mean", "/level_set_distance/before/mean"),
          3,
          Goal{Side::at_most, 1.5, 1}};
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

/// Iterations beside those on the reference method's mesh, which must not be fewer.
Judged judge_solvation(const Json& record) {
  const std::string status = text_at(&record, "/solvation/status").value_or("not computed");
  if (status == "not computed") return {};
  const Number iterations = number_at(&record, "/solvation/iterations"), reference = number_at(&record, "/reference/solvation/iterations");
  const std::string beside = reference ? fmt::format(" ({:.0f})", *reference) : " (—)";
  if (status != "success" || !iterations) return {status + beside, Verdict::missed, text_at(&record, "/solvation/reason").value_or("")};
  const bool is_more = reference && *iterations > *reference;
  return {fmt::format("{:.0f}", *iterations) + beside, is_more ? Verdict::missed : Verdict::aim, is_more ? "more iterations" : ""};
}

/// `most_vertices`: of the meshes that must be as fast.
Quantity seconds_quantity(Column head, const std::string& pointer, Goal goal, double most_vertices) {
  Measured measured{std::move(head), at(pointer), 2, goal};
  measured.is_judged = [most_vertices](const Json& record) { return has_at_most(record, most_vertices); };
  return quantity(std::move(measured));
}

Judged judge_bytes(const Json& record) {
  const nlohmann::ordered_json::json_pointer pointer("/two_threads/same_bytes");
  if (!record.contains(pointer)) return {};
  return record.at(pointer).get<bool>() ? Judged{"same", Verdict::aim, ""} : Judged{"others", Verdict::missed, ""};
}

}  // namespace

std::vector<Quantity> shape_quantities(StudiedMeshes meshes) {
  std::vector<Measured> measured = measured_shape();
  if (meshes == StudiedMeshes::molecules) {
    measured.push_back(level_set_ratio());
    measured.push_back(deviation_in_angstroms());
  } else {
    for (Measured& m : measured)
      if (m.head.id != "intersecting_pairs") m.goal.reset();
    measured.push_back(deviation_of_diagonal());
  }
  std::vector<Quantity> quantities;
  for (Measured& m : measured) quantities.push_back(quantity(std::move(m)));
  return quantities;
}

std::vector<Quantity> use_quantities(StudiedMeshes meshes) {
  std::vector<Quantity> quantities = {tetgen_quantity("p", HUGE_VAL), tetgen_quantity("pY", HUGE_VAL),
                                      tetgen_quantity(kQualitySwitches, kMostVerticesOfMonomer)};
  if (meshes == StudiedMeshes::molecules)
    quantities.push_back({{"solvation_iterations", "Solvation iterations (on SMOPT's mesh)"}, "", judge_solvation});
  const bool is_judged = meshes == StudiedMeshes::molecules;
  quantities.push_back(seconds_quantity({"seconds_1_thread", "Seconds, one thread"}, "/cpu_seconds/total", {Side::at_most, 2, 0.6},
                                        is_judged ? kMostVerticesOfMonomer : 0));
  quantities.push_back(seconds_quantity({"seconds_2_threads", "Seconds, two threads"}, "/two_threads/seconds", {Side::at_most, 30, 8},
                                        is_judged ? kMostVerticesOfMillion : 0));
  quantities.push_back({{"same_bytes", "Bytes on two threads"}, "", judge_bytes});
  return quantities;
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
