#pragma once

#include <cstddef>

#include "smopt/mesh/components.h"
#include "smopt/mesh/triangle_mesh.h"

namespace smopt {

/// Which components of the surface stay.
enum class CavityPolicy {
  delete_cavities,  ///< every outer component stays; each cavity goes, and everything inside it
  keep,             ///< all stay
  main              ///< only the outer component of the largest volume stays
};

/// What was there and what was removed.
struct CavityReport {
  std::size_t components = 0;                ///< before
  std::size_t cavities = 0;                  ///< removed components of odd nesting depth
  std::size_t islands = 0;                   ///< removed components of even depth above 0: they lie inside a cavity
  std::size_t outer_components = 0;          ///< removed outer components (policy main)
  std::size_t cavity_vertices = 0;           ///< vertices of the removed cavities and islands
  std::size_t outer_component_vertices = 0;  ///< vertices of the removed outer components
};

/// Removes the components that the policy does not keep, and their vertices ("delete the small cavities inside the molecules", Liu et al.
/// 2017, results). A component inside another one is told by containment, not by its orientation (see `component_nesting`). \pre mesh is a
/// closed manifold. Cost: O(n), on all threads.
CavityReport remove_cavities(TriangleMesh& mesh, CavityPolicy policy);

/// The same where the components are known already.
CavityReport remove_cavities(TriangleMesh& mesh, const Components& components, CavityPolicy policy);

}  // namespace smopt
