#include <fmt/format.h>

#include <cmath>

#include "smopt/error.h"
#include "smopt/improve/remesh/remesh.h"

namespace smopt {
namespace {

void require(bool is_valid, const char* name, const char* expected, double given) {
  if (!is_valid) throw InvalidOption(fmt::format("{}: expected {}, got {}", name, expected, given));
}

}  // namespace

void require_valid(const RemeshOptions& options) {
  const RemeshGoals& goals = options.goals;
  require(goals.min_angle_deg > 0 && goals.min_angle_deg < 60, "min-angle", "degrees in (0, 60)", goals.min_angle_deg);
  require(goals.max_angle_deg > 60 && goals.max_angle_deg < 180, "max-angle", "degrees in (60, 180)", goals.max_angle_deg);
  require(goals.edge_ratio >= 0 && goals.edge_ratio < 1, "edge-ratio", "a number in [0, 1)", goals.edge_ratio);
  require(goals.min_dihedral_deg >= 0 && goals.min_dihedral_deg < 180, "min-dihedral", "degrees in [0, 180)", goals.min_dihedral_deg);
  require(goals.valence_spread >= 0, "valence", "at least 0", goals.valence_spread);
  require(options.rounds >= 0, "rounds", "at least 0", options.rounds);
  require(options.repairs >= 0, "repairs", "at least 0", options.repairs);
  require(options.refinements >= 0, "refinements", "at least 0", options.refinements);
  require(options.edge_length >= 0 && std::isfinite(options.edge_length), "edge-length", "a length", options.edge_length);
  require(options.chord_error > 0 && std::isfinite(options.chord_error), "error", "a positive length", options.chord_error);
  require(options.deviation > 0, "deviation", "a positive length", options.deviation);
}

void RemeshReport::append(const RemeshReport& next) {
  flips += next.flips;
  collapses += next.collapses;
  splits += next.splits;
  moves += next.moves;
  rounds += next.rounds;
  repairs += next.repairs;
  refinements += next.refinements;
  volume_owed += next.volume_owed;
  goals = next.goals;
  stopped_because = next.stopped_because;
}

}  // namespace smopt
