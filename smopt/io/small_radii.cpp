#include "smopt/io/small_radii.h"

#include <fmt/format.h>

#include <cmath>

#include "smopt/error.h"

namespace smopt {

std::size_t raise_small_radii(Molecule& molecule, double threshold, double raised) {
  if (!(threshold >= 0) || !(raised >= threshold) || !std::isfinite(raised))
    throw InvalidOption(
        fmt::format("radii below {} Å cannot become {} Å: the former must not be negative, the latter not be less", threshold, raised));
  std::size_t changed = 0;
  for (double& radius : molecule.radii) {
    if (radius >= threshold) continue;
    radius = raised;
    ++changed;
  }
  return changed;
}

}  // namespace smopt
