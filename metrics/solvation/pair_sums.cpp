#include "metrics/solvation/pair_sums.h"

#include <bit>
#include <cmath>
#include <cstdint>

// Compiled for several vector units, of which the best that is present is used.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define SMOPT_FOR_ALL_VECTOR_UNITS [[gnu::target_clones("avx512f", "avx2", "default")]]
#else
#define SMOPT_FOR_ALL_VECTOR_UNITS
#endif

namespace smopt::metrics {
namespace {

/// exp(t) for t <= 0, in operations that the compiler can do on several numbers at once: 2ᵏ·exp(f) with |f| <= ln(2)/2, exp(f) by its Taylor
/// series, whose rest is 6e-15 after the eleventh power.
[[gnu::always_inline]] inline double exp_of_negative(double t) {
  constexpr double kLowest = -708;       // e⁻⁷⁰⁸ is still a normal number
  constexpr double kRounder = 0x1.8p52;  // added to a number, leaves its nearest integer in the last bits
  constexpr double kLog2E = 1.4426950408889634;
  constexpr double kLn2High = 0x1.62e42fee00000p-1;  // so few bits that its product with k is exact
  constexpr double kLn2Low = 0x1.a39ef35793c76p-33;  // ln(2) - kLn2High
  constexpr std::uint64_t kExponentBias = 1023;
  t = t < kLowest ? kLowest : t;
  const double shifted = t * kLog2E + kRounder;
  const double k = shifted - kRounder;
  const double f = (t - k * kLn2High) - k * kLn2Low;
  double sum = 1.0 / 39916800;
  sum = sum * f + 1.0 / 3628800;
  sum = sum * f + 1.0 / 362880;
  sum = sum * f + 1.0 / 40320;
  sum = sum * f + 1.0 / 5040;
  sum = sum * f + 1.0 / 720;
  sum = sum * f + 1.0 / 120;
  sum = sum * f + 1.0 / 24;
  sum = sum * f + 1.0 / 6;
  sum = sum * f + 0.5;
  sum = sum * f + 1;
  sum = sum * f + 1;
  return sum * std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + kExponentBias) << 52);
}

/// What one kernel's function of the distance gives: G itself, A = -G'/r and B = -A'/r, so that ∇_y G = A·ρ and ∇_x (A·d·ρ) = A·d - B·(d·ρ)·ρ
/// with ρ = x - y.
struct Radial {
  double g;
  double a;
  double b;
};

template <SourceKind sources, TargetKind targets>
[[gnu::always_inline]] inline void add_one(const SourceView& s, std::size_t j, std::size_t kernel, const Radial& radial,
                                           const double (&rho)[3], TargetLanes& t, std::size_t lane) {
  constexpr bool has_dipoles = sources == SourceKind::charges_and_dipoles;
  constexpr bool has_gradients = targets == TargetKind::potentials_and_gradients;
  const double q = s.charge[kernel][j];
  double potential = q * radial.g;
  double along_rho = -q * radial.a;  // the part of the gradient in ρ's direction
  if constexpr (has_dipoles) {
    const auto& d = s.dipole[kernel];
    const double d_rho = d[0][j] * rho[0] + d[1][j] * rho[1] + d[2][j] * rho[2];
    potential += d_rho * radial.a;
    along_rho -= d_rho * radial.b;
  }
  t.potential[kernel][lane] += potential;
  if constexpr (has_gradients) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double gradient = along_rho * rho[axis];
      if constexpr (has_dipoles) gradient += s.dipole[kernel][axis][j] * radial.a;
      t.gradient[kernel][axis][lane] += gradient;
    }
  }
}

template <SourceKind sources, TargetKind targets, bool has_reach>
[[gnu::always_inline]] inline void add_to_lanes(const SourceView& s, double kappa, TargetLanes& result) {
  TargetLanes t = result;  // a copy that nothing else can point to stays in registers
  for (std::size_t j = 0; j < s.count; ++j) {
    for (std::size_t lane = 0; lane < kTargetLanes; ++lane) {
      const double rho[3] = {t.position[0][lane] - s.position[0][j], t.position[1][lane] - s.position[1][j],
                             t.position[2][lane] - s.position[2][j]};
      const double square = squared_distance(rho);
      const double r = std::sqrt(square);
      double g0 = 1 / r;
      if constexpr (has_reach) g0 = square <= s.squared_reach[j] ? 0 : g0;
      const double inverse_square = g0 * g0;
      const double a0 = g0 * inverse_square;
      const double kr = kappa * r;
      const double gk = exp_of_negative(-kr) * g0;
      const double gk_by_square = gk * inverse_square;
      const Radial plain = {g0, a0, 3 * a0 * inverse_square};
      const Radial screened = {gk, (1 + kr) * gk_by_square, (3 + kr * (3 + kr)) * gk_by_square * inverse_square};
      add_one<sources, targets>(s, j, kPlain, plain, rho, t, lane);
      add_one<sources, targets>(s, j, kScreened, screened, rho, t, lane);
    }
  }
  result = t;
}

template <SourceKind sources, TargetKind targets, bool has_reach = false>
[[gnu::always_inline]] inline void add_to_all(const SourceView& s, double kappa, std::span<TargetLanes> t) {
  for (TargetLanes& lanes : t) add_to_lanes<sources, targets, has_reach>(s, kappa, lanes);
}

}  // namespace

SMOPT_FOR_ALL_VECTOR_UNITS
void add_pair_sums(const SourceView& sources, double kappa, std::span<TargetLanes> targets, SourceKind source_kind,
                   TargetKind target_kind) {
  using enum SourceKind;
  using enum TargetKind;
  const bool has_dipoles = source_kind == charges_and_dipoles;
  if (sources.squared_reach != nullptr) return add_to_all<charges_and_dipoles, potentials_and_gradients, true>(sources, kappa, targets);
  if (target_kind == potentials) {
    if (has_dipoles) return add_to_all<charges_and_dipoles, potentials>(sources, kappa, targets);
    return add_to_all<charges, potentials>(sources, kappa, targets);
  }
  if (has_dipoles) return add_to_all<charges_and_dipoles, potentials_and_gradients>(sources, kappa, targets);
  add_to_all<charges, potentials_and_gradients>(sources, kappa, targets);
}

}  // namespace smopt::metrics
