#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "baselines/baselines.h"
#include "smopt/cli/command.h"

namespace smopt::cli {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Method& method) {
  Json options = Json::array();
  for (const MethodOption& option : method.options) {
    options.push_back({{"name", option.name},
                       {"default", option.default_value},
                       {"unit", option.unit},
                       {"help", option.help},
                       {"choices", option.choices}});
  }
  return {{"name", method.name},
          {"summary", method.summary},
          {"source", method.source},
          {"note", method.note},
          {"cavities", to_string(method.default_cavities)},
          {"options", options}};
}

void print(const Method& method) {
  fmt::print("{}\n  {}\n  Source: {}\n  --cavities {} unless said otherwise\n", method.name, method.summary, method.source,
             to_string(method.default_cavities));
  if (!method.note.empty()) fmt::print("  Note: {}\n", method.note);
  for (const MethodOption& option : method.options) {
    fmt::print("    --{:<22} {:<10} {}{}{}\n", option.name, option.default_value, option.help,
               option.unit.empty() ? "" : ", " + option.unit,
               option.choices.empty() ? "" : fmt::format(" ({})", fmt::join(option.choices, ", ")));
  }
  fmt::print("\n");
}

void run(bool is_json) {
  Json list = Json::array();
  for (const Method& method : baselines::all_methods().all()) {
    if (is_json)
      list.push_back(to_json(method));
    else
      print(method);
  }
  if (is_json) fmt::print("{}\n", list.dump(2));
}

}  // namespace

void add_methods(CLI::App& app, Context& /*context*/) {
  const auto is_json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("methods", "List the methods of `smopt improve` and their options");
  command->footer("Example: smopt methods --json");
  command->add_flag("--json", *is_json, "as JSON");
  command->callback([is_json] { run(*is_json); });
}

}  // namespace smopt::cli
