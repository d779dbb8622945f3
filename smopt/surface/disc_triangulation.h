#pragma once

#include <optional>
#include <span>
#include <vector>

#include "smopt/surface/patch_embedding.h"

namespace smopt {

/// Fills a closed polygon on the boundary of a cube with triangles, as a patch that is single-valued along a coordinate axis: projected
/// along it, the polygon is simple, and its ears are clipped one after another, the best-shaped first. As the graph of a function over the
/// polygon the patch has no intersections (exact), and no triangle has a side or itself in a face of the cube but the polygon's own sides.
/// Axes are tried in the order of the polygon's projected area.
/// \param loop    indices of its corners, anticlockwise seen from outside.
/// \param points  positions.
/// \param faces   for each point: the faces of the cube on which it lies, as bits.
/// \return nothing when there is no such triangulation along any axis (the polygon folds).
/// Cost: O(n²) exact sign tests where n points are few.
std::optional<std::vector<PatchTriangle>> clip_ears(std::span<const std::uint8_t> loop, std::span<const Vec3> points,
                                                    std::span<const unsigned> faces);

}  // namespace smopt
