#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "experiments/record_set.h"
#include "smopt/io/scratch_folder.h"

namespace smopt::experiments {

/// The molecule that Figure 4 shows: that of this name; where none is named the paper's, the AChE monomer; where that is not in the run the
/// first. \throws InvalidOption when the run has no molecule of this name. \pre the run has records
std::string figure4_molecule(const RecordSet& records, const std::string& wanted);

/// What Figure 4 is drawn of: {"molecule", "panels": [{"method", "mesh"}, …], "pair": {"faces", "crossing", "towards", "centre", "radius"},
/// "why_no_pair"}. The meshes that the run still has (see find_mesh) are written to `folder` as binary PLY, the others are null; the pair is
/// null where ISO2mesh's mesh has none that can be shown. \return nothing where the run has none of the meshes. \throws InvalidInput when one
/// cannot be read. Cost: that of counting the pairs of one mesh.
std::optional<nlohmann::ordered_json> figure4_input(const std::filesystem::path& directory, const std::string& molecule,
                                                    const ScratchFolder& folder);

}  // namespace smopt::experiments
