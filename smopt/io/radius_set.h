#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace smopt {

/// Where radii come from when a file has none: one number an element, so approximate.
enum class RadiusSet {
  /// Van der Waals radii: A. Bondi, J. Phys. Chem. 68, 441 (1964). Main-group elements without one: M. Mantina et al., J. Phys. Chem. A
  /// 113, 5806 (2009), made to fit Bondi's. Metals that neither has (iron, manganese, …): the crystallographic radii of S. S. Batsanov,
  /// Inorg. Mater. 37, 871 (2001). Hydrogen is Bondi's 1.20.
  bondi,
  /// R* (half the distance of the minimum) of AMBER's parm99, which ff14SB keeps: J. Wang, P. Cieplak, P. A. Kollman, J. Comput. Chem. 21,
  /// 1049 (2000). There it goes by atom type; here an element has the value of the type that is most frequent in proteins: H 1.487 (HC; the
  /// polar ones' 0.6 and 0 would need the bonds), O 1.6612 (O, O2; hydroxyl has 1.721). PDB2PQR gives the exact ones.
  amber,
};

/// Its name, as options spell it.
std::string_view radius_set_name(RadiusSet set);
/// \throws InvalidOption that lists the names there are.
RadiusSet radius_set_by_name(std::string_view name);
/// "bondi, amber".
std::string radius_set_names();

/// Whether it is an element's symbol in whatever case (hydrogen to lawrencium; D is deuterium).
bool is_element(std::string_view symbol);

/// Radius in ångström; nothing where the symbol is no element's, or the set has none for it. Cost: O(1).
std::optional<double> element_radius(std::string_view symbol, RadiusSet set);

}  // namespace smopt
