#pragma once

#include <string>
#include <vector>

#include "experiments/record.h"
#include "experiments/remesh_study/mesh_choice.h"

namespace smopt::experiments {

/// All records of the study.
struct RemeshStudy {
  std::vector<Json> molecules;            ///< the studied method's, one a molecule
  std::vector<Json> ready;                ///< the studied method's, one a ready mesh
  std::vector<MeshCandidate> candidates;  ///< the ready meshes that were looked at, taken or left
  std::string archive;                    ///< of which ready meshes were chosen; empty: of none
  std::string folder;                     ///< of which all were taken; empty: of none
  std::vector<Json> compared;             ///< every method's on some molecules
  std::vector<Json> ablations;            ///< the studied method's on the same molecules, whole and with a part left out
  std::string figure;                     ///< the file of the figure of all methods, relative to the page; empty: none was drawn
};

/// The page results/smopt2.md. \param command  by which it was made.
std::string study_page(const RemeshStudy& study, const std::string& command);

/// Every record, without what would make it long (histograms, each round, each repeat).
Json study_json(const RemeshStudy& study);

}  // namespace smopt::experiments
