#pragma once

#include <string>
#include <vector>

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::testing {

/// One mesh of the archive.
struct ArchiveMesh {
  std::string name;  ///< the file's name without folder and ending: "cheese"
  TriangleMesh mesh;
  std::string unusable_because;  ///< empty when it is closed, manifold, finite and free of intersecting pairs
};

/// Whether Debian's libcgal-demo is installed.
bool has_cgal_archive();

/// All OFF meshes of the archive by name, each content once; what the reader rejects is left out, and `rejected` (if given) names it and
/// says why. \throws std::runtime_error when it cannot be unpacked.
std::vector<ArchiveMesh> read_cgal_archive(std::vector<std::string>* rejected = nullptr);

/// One of them, which may have intersecting pairs. \throws std::runtime_error when it is not there.
TriangleMesh read_from_cgal_archive(const std::string& name);

}  // namespace smopt::testing
