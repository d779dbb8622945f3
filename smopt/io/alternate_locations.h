#pragma once

#include <cstddef>
#include <vector>

#include "smopt/io/atom_site.h"

namespace smopt {

/// Leaves each atom one location: the one without a label where there is one, otherwise that of the highest occupancy, the first of equals.
/// Where a residue is several at once (microheterogeneity), the one with the highest occupancy stays, the first of equals, so that no
/// mixture of two remains.
///
/// Atoms of the same name and label are not alternatives, and all stay: names are not unique in every file. Only sites with a label
/// (`AtomSite::alternate`) are ever removed; the order stays. \return how many were removed. Cost: O(sites).
std::size_t remove_alternate_locations(std::vector<AtomSite>& sites);

}  // namespace smopt
