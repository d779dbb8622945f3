#pragma once

#include "smopt/mesh/triangle_mesh.h"

namespace smopt::bench {

/// Some copies of the AChE monomer side by side, as one surface.
struct BenchMesh {
  TriangleMesh surface;   ///< as `smopt generate` makes it with its defaults: 68 000 vertices a copy
  TriangleMesh prepared;  ///< without its cavities and redundant points, as smoothing gets it: 65 000 vertices a copy
};

/// The mesh of so many copies; 0 copies are a small made-up molecule that needs no file. The last mesh asked for is kept.
/// \throws InvalidInput when the molecule's file is not there.
const BenchMesh& bench_mesh(int copies);

/// Gives the memory of the mesh that is kept back to the system.
void forget_bench_mesh();

}  // namespace smopt::bench
