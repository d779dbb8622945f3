#include "smopt/io/atom_site.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "smopt/error.h"
#include "smopt/io/alternate_locations.h"
#include "smopt/io/text_reader.h"

namespace smopt {
namespace {

/// Residue names of water: the PDB's own (HOH, DOD) and those of the usual programs and force fields.
constexpr std::array<std::string_view, 16> kWaters = {"HOH",  "DOD",  "WAT", "H2O", "OH2", "TIP", "TIP2", "TIP3",
                                                      "TIP4", "TIP5", "TP3", "T3P", "T4P", "SOL", "SPC",  "SPCE"};

bool is_water(const AtomSite& site) {
  return std::ranges::find(kWaters, site.residue) != kWaters.end();
}

std::size_t remove_waters(std::vector<AtomSite>& sites, const std::string& name) {
  const std::size_t waters = std::erase_if(sites, is_water);
  if (waters > 0 && sites.empty()) throw InvalidInput(fmt::format("{}: all {} atoms are water's, which is left out", name, waters));
  return waters;
}

std::string why_no_radius(const AtomSite& site, RadiusSet set) {
  if (site.element.empty()) return fmt::format("the element of atom {} is missing", quoted(site.atom));
  if (!is_element(site.element)) return fmt::format("{} is not an element", quoted(site.element));
  return fmt::format("the radius set \"{}\" has no radius for element {}", radius_set_name(set), site.element);
}

Molecule with_radii(const std::vector<AtomSite>& sites, const std::string& name, RadiusSet set) {
  Molecule molecule;
  molecule.centers.reserve(sites.size());
  molecule.radii.reserve(sites.size());
  for (const AtomSite& site : sites) {
    const std::optional<double> radius = element_radius(site.element, set);
    if (!radius) throw InvalidInput(fmt::format("{}:{}: {}", name, site.line, why_no_radius(site, set)));
    molecule.centers.push_back(site.center);
    molecule.radii.push_back(*radius);
  }
  molecule.charges.resize(sites.size(), 0.0);
  return molecule;
}

}  // namespace

Molecule molecule_of(std::vector<AtomSite> sites, const std::string& name, const MoleculeReadOptions& options, MoleculeReadReport& report) {
  const std::size_t waters = options.keep_waters ? 0 : remove_waters(sites, name);
  const std::size_t alternates = remove_alternate_locations(sites);
  Molecule molecule = with_radii(sites, name, options.radius_set);
  report.notes.push_back(fmt::format("radii by element (set \"{}\"), charges 0", radius_set_name(options.radius_set)));
  if (waters > 0) report.notes.push_back(fmt::format("{} atoms of water left out", waters));
  if (alternates > 0) report.notes.push_back(fmt::format("{} alternate locations left out", alternates));
  return molecule;
}

}  // namespace smopt
