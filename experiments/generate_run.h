#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "smopt/improve/cavities.h"
#include "smopt/io/molecule.h"
#include "smopt/progress.h"
#include "smopt/surface/gaussian_surface.h"

namespace smopt::experiments {

/// TMSmesh's rule for small radii: those below this become `GenerateRun::min_radius`, ångström.
inline constexpr double kSmallRadius = 0.5;

/// From one molecule's file to one mesh file.
struct GenerateRun {
  std::filesystem::path molecule;
  std::filesystem::path output;
  MoleculeReadOptions reading;
  double min_radius = 0.6;  ///< what radii below 0.5 Å (or below this, if it is less) become; 0: they stay; TMSmesh's default
  GaussianSurfaceOptions surface;
  CavityPolicy components = CavityPolicy::keep;
  bool improve = false;            ///< SMOPT with its defaults (the paper: it "has been incorporated into TMSmesh 2.0")
  bool project = false;            ///< bring the vertices onto φ = c, after the improvement
  bool measures_distance = false;  ///< of the vertices to φ = c, for the report
  int repeats = 1;                 ///< of everything, for the times; ≥ 1
  int digits = 0;                  ///< see MeshWriteOptions
};

struct GenerateRunResult {
  nlohmann::ordered_json report;   ///< what `generate --report` writes
  std::vector<std::string> notes;  ///< what was assumed of the molecule, a sentence each
};

/// Reads, raises small radii, makes the surface, chooses components, improves, projects and writes. Nothing is written when anything fails.
/// \throws InvalidInput naming the file; InvalidOption; Cancelled.
GenerateRunResult run_generation(const GenerateRun& run, const ProgressCallback& progress = {});

/// "all", "outer" (without cavities and what is in them) or "main" (the largest outer one). \throws InvalidOption for anything else.
CavityPolicy parse_components(std::string_view text);

/// Raises the radii of a molecule as `min_radius` says. \return how many.
std::size_t raise_radii(Molecule& molecule, double min_radius);

}  // namespace smopt::experiments
