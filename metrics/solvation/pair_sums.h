#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace smopt::metrics {

/// The two kernels, 1/r and exp(-kappa·r)/r; what belongs to one of them is kept in arrays of two, in this order.
enum KernelIndex : std::size_t { kPlain = 0, kScreened = 1 };
inline constexpr std::size_t kKernels = 2;

/// Points with a charge and a dipole for each kernel; structure of arrays.
struct SourceView {
  std::size_t count = 0;
  std::array<const double*, 3> position{};
  std::array<const double*, kKernels> charge{};
  std::array<std::array<const double*, 3>, kKernels> dipole{};  ///< not read when only charges are summed
  const double* squared_reach = nullptr;                        ///< where given: targets at this squared distance or nearer get nothing
                                                                ///< from a source, Å²; with dipoles and gradients only
};

/// Targets that are worked on at once: one register of the widest vector unit, four of the narrowest.
inline constexpr std::size_t kTargetLanes = 8;

/// Some targets, and the sums at them. Lanes without a target repeat one.
struct alignas(64) TargetLanes {
  double position[3][kTargetLanes];
  double potential[kKernels][kTargetLanes];
  double gradient[kKernels][3][kTargetLanes];
};

/// What the reach is compared with: whoever looks for the pairs that are left out finds just those.
inline double squared_distance(const double (&rho)[3]) {
  return rho[0] * rho[0] + rho[1] * rho[1] + rho[2] * rho[2];
}

enum class SourceKind { charges, charges_and_dipoles };
enum class TargetKind { potentials, potentials_and_gradients };

/// Adds to each target Σ_j q_j G(|x - y_j|) + d_j·∇_y G, and its gradient in x, for both kernels (without the factor 1/4π).
///
/// No target may be at the place of a source that has no reach. exp has a relative error of some 1e-14, and is e⁻⁷⁰⁸ beyond kappa·r = 708. Each target's terms are added
/// in the order of the sources, with the same bytes on every processor, whatever its vector unit.
/// Cost: 1.2 ns a pair for charges and potentials, 2.3 ns with dipoles and gradients (AVX-512; 2.6 and 5.0 with AVX2, 5.5 and 10 with SSE2).
/// \param kappa  1/ångström; at least 0.
void add_pair_sums(const SourceView& sources, double kappa, std::span<TargetLanes> targets, SourceKind source_kind, TargetKind target_kind);

}  // namespace smopt::metrics
