#include "experiments/run/step.h"

namespace smopt::experiments {

std::string stamp_path(const Step& step) {
  return "steps/" + step.id + ".step.json";
}

nlohmann::ordered_json to_json(const Step& step) {
  return {{"id", step.id},
          {"rule", step.rule},
          {"molecule", step.molecule},
          {"subject", step.subject},
          {"command", step.command},
          {"inputs", step.inputs},
          {"outputs", step.outputs},
          {"after", step.after},
          {"stamp", step.command.empty() ? step.outputs.front() : stamp_path(step)},
          {"threads", step.needs.threads},
          {"memory_base_mb", step.needs.memory_base_mb},
          {"memory_per_input", step.needs.memory_per_input},
          {"seconds", step.limits.seconds}};
}

}  // namespace smopt::experiments
