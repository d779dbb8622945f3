#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace smopt::experiments {

/// What the published program (TMSmesh 2.1) made of a molecule: orientation, not an oracle.
struct PublishedMesh {
  std::string molecule;  ///< the name it has in the study
  std::string title;
  double decay = 0;     ///< 1/Å²
  double option_e = 0;  ///< the published program's; no length
  std::int64_t vertices = 0;
  std::int64_t components = 0;
  std::int64_t euler_characteristic = 0;
  std::int64_t euler_characteristic_main = 0;
  std::optional<double> area;    ///< Å²
  std::optional<double> volume;  ///< Å³
  double our_error = 0;          ///< ångström: the error at which our adaptive mesh has about as many vertices
};

struct PublishedFigures {
  std::string program;
  std::string source;
  std::vector<PublishedMesh> meshes;
};

/// Those of published.json.
const PublishedFigures& published_figures();

/// Reads a text of the form of published.json. \throws InvalidInput saying which entry is wrong.
PublishedFigures parse_published(std::string_view json);

}  // namespace smopt::experiments
