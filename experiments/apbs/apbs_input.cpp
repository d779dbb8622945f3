#include "experiments/apbs/apbs_input.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "smopt/error.h"

namespace smopt::experiments {
namespace {

constexpr double kKilojoulesPerKilocalorie = 4.184;
constexpr double kMolarPerMillimolar = 1e-3;

/// Between the atoms' spheres and the box at least, Å: more than a Debye length at 150 mM. From 6 to 20 Å the energy of fas2 changes by less than
/// by the spacing that goes with it.
constexpr double kMargin = 10;

/// The coarser box is this much longer than the molecule: what PDB2PQR's psize takes.
constexpr double kCoarseFactor = 1.7;

/// APBS's multigrid wants c·2⁵ + 1 nodes an axis.
constexpr int kNodeStep = 32;

constexpr double kProbeRadius = 1.4;      ///< Å, of a water molecule
constexpr int kSurfacePointDensity = 10;  ///< per Å², of the spheres that the probe's surface is made of: APBS's examples' value

struct SurfaceKeywords {
  ApbsSurface surface;
  std::string_view name;
  std::string_view srfm;
  double srad;
};
constexpr std::array<SurfaceKeywords, 4> kSurfaces = {{{ApbsSurface::molecular, "molecular", "mol", kProbeRadius},
                                                       {ApbsSurface::smoothed_molecular, "molecular, smoothed", "smol", kProbeRadius},
                                                       {ApbsSurface::van_der_waals, "van der Waals", "mol", 0},
                                                       {ApbsSurface::gaussian, "Gaussian", "mol", 0}}};

const SurfaceKeywords& keywords_of(ApbsSurface surface) {
  return kSurfaces.at(static_cast<std::size_t>(surface));
}

std::string axes(const Vec3& v) {
  return fmt::format("{:.8f} {:.8f} {:.8f}", v.x(), v.y(), v.z());
}

std::string ions(double millimolar) {
  if (millimolar == 0) return {};
  const double molar = kMolarPerMillimolar * millimolar;
  return fmt::format("  ion charge 1 conc {0} radius 0\n  ion charge -1 conc {0} radius 0\n", molar);
}

/// One grid for a surface that is given by maps, which cover no more; else a coarser one around it.
std::string grid_text(ApbsSurface surface, const ApbsGrid& grid) {
  const std::string nodes = fmt::format("  dime {} {} {}\n", grid.nodes[0], grid.nodes[1], grid.nodes[2]);
  if (surface == ApbsSurface::gaussian)
    return fmt::format("  mg-manual\n{}  glen {}\n  gcent {}\n", nodes, axes(grid.length()), axes(grid.center));
  return fmt::format("  mg-auto\n{}  cglen {}\n  fglen {}\n  cgcent {}\n  fgcent {}\n", nodes, axes(grid.coarse_length),
                     axes(grid.length()), axes(grid.center), axes(grid.center));
}

/// One calculation. \param maps  lines that make it use maps
std::string section(std::string_view name, const metrics::DielectricModel& medium, ApbsSurface surface, const ApbsGrid& grid,
                    std::string_view maps) {
  const SurfaceKeywords& keywords = keywords_of(surface);
  return fmt::format(
      "elec name {}\n{}  mol 1\n  lpbe\n  bcfl sdh\n{}"
      "  pdie {}\n  sdie {}\n  srfm {}\n  srad {}\n  sdens {}\n  swin 0.3\n  chgm spl2\n  temp {}\n  calcenergy total\n  calcforce "
      "no\n{}end\n",
      name, grid_text(surface, grid), ions(medium.ionic_strength), medium.inner, medium.outer, keywords.srfm, keywords.srad,
      kSurfacePointDensity, medium.temperature, maps);
}

std::string reading_text(std::string_view pqr, ApbsSurface surface) {
  const std::string maps = surface == ApbsSurface::gaussian
                               ? fmt::format("  diel dx {} {} {}\n  kappa dx {}\n", kApbsMaps[0], kApbsMaps[1], kApbsMaps[2], kApbsMaps[3])
                               : "";
  return fmt::format("read\n  mol pqr {}\n{}end\n", pqr, maps);
}

std::string map_use(ApbsSurface surface, bool has_ions) {
  if (surface != ApbsSurface::gaussian) return {};
  return has_ions ? "  usemap diel 1\n  usemap kappa 1\n" : "  usemap diel 1\n";
}

}  // namespace

std::string_view to_string(ApbsSurface surface) {
  return keywords_of(surface).name;
}

double ApbsGrid::memory_mb(ApbsSurface surface) const {
  constexpr double kBytesPerNode = 230, kBytesPerMb = 1 << 20, kAnywayMb = 120;
  constexpr double kMapBytesPerNode = kApbsMaps.size() * sizeof(double);
  return kAnywayMb + (kBytesPerNode + (surface == ApbsSurface::gaussian ? kMapBytesPerNode : 0)) * node_count() / kBytesPerMb;
}

ApbsGrid apbs_grid(const Molecule& molecule, double spacing) {
  constexpr double kMostNodes = 1e5;  // along an axis: 1e15 in all
  if (!(spacing > 0)) throw InvalidOption(fmt::format("APBS: the spacing must be positive, not {}", spacing));
  Vec3 low = molecule.centers.front(), high = low;
  for (std::size_t i = 0; i < molecule.atom_count(); ++i) {
    low = low.cwiseMin(molecule.centers[i] - Vec3::Constant(molecule.radii[i]));
    high = high.cwiseMax(molecule.centers[i] + Vec3::Constant(molecule.radii[i]));
  }
  ApbsGrid grid;
  grid.spacing = spacing;
  grid.center = (low + high) / 2;
  for (int axis = 0; axis < 3; ++axis) {
    const double steps = std::ceil((high[axis] - low[axis] + 2 * kMargin) / spacing / kNodeStep);
    if (!(kNodeStep * steps < kMostNodes))
      throw InvalidOption(fmt::format("APBS: a spacing of {} Å is too small for this molecule", spacing));
    grid.nodes.at(static_cast<std::size_t>(axis)) = kNodeStep * static_cast<int>(steps) + 1;
  }
  grid.coarse_length = (kCoarseFactor * (high - low)).cwiseMax(grid.length());
  return grid;
}

std::string apbs_input(std::string_view pqr, const metrics::DielectricModel& medium, ApbsSurface surface, const ApbsGrid& grid) {
  metrics::DielectricModel reference = medium;
  reference.outer = medium.inner;
  reference.ionic_strength = 0;
  return fmt::format("{}{}{}print elecEnergy solvated - reference end\nquit\n", reading_text(pqr, surface),
                     section("solvated", medium, surface, grid, map_use(surface, medium.ionic_strength > 0)),
                     section("reference", reference, surface, grid, ""));
}

std::string format_pqr(const Molecule& molecule) {
  std::string text;
  for (std::size_t i = 0; i < molecule.atom_count(); ++i) {
    const Vec3& x = molecule.centers[i];
    text += fmt::format("ATOM {} C MOL 1 {:.6f} {:.6f} {:.6f} {:.6f} {:.6f}\n", i + 1, x.x(), x.y(), x.z(), molecule.charges[i],
                        molecule.radii[i]);
  }
  return text;
}

double parse_apbs_energy(std::string_view output) {
  constexpr std::string_view kLabel = "Global net ELEC energy =";
  const std::size_t label = output.rfind(kLabel);
  const std::size_t number = label == output.npos ? output.npos : output.find_first_not_of(' ', label + kLabel.size());
  double kilojoules = 0;
  if (number == output.npos || std::from_chars(output.data() + number, output.data() + output.size(), kilojoules).ec != std::errc() ||
      !std::isfinite(kilojoules))
    throw MethodFailed("APBS: printed no energy");
  return kilojoules / kKilojoulesPerKilocalorie;
}

}  // namespace smopt::experiments
