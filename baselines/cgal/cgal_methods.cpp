#include "baselines/cgal/cgal_methods.h"

#include "baselines/cgal/angle_method.h"
#include "baselines/cgal/area_method.h"
#include "baselines/cgal/remesh_method.h"
#include "baselines/cgal/shape_smoothing.h"
#include "baselines/cgal/tangential_relaxation.h"

namespace smopt::baselines {

void register_cgal_methods(MethodRegistry& registry) {
  registry.add(angle_method());
  registry.add(area_method());
  registry.add(remesh_method());
  registry.add(tangential_method());
  registry.add(shape_method());
}

}  // namespace smopt::baselines
