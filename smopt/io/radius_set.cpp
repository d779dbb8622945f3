#include "smopt/io/radius_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "smopt/error.h"

namespace smopt {
namespace {

/// In the order of `RadiusSet`.
constexpr std::array<std::string_view, 2> kNames = {"bondi", "amber"};

/// The set has no radius for the element.
constexpr double kNone = 0;

struct Element {
  std::string_view symbol;
  std::array<double, kNames.size()> radii;  ///< Å, in the order of `RadiusSet`
};

/// One row an element; what a column's values are stands at `RadiusSet`. The comments say which work the first column's value is from.
// clang-format off
constexpr std::array kElements = {
    // Bondi 1964; D as H, Pt in the middle of the 1.7 to 1.8 given there
    Element{"H",  {1.20, 1.4870}},
    Element{"D",  {1.20, 1.4870}},
    Element{"He", {1.40, kNone}},
    Element{"Li", {1.82, 1.1370}},
    Element{"C",  {1.70, 1.9080}},
    Element{"N",  {1.55, 1.8240}},
    Element{"O",  {1.52, 1.6612}},
    Element{"F",  {1.47, 1.7500}},
    Element{"Ne", {1.54, kNone}},
    Element{"Na", {2.27, 1.8680}},
    Element{"Mg", {1.73, 0.7926}},
    Element{"Si", {2.10, kNone}},
    Element{"P",  {1.80, 2.1000}},
    Element{"S",  {1.80, 2.0000}},
    Element{"Cl", {1.75, 1.9480}},
    Element{"Ar", {1.88, kNone}},
    Element{"K",  {2.75, 2.6580}},
    Element{"Ni", {1.63, kNone}},
    Element{"Cu", {1.40, kNone}},
    Element{"Zn", {1.39, 1.1000}},
    Element{"Ga", {1.87, kNone}},
    Element{"As", {1.85, kNone}},
    Element{"Se", {1.90, kNone}},
    Element{"Br", {1.85, 2.2200}},
    Element{"Kr", {2.02, kNone}},
    Element{"Pd", {1.63, kNone}},
    Element{"Ag", {1.72, kNone}},
    Element{"Cd", {1.58, kNone}},
    Element{"In", {1.93, kNone}},
    Element{"Sn", {2.17, kNone}},
    Element{"Te", {2.06, kNone}},
    Element{"I",  {1.98, 2.3500}},
    Element{"Xe", {2.16, kNone}},
    Element{"Pt", {1.75, kNone}},
    Element{"Au", {1.66, kNone}},
    Element{"Hg", {1.55, kNone}},
    Element{"Tl", {1.96, kNone}},
    Element{"Pb", {2.02, kNone}},
    Element{"U",  {1.86, kNone}},
    // Mantina 2009
    Element{"Be", {1.53, kNone}},
    Element{"B",  {1.92, kNone}},
    Element{"Al", {1.84, kNone}},
    Element{"Ca", {2.31, 1.7131}},
    Element{"Ge", {2.11, kNone}},
    Element{"Rb", {3.03, 2.9560}},
    Element{"Sr", {2.49, kNone}},
    Element{"Sb", {2.06, kNone}},
    Element{"Cs", {3.43, 3.3950}},
    Element{"Ba", {2.68, kNone}},
    Element{"Bi", {2.07, kNone}},
    Element{"Po", {1.97, kNone}},
    Element{"At", {2.02, kNone}},
    Element{"Rn", {2.20, kNone}},
    Element{"Fr", {3.48, kNone}},
    Element{"Ra", {2.83, kNone}},
    // Batsanov 2001
    Element{"Sc", {2.30, kNone}},
    Element{"Ti", {2.15, kNone}},
    Element{"V",  {2.05, kNone}},
    Element{"Cr", {2.05, kNone}},
    Element{"Mn", {2.05, kNone}},
    Element{"Fe", {2.05, kNone}},
    Element{"Co", {2.00, kNone}},
    Element{"Y",  {2.40, kNone}},
    Element{"Zr", {2.30, kNone}},
    Element{"Nb", {2.15, kNone}},
    Element{"Mo", {2.10, kNone}},
    Element{"Tc", {2.05, kNone}},
    Element{"Ru", {2.05, kNone}},
    Element{"Rh", {2.00, kNone}},
    Element{"La", {2.50, kNone}},
    Element{"Hf", {2.25, kNone}},
    Element{"Ta", {2.20, kNone}},
    Element{"W",  {2.10, kNone}},
    Element{"Re", {2.05, kNone}},
    Element{"Os", {2.00, kNone}},
    Element{"Ir", {2.00, kNone}},
    Element{"Th", {2.40, kNone}},
    // no radius in either set
    Element{"Ce", {kNone, kNone}},
    Element{"Pr", {kNone, kNone}},
    Element{"Nd", {kNone, kNone}},
    Element{"Pm", {kNone, kNone}},
    Element{"Sm", {kNone, kNone}},
    Element{"Eu", {kNone, kNone}},
    Element{"Gd", {kNone, kNone}},
    Element{"Tb", {kNone, kNone}},
    Element{"Dy", {kNone, kNone}},
    Element{"Ho", {kNone, kNone}},
    Element{"Er", {kNone, kNone}},
    Element{"Tm", {kNone, kNone}},
    Element{"Yb", {kNone, kNone}},
    Element{"Lu", {kNone, kNone}},
    Element{"Ac", {kNone, kNone}},
    Element{"Pa", {kNone, kNone}},
    Element{"Np", {kNone, kNone}},
    Element{"Pu", {kNone, kNone}},
    Element{"Am", {kNone, kNone}},
    Element{"Cm", {kNone, kNone}},
    Element{"Bk", {kNone, kNone}},
    Element{"Cf", {kNone, kNone}},
    Element{"Es", {kNone, kNone}},
    Element{"Fm", {kNone, kNone}},
    Element{"Md", {kNone, kNone}},
    Element{"No", {kNone, kNone}},
    Element{"Lr", {kNone, kNone}},
};
// clang-format on

/// Symbols have one letter or two: 26 × 27 places, the first of each row for the symbol of one letter.
constexpr std::size_t kLetters = 26;
constexpr std::size_t kPlaces = kLetters * (kLetters + 1);

/// The place of a symbol; `kPlaces` when it is not one letter or two.
constexpr std::size_t place_of(std::string_view symbol) {
  std::array<std::size_t, 2> letters{};
  if (symbol.empty() || symbol.size() > letters.size()) return kPlaces;
  for (std::size_t i = 0; i < symbol.size(); ++i) {
    const char upper = symbol[i] >= 'a' && symbol[i] <= 'z' ? static_cast<char>(symbol[i] - 'a' + 'A') : symbol[i];
    if (upper < 'A' || upper > 'Z') return kPlaces;
    letters[i] = static_cast<std::size_t>(upper - 'A') + 1;
  }
  return (letters[0] - 1) * (kLetters + 1) + letters[1];
}

constexpr std::uint8_t kNoElement = 255;
static_assert(kElements.size() < kNoElement);

/// Index into `kElements` by place.
constexpr auto kElementAt = [] {
  std::array<std::uint8_t, kPlaces> element{};
  element.fill(kNoElement);
  for (std::size_t i = 0; i < kElements.size(); ++i) element[place_of(kElements[i].symbol)] = static_cast<std::uint8_t>(i);
  return element;
}();

const Element* find_element(std::string_view symbol) {
  const std::size_t place = place_of(symbol);
  return place == kPlaces || kElementAt[place] == kNoElement ? nullptr : &kElements[kElementAt[place]];
}

}  // namespace

std::string_view radius_set_name(RadiusSet set) {
  return kNames.at(static_cast<std::size_t>(set));
}

std::string radius_set_names() {
  return fmt::format("{}", fmt::join(kNames, ", "));
}

RadiusSet radius_set_by_name(std::string_view name) {
  const auto found = std::ranges::find(kNames, name);
  if (found == kNames.end()) throw InvalidOption(fmt::format("there is no radius set \"{}\"; there are {}", name, radius_set_names()));
  return static_cast<RadiusSet>(found - kNames.begin());
}

bool is_element(std::string_view symbol) {
  return find_element(symbol) != nullptr;
}

std::optional<double> element_radius(std::string_view symbol, RadiusSet set) {
  const Element* element = find_element(symbol);
  if (!element) return std::nullopt;
  const double radius = element->radii.at(static_cast<std::size_t>(set));
  return radius == kNone ? std::nullopt : std::optional(radius);
}

}  // namespace smopt
