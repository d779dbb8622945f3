#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "smopt/io/molecule.h"
#include "tests/io/rejection.h"
#include "tests/support/files.h"

/// Molecules as PDB and mmCIF files, written by the formats' descriptions and not by the library.
namespace smopt::testing {

/// An atom of such a file; a name of less than four characters stands as the PDB aligns that of an element of one letter.
struct MadeAtom {
  std::string element = "C";
  std::string name = "CA";
  std::string alternate = " ";
  std::string residue = "GLY";
  int number = 1;
  Vec3 center = Vec3::Zero();
  double occupancy = 1;
  int model = 1;
};

inline std::string pdb_line(const MadeAtom& a) {
  const std::string name = a.name.size() < 4 && a.element.size() < 2 ? " " + a.name : a.name;
  return fmt::format("ATOM  {:5d} {:<4}{:1}{:>3} A{:4d}    {:8.3f}{:8.3f}{:8.3f}{:6.2f}{:6.2f}          {:>2}\n", 1, name, a.alternate,
                     a.residue, a.number, a.center.x(), a.center.y(), a.center.z(), a.occupancy, 20.0, a.element);
}

inline std::string pdb_of(const std::vector<MadeAtom>& atoms) {
  std::string text = "HEADER    MADE BY HAND\n";
  int model = 0;
  for (const MadeAtom& a : atoms) {
    if (a.model != model) text += fmt::format("{}MODEL     {:4d}\n", model == 0 ? "" : "ENDMDL\n", a.model);
    model = a.model;
    text += pdb_line(a);
  }
  return text + "ENDMDL\nEND\n";
}

inline std::string cif_row(const MadeAtom& a) {
  return fmt::format("ATOM {} \"{}\" {} {} A {} {:.3f} {:.3f} {:.3f} {:.2f} {}\n", a.element, a.name,
                     a.alternate == " " ? "." : a.alternate, a.residue, a.number, a.center.x(), a.center.y(), a.center.z(), a.occupancy,
                     a.model);
}

inline const std::string kCifColumns =
    "loop_\n_atom_site.group_PDB\n_atom_site.type_symbol\n_atom_site.label_atom_id\n_atom_site.label_alt_id\n_atom_site.label_comp_id\n"
    "_atom_site.label_asym_id\n_atom_site.label_seq_id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n"
    "_atom_site.occupancy\n_atom_site.pdbx_PDB_model_num\n";

inline std::string cif_of(const std::vector<MadeAtom>& atoms) {
  std::string text = "data_MADE\n#\n_entry.id MADE\n" + kCifColumns;
  for (const MadeAtom& a : atoms) text += cif_row(a);
  return text + "#\n";
}

/// The molecule in a file of that name and content.
inline Molecule molecule_in(std::string_view name, std::string_view content, const MoleculeReadOptions& options = {},
                            MoleculeReadReport* report = nullptr) {
  const TemporaryFolder folder;
  return read_molecule(folder.file(name, content), options, report);
}

/// Why a molecule file of that name and content is refused; empty when it is read.
inline std::string molecule_rejection(std::string_view name, std::string_view content, const MoleculeReadOptions& options = {}) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.file(name, content);
  return rejection(folder.path(), [&] { read_molecule(path, options); });
}

/// x of every atom: which atoms were kept, when the test gives each its own.
inline std::vector<double> xs_of(const Molecule& molecule) {
  std::vector<double> xs;
  for (const Vec3& center : molecule.centers) xs.push_back(center.x());
  return xs;
}

}  // namespace smopt::testing
