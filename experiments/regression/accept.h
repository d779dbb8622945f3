#pragma once

#include <filesystem>
#include <vector>

#include "experiments/regression/compare.h"

namespace smopt::experiments {

/// Makes the run's records of compared and new cases those of the reference; its other records stay. A case that the run could not run for want of
/// a program ("not installed") is left as it was. The reference's records are replaced all at once: whenever it is looked at, or the program is
/// killed, they are all the old ones or all the new ones.
/// \return the cases whose records are not the same bytes as before.
/// \throws InvalidOption when both folders are the same; std::filesystem::filesystem_error when something cannot be written: then the reference is
/// as it was.
std::vector<CaseName> accept(const std::filesystem::path& run, const std::filesystem::path& reference, const Comparison& comparison);

}  // namespace smopt::experiments
