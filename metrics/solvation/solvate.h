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
  double accuracy = 1e-4;              ///< of the sums over the surface: see `solvate`; [1e-10, 0.1]
  bool is_direct = false;              ///< whether all pairs are summed one by one: O(n²), for reference
  double residual = 1e-6;              ///< of the linear system, at which it counts as solved; (0, 1); AFMPB's
  int max_iterations = 100;            ///< of GMRES; at least 1; AFMPB's
  int restart = 100;                   ///< GMRES keeps so many directions; at least 1
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
  int iterations = 0;                         ///< of GMRES, each one product with the matrix
  double relative_residual = 0;               ///< |b - Ax|/|b| of the preconditioned system, recomputed at the end
  std::vector<VertexId> degenerate_vertices;  ///< that AFMPB would reject: see `degenerate_vertices`
  std::size_t charges_outside = 0;            ///< non-zero charges that the surface does not enclose
  std::vector<double> potential;              ///< at each vertex, kcal/mol/e; NaN at vertices in no triangle
  std::vector<double> normal_derivative;      ///< of the potential just inside the surface, kcal/mol/e/Å; NaN at vertices in no triangle
  double seconds = 0;                         ///< wall time
  double predicted_memory_mb = 0;             ///< 2²⁰ bytes, before anything was allocated

  [[nodiscard]] double total() const { return polar + nonpolar; }
};

/// Solvation energy of a molecule by the linearised Poisson–Boltzmann equation, AFMPB's job.
///
/// \throws InvalidMesh for a surface that is not closed, edge-manifold and oriented, or has coordinates that are not finite; InvalidOption;
/// InvalidInput when more memory would be needed than is allowed, with the estimate; Cancelled.
Solvation solvate(const TriangleMesh& surface, const Molecule& molecule, const SolvationOptions& options = {});

/// Memory that `solvate` takes at its largest, in bytes.
double solvation_bytes(std::size_t vertices, std::size_t charges, const SolvationOptions& options);

}  // namespace smopt::metrics
