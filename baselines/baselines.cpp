#include "baselines/baselines.h"

#include "baselines/cgal/cgal_methods.h"
#include "baselines/cotangent.h"
#include "baselines/external/external_methods.h"
#include "baselines/gamer/angle_weighted_smoothing.h"
#include "baselines/hc.h"
#include "baselines/iso2mesh/iso2mesh_method.h"
#include "baselines/laplacian.h"
#include "baselines/meshlab.h"
#include "baselines/taubin.h"

namespace smopt::baselines {

void register_baselines(MethodRegistry& registry) {
  registry.add(laplacian_method());
  registry.add(taubin_method());
  registry.add(hc_method());
  registry.add(cotangent_method());
  registry.add(iso2mesh_method());
  registry.add(meshlab_method());
  register_cgal_methods(registry);
  registry.add(gamer_method());
  register_external_tools(registry);
}

const MethodRegistry& all_methods() {
  static const MethodRegistry registry = [] {
    MethodRegistry methods;
    register_smopt(methods);
    register_smopt2(methods);
    register_baselines(methods);
    return methods;
  }();
  return registry;
}

}  // namespace smopt::baselines
