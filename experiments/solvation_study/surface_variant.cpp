#include "experiments/solvation_study/surface_variant.h"

#include <array>
#include <map>
#include <string>

#include "baselines/baselines.h"
#include "smopt/improve/prepare.h"
#include "smopt/improve/projection.h"

namespace smopt::experiments {
namespace {

/// What a variant consists of.
struct Recipe {
  std::string_view name;
  bool has_cavities;
  const char* step;  ///< of SMOPT; null: not improved
  bool is_projected;
};

constexpr std::array<Recipe, 6> kRecipes = {{{"as generated", true, nullptr, false},
                                             {"initial", false, nullptr, false},
                                             {"initial, projected", false, nullptr, true},
                                             {"smopt", false, "umbrella", false},
                                             {"smopt, volume-preserving", false, "volume-preserving", false},
                                             {"smopt, projected", false, "umbrella", true}}};

const Recipe& recipe_of(SurfaceVariant variant) {
  return kRecipes.at(static_cast<std::size_t>(variant));
}

void improve(TriangleMesh& mesh, const char* step) {
  const Method& smopt = baselines::all_methods().find("smopt");
  smopt.run(mesh, OptionValues(smopt.options, {{"step", step}}), {});
}

}  // namespace

std::string_view to_string(SurfaceVariant variant) {
  return recipe_of(variant).name;
}

TriangleMesh variant_of(const TriangleMesh& generated, SurfaceVariant variant, const Molecule& molecule,
                        const GaussianSurfaceOptions& options) {
  const Recipe& recipe = recipe_of(variant);
  TriangleMesh mesh = generated;
  if (!recipe.has_cavities) prepare(mesh, CavityPolicy::delete_cavities);
  if (recipe.step != nullptr) improve(mesh, recipe.step);
  if (recipe.is_projected) {
    ProjectionOptions projection;
    projection.keeps_angles = recipe.step != nullptr;  // as `smopt generate --project` does
    project_onto_level_set(mesh, GaussianField(molecule, gaussian_field_options(options)), options.isovalue, projection);
  }
  return mesh;
}

}  // namespace smopt::experiments
