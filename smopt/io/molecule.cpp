#include "smopt/io/molecule.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "smopt/error.h"
#include "smopt/io/file.h"
#include "smopt/io/mmcif.h"
#include "smopt/io/pdb.h"
#include "smopt/io/pqr.h"
#include "smopt/io/xyzr.h"

namespace smopt {
namespace {

namespace fs = std::filesystem;

using Parse = Molecule (*)(std::string_view text, const std::string& name, const MoleculeReadOptions& options, MoleculeReadReport& report);

/// No atom is larger: francium's van der Waals radius is 3.5 Å.
constexpr double kLargestAtom = 5.0;

/// A PDB file under another name has its temperature factors where PQR has radii, and is otherwise a PQR file.
void note_large_radius(const Molecule& molecule, MoleculeReadReport& report) {
  const double largest = std::ranges::max(molecule.radii);
  if (largest > kLargestAtom)
    report.notes.push_back(
        fmt::format("the largest radius is {} Å, more than any atom's: is this a PDB file with temperature factors?", largest));
}

Molecule read_pqr(std::string_view text, const std::string& name, const MoleculeReadOptions&, MoleculeReadReport& report) {
  Molecule molecule = parse_pqr(text, name);
  note_large_radius(molecule, report);
  return molecule;
}

Molecule read_xyzr(std::string_view text, const std::string& name, const MoleculeReadOptions&, MoleculeReadReport& report) {
  Molecule molecule = parse_xyzr(text, name);
  report.notes.emplace_back("charges 0");
  return molecule;
}

struct MoleculeFormat {
  std::string_view ending;
  Parse parse;
};

constexpr std::array<MoleculeFormat, 6> kFormats = {
    {{"pqr", read_pqr}, {"pdb", parse_pdb}, {"ent", parse_pdb}, {"cif", parse_mmcif}, {"mmcif", parse_mmcif}, {"xyzr", read_xyzr}}};

/// What standard input holds.
constexpr std::string_view kStandardInputFormat = "pqr";

const MoleculeFormat& require_format(const fs::path& path) {
  const std::string ending = path == "-" ? std::string(kStandardInputFormat) : format_ending(path);
  const auto found = std::ranges::find(kFormats, ending, &MoleculeFormat::ending);
  if (found != kFormats.end()) return *found;
  throw InvalidInput(
      fmt::format("{}: not a molecule format by its name; known are {} (each also .gz)", path.string(), molecule_format_names()));
}

struct Beginning {
  std::string_view bytes;
  std::string_view of;
};

/// What files begin with that are no molecules of any format here, though some would pass as one without atoms.
constexpr std::array<Beginning, 8> kOtherFiles = {{{"\x89PNG", "a PNG image"},
                                                   {"\xff\xd8\xff", "a JPEG image"},
                                                   {"%PDF", "a PDF document"},
                                                   {"PK\x03\x04", "a ZIP archive"},
                                                   {"BZh", "packed by bzip2"},
                                                   {"\xfd"
                                                    "7zXZ",
                                                    "packed by xz"},
                                                   {"<", "HTML or XML"},
                                                   {"OFF\n", "an OFF mesh"}}};

/// What every mmCIF begins with, comments left out, and no other format.
constexpr std::string_view kCifBeginning = "data_";

/// Only so far is a text searched for what no text has.
constexpr std::size_t kLooksAt = 4096;

void require_molecule(std::string_view content, const std::string& name, const MoleculeFormat& format) {
  for (const auto& [bytes, of] : kOtherFiles)
    if (content.starts_with(bytes)) throw InvalidInput(fmt::format("{}: not a molecule: the file is {}", name, of));
  if (content.substr(0, kLooksAt).find('\0') != std::string_view::npos)
    throw InvalidInput(fmt::format("{}: not a molecule: the file is binary", name));
  if (content.starts_with(kCifBeginning) && format.parse != parse_mmcif)
    throw InvalidInput(fmt::format("{}: the file is mmCIF, not {}; name it .cif", name, format.ending));
}

/// Some editors put it in front of a text; the first line would not begin as it should.
std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

}  // namespace

Molecule read_molecule(const fs::path& path, const MoleculeReadOptions& options, MoleculeReadReport* report) {
  const MoleculeFormat& format = require_format(path);
  const std::string name = display_name(path);
  const std::string content = read_file(path);
  const std::string_view text = without_byte_order_mark(content);
  require_molecule(text, name, format);
  MoleculeReadReport own_report;
  return format.parse(text, name, options, report ? *report : own_report);
}

bool is_readable_molecule_format(const fs::path& path) {
  return std::ranges::find(kFormats, format_ending(path), &MoleculeFormat::ending) != kFormats.end();
}

std::string molecule_format_names() {
  std::string names;
  for (const MoleculeFormat& format : kFormats) names += fmt::format("{}{}", names.empty() ? "" : ", ", format.ending);
  return names;
}

}  // namespace smopt
