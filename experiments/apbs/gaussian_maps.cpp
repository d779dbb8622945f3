#include "experiments/apbs/gaussian_maps.h"

#include <fmt/format.h>

#include "smopt/io/file.h"

namespace smopt::experiments {
namespace {

/// What a map says of the two sides.
struct Sides {
  double inside;
  double outside;
};

ScalarGrid sample(const GaussianField& field, const ApbsGrid& grid, const Vec3& offset) {
  ScalarGrid samples;
  samples.size = {static_cast<std::uint32_t>(grid.nodes[0]), static_cast<std::uint32_t>(grid.nodes[1]),
                  static_cast<std::uint32_t>(grid.nodes[2])};
  samples.origin = grid.low() + offset;
  samples.spacing = grid.spacing;
  field.sample(samples);
  return samples;
}

std::string header(const ScalarGrid& grid) {
  const auto& n = grid.size;
  const std::string counts = fmt::format("counts {} {} {}", n[0], n[1], n[2]);
  return fmt::format(
      "object 1 class gridpositions {}\norigin {:.9f} {:.9f} {:.9f}\ndelta {h:.9f} 0 0\ndelta 0 {h:.9f} 0\ndelta 0 0 {h:.9f}\n"
      "object 2 class gridconnections {}\nobject 3 class array type double rank 0 items {} data follows\n",
      counts, grid.origin.x(), grid.origin.y(), grid.origin.z(), counts, grid.node_count(), fmt::arg("h", grid.spacing));
}

constexpr std::string_view kFooter =
    "attribute \"dep\" string \"positions\"\nobject \"regular positions regular connections\" class field\ncomponent \"positions\" value "
    "1\n"
    "component \"connections\" value 2\ncomponent \"data\" value 3\n";

/// z runs fastest, three numbers a line.
std::string format_map(const ScalarGrid& field, double isovalue, const Sides& sides) {
  const std::string inside = fmt::format("{}", sides.inside), outside = fmt::format("{}", sides.outside);
  std::string text = header(field);
  std::size_t written = 0;
  for (std::size_t i = 0; i < field.size[0]; ++i) {
    for (std::size_t j = 0; j < field.size[1]; ++j) {
      for (std::size_t k = 0; k < field.size[2]; ++k) {
        text += field.values[field.index(i, j, k)] >= isovalue ? inside : outside;
        text += ++written % 3 == 0 ? '\n' : ' ';
      }
    }
  }
  text += '\n';
  text += kFooter;
  return text;
}

}  // namespace

void write_gaussian_maps(const std::filesystem::path& folder, const Molecule& molecule, const GaussianSurfaceOptions& surface,
                         const metrics::DielectricModel& medium, const ApbsGrid& grid) {
  const GaussianField field(molecule, gaussian_field_options(surface));
  const Sides permittivity{medium.inner, medium.outer};
  for (int axis = 0; axis < 3; ++axis) {
    const ScalarGrid samples = sample(field, grid, grid.spacing / 2 * Vec3::Unit(axis));
    write_file(folder / kApbsMaps.at(static_cast<std::size_t>(axis)), format_map(samples, surface.isovalue, permittivity));
  }
  // APBS takes what is positive for "ions are here" and their strength from the rest of its input.
  write_file(folder / kApbsMaps.back(), format_map(sample(field, grid, Vec3::Zero()), surface.isovalue, {0, 1}));
}

}  // namespace smopt::experiments
