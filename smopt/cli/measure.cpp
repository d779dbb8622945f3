#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "metrics/measure.h"
#include "metrics/measurement_json.h"
#include "metrics/table.h"
#include "smopt/cli/command.h"
#include "smopt/io/mesh_io.h"

namespace smopt::cli {
namespace {

struct Arguments {
  std::vector<std::string> meshes;
  std::string reference;
  bool is_json = false;
};

std::vector<metrics::NamedMeasurement> measure_all(const Arguments& arguments) {
  TriangleMesh reference;
  metrics::MeasureOptions options;
  if (!arguments.reference.empty()) {
    reference = read_mesh(arguments.reference);
    options.reference = &reference;
  }
  std::vector<metrics::NamedMeasurement> measured;
  for (const std::string& file : arguments.meshes) measured.push_back({file, metrics::measure(read_mesh(file), options)});
  return measured;
}

void run(const Arguments& arguments) {
  const std::vector<metrics::NamedMeasurement> measured = measure_all(arguments);
  if (!arguments.is_json) {
    fmt::print("{}", metrics::format_table(measured));
    return;
  }
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& [name, measurement] : measured) list.push_back(metrics::to_json(measurement));
  fmt::print("{}\n", (list.size() == 1 ? list.front() : list).dump(2));
}

}  // namespace

void add_measure(CLI::App& app, Context& context) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("measure", "Measure meshes: validity, intersecting pairs, size, shape of the triangles");
  command->footer(
      "Any mesh that can be read is measured, a broken one too; where a number does not exist the notes say why.\n"
      "\n"
      "Examples:\n"
      "  smopt measure surface.off improved.off\n"
      "  smopt measure improved.off --reference surface.off --json");
  command->add_option("meshes", arguments->meshes, "meshes (" + mesh_format_names() + ", each also .gz; - for OFF)")->required();
  command->add_option("--reference", arguments->reference, "measure the distance to this surface too");
  command->add_flag("--json", arguments->is_json, "one object for one mesh, an array for several");
  static_cast<void>(context);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace smopt::cli
