#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "experiments/record.h"
#include "experiments/tables/table.h"

namespace smopt::experiments {

/// What a number is against its goal.
enum class Verdict {
  not_judged,  ///< it has no goal, or none for a mesh of this size
  missed,      ///< the must is missed
  must,        ///< the must is met, the aim is not
  aim          ///< the aim is reached
};

/// A number of a result, held against its goal.
struct Judged {
  std::string text = "—";  ///< as in the table, without its mark
  Verdict verdict = Verdict::not_judged;
  std::string detail;  ///< where a must is missed: the place, the reason, as far as they are known
};

/// A column of the study's tables, and what stands in a record's row.
struct Quantity {
  Column head;
  std::string goal;                          ///< "≥ 15, aim ≥ 30", with `applies_to`; empty where there is none, or it is no number
  std::function<Judged(const Json&)> judge;  ///< of a record that is done
  std::string applies_to = {};               ///< "60 000 to 75 000 vertices"; empty: to a mesh of any size
};

/// Whose records are judged: a molecule's have a level set and a solvation energy, those of a ready mesh have none, and their shape is reported, not
/// judged, but for pairs and TetGen.
enum class StudiedMeshes { molecules, ready };

/// Vertices, pairs, angles, valence, what is kept of volume, area and level set.
std::vector<Quantity> shape_quantities(StudiedMeshes meshes);

/// What the mesh is good for and what it costs: TetGen, solvation, seconds, memory.
std::vector<Quantity> use_quantities(StudiedMeshes meshes);

/// Those whose goal is for meshes of a certain size, of which none of the records is one that is done: nothing is known of the goal.
std::vector<Quantity> unmeasured(std::span<const Quantity> quantities, std::span<const Json> records);

/// "**12.3 ✗**" where the must is missed, "31.2 ✓" where the aim is reached, "20.0" between.
std::string marked(const Judged& judged);

}  // namespace smopt::experiments
