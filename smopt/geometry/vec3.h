#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace smopt {

/// A point or a vector; ångström where it is a position.
using Vec3 = Eigen::Vector3d;

}  // namespace smopt
