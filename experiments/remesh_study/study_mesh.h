#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "experiments/datasets.h"
#include "experiments/level_set_run.h"
#include "experiments/remesh_study/case_run.h"
#include "smopt/io/molecule.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt::experiments {

/// A mesh that the study runs methods on, with what is known of it: of a molecule's, the level set that it stands for.
struct StudyMesh {
  Dataset dataset;       ///< of a ready mesh: its name and its file
  TriangleMesh initial;  ///< as generated, or as read
  JudgedMesh input;      ///< without its cavities: what every method is given
  std::optional<Molecule> molecule;
  std::optional<LevelSet> level_set;
  std::optional<LevelSetDistance> input_distance;  ///< of `input` to the level set
};

/// Generates the molecule's surface. \throws InvalidInput
StudyMesh study_mesh_of(const Dataset& dataset);

/// A mesh that is there. \throws InvalidMesh where it is not a closed manifold.
StudyMesh study_mesh_of(const std::string& name, const std::filesystem::path& file, TriangleMesh mesh);

/// The molecule's surface so many times that the copies have about as many vertices without their cavities, side by side, further apart than it
/// is long. It stands for no molecule. \throws InvalidInput
StudyMesh study_copies_of(const Dataset& dataset, std::size_t vertices);

/// A dataset for each molecule file (.pqr, .pqr.gz) in a folder, by name, meshed as the experiments' own molecules are. \throws InvalidInput
/// where there is no such folder.
std::vector<Dataset> datasets_in(const std::filesystem::path& folder);

}  // namespace smopt::experiments
