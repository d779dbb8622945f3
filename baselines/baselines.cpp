#include "baselines/baselines.h"

#include "baselines/laplacian.h"

namespace smopt::baselines {

void register_baselines(MethodRegistry& registry) {
  registry.add(laplacian_method());
}

const MethodRegistry& all_methods() {
  static const MethodRegistry registry = [] {
    MethodRegistry methods;
    register_smopt(methods);
    register_baselines(methods);
    return methods;
  }();
  return registry;
}

}  // namespace smopt::baselines
