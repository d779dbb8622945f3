#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/datasets.h"
#include "experiments/remesh_study/study_page.h"
#include "smopt/improve/method.h"

namespace smopt::experiments {

/// The dataset of which copies are made.
inline constexpr const char* kCopied = "ache-monomer";

/// What the study runs.
struct RemeshStudyOptions {
  std::string method = "smopt2";      ///< the case that is studied
  std::string reference = "smopt";    ///< the case whose solvation iterations it must not exceed
  std::vector<Dataset> datasets;      ///< molecules
  std::vector<std::string> compared;  ///< names of those on which every method and every ablation is run
  std::filesystem::path meshes;       ///< a folder of ready meshes, all taken; empty: none
  std::filesystem::path archive;      ///< an archive of ready meshes, chosen by MeshChoiceRule; empty: none
  bool with_solvation = true;         ///< minutes for the larger molecules
  /// Vertices of the copies of `kCopied` that are studied, too, where it is among the datasets: the size that the goal for two threads is for.
  /// 0: none.
  std::size_t copied_vertices = 1'000'000;
};

/// Told what comes next, a line each time.
using RemeshStudyLog = std::function<void(const std::string&)>;

/// Runs the study. A case that fails is a record with its reason; so is a molecule or a mesh of which nothing can be made. \throws InvalidOption when
/// a compared name is none of the datasets'; InvalidInput for a folder or an archive that cannot be read.
RemeshStudy run_remesh_study(const RemeshStudyOptions& options, const MethodRegistry& registry, const RemeshStudyLog& tell);

}  // namespace smopt::experiments
