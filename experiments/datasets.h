#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "smopt/surface/gaussian_surface.h"

namespace smopt::experiments {

/// What a molecule is to the paper.
enum class Role {
  real,       ///< the paper's own molecule
  near_copy,  ///< the same molecule, prepared otherwise
  stand_in,   ///< another molecule of about the same size, called a stand-in wherever its numbers are shown
  extra       ///< has no row in the paper
};

std::string_view to_string(Role role);

/// One molecule of the experiments and the surface that is made of it.
struct Dataset {
  std::string name;                      ///< as on the command line and in file names
  std::string title;                     ///< as in tables and figures
  std::optional<std::string> paper_row;  ///< its name in the paper's tables
  Role role = Role::extra;
  std::string about;                    ///< what it is, in a few words
  std::string package;                  ///< the Debian package that brings the file; empty for another file
  std::string file;                     ///< of the user's folder of data, in place of a package's; empty for a package's
  std::string pdb;                      ///< the PDB entry that `file` was made of; empty where there is none
  std::filesystem::path path;           ///< the molecule's file; of a `file` known once the folder is; empty for a mesh without molecule
  std::filesystem::path mesh;           ///< a ready mesh, which takes the place of the generated surface; empty: it is generated
  bool is_prepared_by_pdb2pqr = false;  ///< `path` is a PDB file that pdb2pqr makes a molecule with charges and radii of
  GaussianSurfaceOptions surface;
  std::vector<std::string> suites;  ///< kDefaultSuite, kQuickSuite, kPaperSuite, kExtendedSuite: those that it belongs to
  bool is_of_folder = false;        ///< whether a file of the user's folder is used
  bool has_solvation = false;       ///< whether Table 1 shows its solvation energies: minutes for the largest, so each entry says so

  [[nodiscard]] bool is_in(std::string_view suite) const;
};

/// The suites of molecules.
inline constexpr std::string_view kDefaultSuite = "default";    ///< what needs no network and a quarter of an hour
inline constexpr std::string_view kQuickSuite = "quick";        ///< small enough for `--quick`
inline constexpr std::string_view kPaperSuite = "paper";        ///< the six rows of the paper
inline constexpr std::string_view kExtendedSuite = "extended";  ///< whatever else Debian carries, from 500 to 165 000 atoms

/// The molecules of datasets.json, in its order.
const std::vector<Dataset>& all_datasets();

/// Reads a text of the form of datasets.json. \throws InvalidInput saying which entry is wrong.
std::vector<Dataset> parse_datasets(std::string_view json);

/// An entry of the form of datasets.json that `parse_datasets` reads back, its files where they were found.
nlohmann::ordered_json to_json(const Dataset& dataset);

/// The datasets of these names, in this order, each once. \throws InvalidOption that lists the names when there is no such dataset.
std::vector<Dataset> find_datasets(std::span<const Dataset> datasets, std::span<const std::string> names);

/// Those of a suite.
std::vector<Dataset> datasets_of(std::span<const Dataset> datasets, std::string_view suite);

/// The datasets with what a folder of the user's has: the files that `datasets` name, and one more dataset for each other molecule (<name>.pqr, …)
/// or ready mesh (<name>.off, …) in it, each also .gz. A mesh of the same name as a molecule, or as a dataset, takes the place of the generated
/// surface; a molecule of the same name as a dataset takes that one's place, as it is. New ones have the standard surface and belong to no suite. \throws InvalidInput when the folder cannot be read.
std::vector<Dataset> with_data_folder(std::span<const Dataset> datasets, const std::filesystem::path& folder);

/// The molecules of datasets.json, with what the user's folder has where one is named. \throws as `with_data_folder`.
std::vector<Dataset> known_datasets(const std::filesystem::path& folder);

/// \throws InvalidInput that lists the files of the user's folder that are not known, and how to get them.
void require_files(std::span<const Dataset> datasets);

/// The title, and that it is a stand-in (a near copy) when it is one: "70S ribosome (stand-in)".
std::string labelled_title(std::string_view title, std::string_view role);

}  // namespace smopt::experiments
