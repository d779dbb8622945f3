#pragma once

#include <filesystem>
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
  std::string about;           ///< what it is, in a few words
  std::string package;         ///< the Debian package that brings the file; empty for a file of the user's
  std::filesystem::path path;  ///< the molecule's file
  GaussianSurfaceOptions surface;
  bool is_quick = false;       ///< small enough for `--quick`
  bool has_solvation = false;  ///< whether Table 1 shows its solvation energies: minutes for the largest, so each entry says so
};

/// The molecules of datasets.json, in its order.
const std::vector<Dataset>& all_datasets();

/// Reads a text of the form of datasets.json. \throws InvalidInput saying which entry is wrong.
std::vector<Dataset> parse_datasets(std::string_view json);

/// The datasets of these names, in this order. \throws InvalidOption that lists the names when there is no such dataset.
std::vector<Dataset> find_datasets(std::span<const Dataset> datasets, std::span<const std::string> names);

/// The title, and that it is a stand-in (a near copy) when it is one: "70S ribosome (stand-in)".
std::string labelled_title(std::string_view title, std::string_view role);

}  // namespace smopt::experiments
