#include "smopt/io/alternate_locations.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <string_view>
#include <unordered_map>

namespace smopt {
namespace {

/// Chain, residue number, insertion code and, for an atom, residue and atom name.
using Key = std::array<std::string_view, 5>;

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    /// 2^64 / golden ratio, the usual odd multiplier.
    constexpr std::size_t kSpread = 0x9E3779B97F4A7C15U;
    std::size_t hash = 0;
    for (const std::string_view part : key) hash = (hash ^ std::hash<std::string_view>{}(part)) * kSpread;
    return hash;
  }
};

/// The occupancy of a location without a label, which goes before every other.
constexpr double kUnlabelled = std::numeric_limits<double>::infinity();

/// The first of the sites of a key with the highest occupancy.
struct Best {
  double occupancy = -kUnlabelled;
  const AtomSite* site = nullptr;
};
using BestByKey = std::unordered_map<Key, Best, KeyHash>;

Key residue_key(const AtomSite& site) {
  return {site.chain, site.residue_number, site.insertion, {}, {}};
}
Key atom_key(const AtomSite& site) {
  return {site.chain, site.residue_number, site.insertion, site.residue, site.atom};
}

bool is_labelled(const AtomSite& site) {
  return !site.alternate.empty();
}

void offer(Best& best, const AtomSite& site, double occupancy) {
  if (occupancy > best.occupancy) best = {occupancy, &site};
}

BestByKey best_residues(const std::vector<AtomSite>& sites) {
  BestByKey best;
  for (const AtomSite& site : sites)
    if (is_labelled(site)) offer(best[residue_key(site)], site, site.occupancy);
  return best;
}

BestByKey best_atoms(const std::vector<AtomSite>& sites) {
  BestByKey best;
  for (const AtomSite& site : sites)
    if (is_labelled(site)) offer(best[atom_key(site)], site, site.occupancy);
  for (const AtomSite& site : sites) {
    if (is_labelled(site)) continue;
    const auto labelled = best.find(atom_key(site));
    if (labelled != best.end()) offer(labelled->second, site, kUnlabelled);
  }
  return best;
}

}  // namespace

std::size_t remove_alternate_locations(std::vector<AtomSite>& sites) {
  if (std::ranges::none_of(sites, is_labelled)) return 0;
  const BestByKey residues = best_residues(sites);
  const BestByKey atoms = best_atoms(sites);
  const auto is_kept = [&](const AtomSite& site) {
    return !is_labelled(site) ||
           (residues.at(residue_key(site)).site->residue == site.residue && atoms.at(atom_key(site)).site->alternate == site.alternate);
  };
  std::vector<AtomSite> kept;
  kept.reserve(sites.size());
  std::ranges::copy_if(sites, std::back_inserter(kept), is_kept);
  const std::size_t removed = sites.size() - kept.size();
  sites = std::move(kept);
  return removed;
}

}  // namespace smopt
