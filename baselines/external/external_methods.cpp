#include "baselines/external/external_methods.h"

#include "baselines/external/external_iso2mesh.h"
#include "baselines/external/external_meshlab.h"
#include "baselines/external/external_mmgs.h"

namespace smopt::baselines {

void register_external_tools(MethodRegistry& registry) {
  registry.add(external_iso2mesh_method());
  registry.add(external_meshlab_method());
  registry.add(external_mmgs_method());
}

}  // namespace smopt::baselines
