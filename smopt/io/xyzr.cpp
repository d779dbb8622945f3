#include "smopt/io/xyzr.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "smopt/error.h"
#include "smopt/io/text_reader.h"

namespace smopt {
namespace {

double finite_number(TextReader& in, std::string_view what) {
  const double value = in.number(what);
  if (!std::isfinite(value)) in.fail(fmt::format("{} is {}, expected a finite number", what, value));
  return value;
}

}  // namespace

Molecule parse_xyzr(std::string_view text, const std::string& name) {
  TextReader in(text, name);
  Molecule molecule;
  while (in.next_line()) {
    const double x = finite_number(in, "coordinate x");
    const double y = finite_number(in, "coordinate y");
    const double z = finite_number(in, "coordinate z");
    const double radius = finite_number(in, "radius");
    if (radius < 0) in.fail(fmt::format("radius is {}, expected one that is not negative", radius));
    molecule.centers.emplace_back(x, y, z);
    molecule.radii.push_back(radius);
  }
  if (molecule.centers.empty()) throw InvalidInput(name + ": the file has no atoms (no line x y z r)");
  molecule.charges.resize(molecule.atom_count(), 0.0);
  return molecule;
}

}  // namespace smopt
