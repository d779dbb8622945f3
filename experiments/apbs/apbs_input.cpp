#include "experiments/apbs/apbs_input.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "smopt/error.h"

namespace smopt::experiments {
namespace {

constexpr double kKilojoulesPerKilocalorie = 4.184;
constexpr double kMolarPerMillimolar = 1e-3;

/// Between the atoms' spheres and the finer box, Å: more than a Debye length at 150 mM. From 6 to 20 Å the energy of fas2 changes by less than the
/// spacing does that goes with it.
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
constexpr std::array<SurfaceKeywords, 3> kSurfaces = {{{ApbsSurface::molecular, "molecular", "mol", kProbeRadius},
                                                       {ApbsSurface::smoothed_molecular, "molecular, smoothed", "smol", kProbeRadius},
                                                       {ApbsSurface::van_der_waals, "van der Waals", "mol", 0}}};

const SurfaceKeywords& keywords_of(ApbsSurface surface) {
  return kSurfaces.at(static_cast<std::size_t>(surface));
}

std::string axes(const Vec3& v) {
  return fmt::format("{:.4f} {:.4f} {:.4f}", v.x(), v.y(), v.z());
}

std::string ions(double millimolar) {
  if (millimolar == 0) return {};
  const double molar = kMolarPerMillimolar * millimolar;
  return fmt::format("  ion charge 1 conc {0} radius 0\n  ion charge -1 conc {0} radius 0\n", molar);
}

/// One calculation.
std::string section(std::string_view name, const metrics::DielectricModel& medium, ApbsSurface surface, const ApbsGrid& grid) {
  const SurfaceKeywords& keywords = keywords_of(surface);
  return fmt::format(
      "elec name {}\n  mg-auto\n  mol 1\n  dime {} {} {}\n  cglen {}\n  fglen {}\n  cgcent mol 1\n  fgcent mol 1\n  lpbe\n  bcfl sdh\n{}"
      "  pdie {}\n  sdie {}\n  srfm {}\n  srad {}\n  sdens {}\n  swin 0.3\n  chgm spl2\n  temp {}\n  calcenergy total\n  calcforce "
      "no\nend\n",
      name, grid.nodes[0], grid.nodes[1], grid.nodes[2], axes(grid.coarse_length), axes(grid.fine_length), ions(medium.ionic_strength),
      medium.inner, medium.outer, keywords.srfm, keywords.srad, kSurfacePointDensity, medium.temperature);
}

}  // namespace

std::string_view to_string(ApbsSurface surface) {
  return keywords_of(surface).name;
}

Vec3 ApbsGrid::spacing() const {
  return {fine_length.x() / (nodes[0] - 1), fine_length.y() / (nodes[1] - 1), fine_length.z() / (nodes[2] - 1)};
}

double ApbsGrid::memory_mb() const {
  constexpr double kBytesPerNode = 230, kBytesPerMb = 1 << 20, kAnywayMb = 120;
  return kAnywayMb + kBytesPerNode * nodes[0] * nodes[1] * nodes[2] / kBytesPerMb;
}

ApbsGrid apbs_grid(const Molecule& molecule, double spacing) {
  if (!(spacing > 0)) throw InvalidOption(fmt::format("APBS: the spacing must be positive, not {}", spacing));
  Vec3 low = molecule.centers.front(), high = low;
  for (std::size_t i = 0; i < molecule.atom_count(); ++i) {
    low = low.cwiseMin(molecule.centers[i] - Vec3::Constant(molecule.radii[i]));
    high = high.cwiseMax(molecule.centers[i] + Vec3::Constant(molecule.radii[i]));
  }
  ApbsGrid grid;
  grid.fine_length = high - low + Vec3::Constant(2 * kMargin);
  grid.coarse_length = (kCoarseFactor * (high - low)).cwiseMax(grid.fine_length);
  for (int axis = 0; axis < 3; ++axis) {
    const int steps = static_cast<int>(std::ceil(grid.fine_length[axis] / spacing / kNodeStep));
    grid.nodes.at(static_cast<std::size_t>(axis)) = kNodeStep * steps + 1;
  }
  return grid;
}

std::string apbs_input(std::string_view pqr, const metrics::DielectricModel& medium, ApbsSurface surface, const ApbsGrid& grid) {
  metrics::DielectricModel reference = medium;
  reference.outer = medium.inner;
  reference.ionic_strength = 0;
  return fmt::format("read\n  mol pqr {}\nend\n{}{}print elecEnergy solvated - reference end\nquit\n", pqr,
                     section("solvated", medium, surface, grid), section("reference", reference, surface, grid));
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
