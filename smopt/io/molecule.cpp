#include "smopt/io/molecule.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "smopt/error.h"
#include "smopt/io/file.h"
#include "smopt/io/pqr.h"

namespace smopt {
namespace {

struct MoleculeFormat {
  std::string_view ending;
  Molecule (*parse)(std::string_view text, const std::string& name);
};

constexpr std::array<MoleculeFormat, 1> kFormats = {{{"pqr", parse_pqr}}};

/// What standard input holds.
constexpr std::string_view kStandardInputFormat = "pqr";

const MoleculeFormat& require_format(const std::filesystem::path& path) {
  const std::string ending = path == "-" ? std::string(kStandardInputFormat) : format_ending(path);
  const auto found = std::ranges::find(kFormats, ending, &MoleculeFormat::ending);
  if (found != kFormats.end()) return *found;
  std::string known;
  for (const MoleculeFormat& format : kFormats) known += fmt::format("{}{}", known.empty() ? "" : ", ", format.ending);
  throw InvalidInput(fmt::format("{}: not a molecule format by its name; known are {} (each also .gz)", path.string(), known));
}

}  // namespace

Molecule read_molecule(const std::filesystem::path& path) {
  const MoleculeFormat& format = require_format(path);
  return format.parse(read_file(path), display_name(path));
}

}  // namespace smopt
