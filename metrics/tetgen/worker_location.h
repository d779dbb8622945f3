#pragma once

#include <filesystem>

namespace smopt::metrics {

/// The program that runs TetGen: the file that the environment variable SMOPT_TETGEN_WORKER names; else `smopt-tetgen-worker` beside the
/// running program; else in ../libexec/smopt/ seen from there (where it is installed). \throws InvalidInput saying where it was looked for.
std::filesystem::path find_tetgen_worker();

}  // namespace smopt::metrics
