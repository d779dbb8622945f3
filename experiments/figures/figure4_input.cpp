#include "experiments/figures/figure4_input.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "experiments/figures/pair_view.h"
#include "experiments/run_layout.h"
#include "metrics/intersections.h"
#include "smopt/error.h"
#include "smopt/io/mesh_io.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPaperMolecule = "AChE monomer";  ///< its row in the paper's tables
constexpr const char* kPanels[] = {"initial", "smopt", "iso2mesh"};
constexpr const char* kMethodWithPairs = "iso2mesh";

Json vector_json(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

Json pair_json(const PairView& view) {
  return {{"faces", {view.pair.first, view.pair.second}},
          {"crossing", {vector_json(view.crossing[0]), vector_json(view.crossing[1])}},
          {"towards", vector_json(view.towards)},
          {"centre", vector_json(view.piece.centre)},
          {"radius", view.piece.radius}};
}

void add_pair(Json& input, const TriangleMesh& mesh) {
  const metrics::Intersections found = metrics::find_intersections(mesh);
  if (!found.count) {
    input["why_no_pair"] = "the intersecting pairs were not counted: " + found.why_not_counted;
  } else if (*found.count == 0) {
    input["why_no_pair"] = "ISO2mesh\u2019s mesh of this molecule has no intersecting pair";
  } else if (const auto view = find_pair_view(mesh, found.pairs)) {
    input["pair"] = pair_json(*view);
  } else {
    input["why_no_pair"] = "the intersecting pairs only touch in a point or lie in one plane";
  }
}

}  // namespace

std::string figure4_molecule(const RecordSet& records, const std::string& wanted) {
  const std::vector<std::string> molecules = records.molecules();
  const auto is_shown = [&](const std::string& name) {
    return wanted.empty() ? text_at(&records.any_of(name), "/molecule/paper_row") == kPaperMolecule : name == wanted;
  };
  const auto found = std::ranges::find_if(molecules, is_shown);
  if (found != molecules.end()) return *found;
  if (!wanted.empty()) throw InvalidOption(fmt::format("the run has no molecule '{}'; it has {}", wanted, fmt::join(molecules, ", ")));
  return molecules.front();
}

std::optional<Json> figure4_input(const std::filesystem::path& directory, const std::string& molecule, const ScratchFolder& folder) {
  Json input{{"molecule", molecule}, {"panels", Json::array()}, {"pair", nullptr}, {"why_no_pair", "there is no mesh by ISO2mesh"}};
  bool has_mesh = false;
  for (const std::string method : kPanels) {
    Json panel{{"method", method}, {"mesh", nullptr}};
    if (const auto path = find_mesh(directory, molecule, method)) {
      const TriangleMesh mesh = read_mesh(*path);
      const std::filesystem::path copy = folder / (method + ".ply");
      write_mesh(copy, mesh);
      panel["mesh"] = copy.string();
      has_mesh = true;
      if (method == kMethodWithPairs) add_pair(input, mesh);
    }
    input["panels"].push_back(std::move(panel));
  }
  return has_mesh ? std::optional(input) : std::nullopt;
}

}  // namespace smopt::experiments
