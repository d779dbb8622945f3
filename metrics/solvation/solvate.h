#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "metrics/solvation/dielectric_model.h"
#include "smopt/io/molecule.h"
#include "smopt/mesh/triangle_mesh.h"
#include "smopt/progress.h"

namespace smopt::metrics {

struct SolvationOptions {
  DielectricModel medium;
  double surface_tension = 0.005;      ///< of the nonpolar part, kcal/mol/Å²; AFMPB's
  double pressure = 0.035;             ///< of the nonpolar part, kcal/mol/Å³; AFMPB's
  double accuracy = 3e-3;              ///< relative, of the integrals: see `surface_sums_for`; [1e-4, 0.1]
  bool is_direct = false;              ///< whether what is not integrated is summed pair by pair: O(n²), for reference
  double residual = 1e-6;              ///< of the linear system, relative, at which it counts as solved; (0, 1); AFMPB's
  int max_iterations = 100;            ///< of GMRES; at least 1; AFMPB's
  int restart = 100;                   ///< directions that GMRES keeps before it starts anew; at least 1
  int block = 128;                     ///< vertices in a block of the preconditioner; 1: each by itself; at least 1
  std::uint64_t max_memory_bytes = 0;  ///< 0: what the machine has
  ProgressCallback progress = {};
};

/// How the solve ended.
enum class SolvationStatus { success, not_converged, nonfinite, no_charges };

/// "success", "not_converged", "nonfinite", "no_charges".
std::string to_string(SolvationStatus status);

/// What became of it. A failure is a result with its reason, not an exception.
struct Solvation {
  SolvationStatus status = SolvationStatus::success;
  std::string reason;                         ///< in words; empty on success
  double polar = 0;                           ///< kcal/mol; NaN where the status is nonfinite
  double nonpolar = 0;                        ///< kcal/mol: surface_tension · area + pressure · volume
  double area = 0;                            ///< Å²
  double volume = 0;                          ///< Å³, positive
  int iterations = 0;                         ///< of GMRES, each one product with the matrix; 0 where one was not finite
  double relative_residual = 0;               ///< |b - Ax|/|b| of the preconditioned system, recomputed at the end
  std::vector<VertexId> degenerate_vertices;  ///< that AFMPB would reject: see `degenerate_vertices`
  std::size_t charges_outside = 0;            ///< non-zero charges that the surface does not enclose
  std::vector<double> potential;              ///< at each vertex, kcal/mol/e; NaN at vertices in no triangle
  std::vector<double> normal_derivative;      ///< of the potential just inside the surface, kcal/mol/e/Å; NaN at vertices in no triangle
  double seconds = 0;                         ///< wall time
  double predicted_memory_mb = 0;             ///< 2²⁰ bytes, before anything was allocated

  [[nodiscard]] double total() const { return polar + nonpolar; }
};

/// Solvation energy of a molecule by the linearised Poisson–Boltzmann equation, AFMPB's job, and whether the surface is fit for it.
///
/// The derivative boundary integral equations (Juffer et al. 1991) for the potential and its normal derivative at the vertices, both linear on each
/// triangle; close pairs are integrated over the triangles, the others summed by a dual-tree traversal; GMRES with a block-diagonal preconditioner. The
/// energy errs at second order in the edge length: three charges in a sphere of 10 242 vertices, 1.2e-4 (at an accuracy of 1e-3).
/// A mesh of negative volume is turned round. Points in no triangle are left out. Vertices that have no normal do not keep the others from being solved.
///
/// All cores, the same bytes for any number of threads. Cost: O(n·log n), unless a few vertices are a million times farther apart than the others, which
/// leaves the tree nothing to gather. Measured on the AChE monomer's improved meshes, two threads (AVX-512):
///
///   vertices      16 522   65 258   261 048   1 012 108
///   iterations    48       30       32        27
///   seconds       4.1      11.3     43        132
///   memory, MB    84       266      1001      3730
///
/// \throws InvalidMesh for a surface that is open, has edges of more than two triangles, is not oriented, encloses nothing, has components that point the
/// wrong way or coordinates that are not finite; InvalidOption; InvalidInput for atoms that are not finite, and when it would need more memory than is
/// allowed, with the estimate; Cancelled.
Solvation solvate(const TriangleMesh& surface, const Molecule& molecule, const SolvationOptions& options = {});

/// Memory that `solvate` takes at its largest, bytes. \throws as `solvate` for the surface and the options. Cost: 0.1 s for 65 000 vertices.
double predicted_solvation_bytes(const TriangleMesh& surface, const Molecule& molecule, const SolvationOptions& options = {});

}  // namespace smopt::metrics
