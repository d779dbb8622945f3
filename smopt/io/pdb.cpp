#include "smopt/io/pdb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "smopt/error.h"
#include "smopt/io/atom_site.h"
#include "smopt/io/line_reader.h"
#include "smopt/io/text_reader.h"

namespace smopt {
namespace {

/// Columns `first` to `last`, counted from 1 as in the format's description.
struct Columns {
  std::size_t first;
  std::size_t last;
};

constexpr Columns kAtomName = {13, 16};
constexpr Columns kAlternate = {17, 17};
constexpr Columns kResidue = {18, 21};  ///< 18–20 in the format; the names of some force fields have a fourth letter in the free column 21
constexpr Columns kChain = {22, 22};
constexpr Columns kResidueNumber = {23, 26};
constexpr Columns kInsertion = {27, 27};
constexpr std::size_t kBlankColumn = 30;  ///< in front of the coordinates
constexpr std::array<Columns, 3> kCoordinates = {{{31, 38}, {39, 46}, {47, 54}}};
constexpr Columns kOccupancy = {55, 60};
constexpr Columns kElement = {77, 78};

constexpr std::array<std::string_view, 3> kCoordinateNames = {"coordinate x", "coordinate y", "coordinate z"};

/// Residues whose atoms' elements are the first letters of their names: amino acids with the names of their protonation states,
/// nucleotides.
constexpr std::array<std::string_view, 47> kStandardResidues = {
    "ALA", "ARG", "ASN", "ASP", "CYS", "GLN", "GLU", "GLY", "HIS", "ILE", "LEU", "LYS", "MET", "PHE", "PRO", "SER",
    "THR", "TRP", "TYR", "VAL", "ASH", "CYM", "CYX", "GLH", "HID", "HIE", "HIP", "HSD", "HSE", "HSP", "LYN", "A",
    "C",   "G",   "U",   "I",   "DA",  "DC",  "DG",  "DT",  "DI",  "RA",  "RC",  "RG",  "RU",  "ADE", "URA"};

/// What stands in the columns; shorter where the line ends earlier.
std::string_view cut(std::string_view line, Columns columns) {
  return line.substr(std::min(columns.first - 1, line.size()), columns.last - columns.first + 1);
}

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

std::string_view trimmed(std::string_view line, Columns columns) {
  return trimmed(cut(line, columns));
}

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

/// A record's name takes columns 1–6; a serial number of more than five digits runs into it.
bool is_atom(std::string_view line) {
  if (line.starts_with("HETATM")) return true;
  return line.starts_with("ATOM") && (line.size() == 4 || line[4] == ' ' || std::isdigit(static_cast<unsigned char>(line[4])));
}

/// Whether no atom that follows belongs to the model before: its end, or the next one's beginning.
bool parts_models(std::string_view line) {
  return line.starts_with("ENDMDL") || line.starts_with("MODEL ") || trimmed(line) == "END";
}

/// Empty when there is none.
std::string_view first_letter(std::string_view name) {
  const auto letter = std::ranges::find_if(name, is_letter);
  return name.substr(static_cast<std::size_t>(letter - name.begin()), 1);
}

/// Columns 13–14 hold the symbol aligned to the right; names of hydrogens begin in column 13 where they have four characters.
std::string_view element_by_alignment(std::string_view name) {
  const bool is_hydrogen_of_four = name.size() == 4 && name[0] == 'H' && name[3] != ' ';
  const std::string_view symbol = name.substr(0, 2);
  return symbol.size() == 2 && is_element(symbol) && !is_hydrogen_of_four ? symbol : first_letter(name);
}

std::string_view element_by_name(std::string_view line) {
  const std::string_view name = cut(line, kAtomName);
  const std::string_view residue = trimmed(line, kResidue);
  if (std::ranges::find(kStandardResidues, residue) != kStandardResidues.end()) return first_letter(name);
  if (trimmed(name) == residue && is_element(residue)) return residue;
  return element_by_alignment(name);
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& name) : name_(name), lines_(text, name) {}

  Molecule parse(const MoleculeReadOptions& options, MoleculeReadReport& report) {
    const std::size_t behind = read_first_model();
    if (sites_.empty()) throw InvalidInput(fmt::format("{}: the file has no atoms (no line ATOM or HETATM)", name_));
    if (behind > 0) report.notes.push_back(fmt::format("only the first model is read: {} atoms of others left out", behind));
    if (named_elements_ > 0)
      report.notes.push_back(fmt::format("elements of {} atoms told by their names (columns 77–78 are blank)", named_elements_));
    return molecule_of(std::move(sites_), name_, options, report);
  }

 private:
  /// Returns how many atoms follow the first model.
  std::size_t read_first_model() {
    std::size_t behind = 0;
    bool is_first = true;
    while (lines_.next()) {
      if (is_atom(lines_.line())) {
        if (is_first)
          read_atom(lines_.line());
        else
          ++behind;
      } else if (parts_models(lines_.line())) {
        is_first = sites_.empty();
      }
    }
    return behind;
  }

  void read_atom(std::string_view line) {
    AtomSite site;
    site.center = read_center(line);
    site.occupancy = read_occupancy(line);
    site.line = lines_.number();
    site.element = read_element(line);
    site.atom = trimmed(line, kAtomName);
    site.residue = trimmed(line, kResidue);
    site.alternate = trimmed(line, kAlternate);
    site.chain = trimmed(line, kChain);
    site.residue_number = trimmed(line, kResidueNumber);
    site.insertion = trimmed(line, kInsertion);
    sites_.push_back(site);
  }

  Vec3 read_center(std::string_view line) const {
    const std::size_t end = kCoordinates.back().last;
    if (line.size() < end) lines_.fail(fmt::format("the atom's line has {} columns, its coordinates end in column {}", line.size(), end));
    if (line[kBlankColumn - 1] != ' ')
      lines_.fail(fmt::format("column {} holds {}, expected a blank: the line is not in the PDB's columns", kBlankColumn,
                              quoted(line.substr(kBlankColumn - 1, 1))));
    Vec3 center;
    for (std::size_t i = 0; i < kCoordinates.size(); ++i)
      center[static_cast<Eigen::Index>(i)] = read_number(line, kCoordinates[i], kCoordinateNames[i]);
    return center;
  }

  /// A digit pushed out of the coordinates' columns ends up here and is no number together with what belongs here.
  double read_occupancy(std::string_view line) const {
    return trimmed(line, kOccupancy).empty() ? AtomSite{}.occupancy : read_number(line, kOccupancy, "occupancy");
  }

  double read_number(std::string_view line, Columns columns, std::string_view what) const {
    const std::string_view text = trimmed(line, columns);
    double value = 0;
    if (!parse_number(text, value))
      lines_.fail(fmt::format("{} (columns {}–{}) is {}, expected a number", what, columns.first, columns.last, quoted(text)));
    if (!std::isfinite(value)) lines_.fail(fmt::format("{} is {}, expected a finite number", what, value));
    return value;
  }

  /// Files of before 1996 have the entry's identifier and a line number in columns 73–80.
  std::string_view read_element(std::string_view line) {
    const std::string_view element = trimmed(line, kElement);
    if (!element.empty() && std::ranges::all_of(element, is_letter)) return element;
    ++named_elements_;
    return element_by_name(line);
  }

  const std::string& name_;
  LineReader lines_;
  std::vector<AtomSite> sites_;
  std::size_t named_elements_ = 0;
};

}  // namespace

Molecule parse_pdb(std::string_view text, const std::string& name, const MoleculeReadOptions& options, MoleculeReadReport& report) {
  return Parser(text, name).parse(options, report);
}

}  // namespace smopt
