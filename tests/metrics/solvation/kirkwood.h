#pragma once

#include <span>
#include <vector>

#include "smopt/geometry/vec3.h"

/// The analytic oracle of the Poisson–Boltzmann solver: point charges in a dielectric sphere in an electrolyte (Kirkwood 1934,
/// J. Chem. Phys. 2:351, without an ion-exclusion layer). It shares nothing with the solver.
///
/// Lengths in ångström, charges in e, energies in kcal/mol. Potentials are scaled so that a charge alone in the inner medium has
/// q/(4π ε_in r). The sphere of radius a is centred at the origin; its normal n points outwards.
///
/// Derivation. Inside, −ε_in ∇²φ = Σ q δ; outside, ∇²φ = κ²φ and φ → 0; on the sphere φ and permittivity · ∂φ/∂n are continuous. A charge
/// q at distance s < a, seen under the angle γ, has the Coulomb potential Σ_n c s^n/r^(n+1) P_n(cos γ) for r > s, c = q/(4π ε_in). To it
/// the sphere adds Σ_n A_n r^n P_n inside; outside φ is Σ_n u_n k_n(κr)/k_n(κa) P_n, so u_n is the n-th part of φ on the sphere. With
///   L_n = −κa k_n'(κa)/k_n(κa) = n + 1 + κa k_(n−1)(κa)/k_n(κa)   (n + 1 for κ = 0)   and   ε = ε_out/ε_in
/// the two conditions for each n are
///   c s^n/a^(n+1) + A_n a^n = u_n   and   −(n+1) c s^n/a^(n+1) + n A_n a^n = −ε L_n u_n,
/// hence
///   u_n = (2n+1)/(n + ε L_n) · c s^n/a^(n+1),   ∂φ_n/∂n (inside) = −ε L_n u_n/a,
///   A_n a^n = (n + 1 − ε L_n)/(n + ε L_n) · c s^n/a^(n+1),
/// and E = ½ Σ_i q_i Σ_j Σ_n A_n(j) s_i^n P_n(cos γ_ij). A central charge has n = 0 alone, with L_0 = 1 + κa: Born's energy.
namespace smopt::testing {

/// e²/(4π ε_0) in kcal Å/mol, as AFMPB has it (reference, section AFMPB).
inline constexpr double kCoulombConstant = 332.06;

struct DielectricSphere {
  double inner;  ///< relative permittivity inside, > 0
  double outer;  ///< relative permittivity of the electrolyte, > 0
  double kappa;  ///< inverse Debye length of the electrolyte, 1/Å, ≥ 0
};

struct PointCharge {
  Vec3 position;  ///< Å
  double charge;  ///< e
};

/// A boundary-element solver's two unknowns at a point of the surface.
struct SurfacePotential {
  double potential;          ///< φ, e/Å
  double normal_derivative;  ///< ∂φ/∂n just inside the surface, e/Å²
};

/// Polar solvation energy of one charge at the centre, kcal/mol (Born 1920, with the electrolyte's factor of Debye and Hückel).
double born_energy(double charge, double radius, const DielectricSphere& medium);

/// Polar (reaction-field) solvation energy of charges in a sphere, kcal/mol, to rounding: what each pair's series leaves out is below
/// 1e-20 of q_i q_j/(4π ε_in a).
/// \throws InvalidInput when a charge is not inside the sphere, or within 5e-5 radii of it (the series would have millions of terms), or
/// when radius or medium are out of range.
/// Cost: O(charges² / (1 − s/a)) for the outermost charge's distance s; a charge at 0.999 a takes about 35 000 terms.
double kirkwood_energy(double radius, const DielectricSphere& medium, std::span<const PointCharge> charges);

/// The total potential and its inner normal derivative at a point of the sphere.
/// \throws InvalidInput as `kirkwood_energy`, and when the point is farther than 1e-5 radii from the sphere.
SurfacePotential kirkwood_potential(double radius, const DielectricSphere& medium, std::span<const PointCharge> charges, const Vec3& point);

/// What the sphere adds to the charges' Coulomb potential at a point in or on it.
/// \throws InvalidInput as `kirkwood_energy`, and for a point outside.
double kirkwood_reaction_potential(double radius, const DielectricSphere& medium, std::span<const PointCharge> charges, const Vec3& point);

/// The total potential at a point outside or on the sphere.
/// \throws InvalidInput as `kirkwood_energy`, and for a point inside.
double kirkwood_exterior_potential(double radius, const DielectricSphere& medium, std::span<const PointCharge> charges, const Vec3& point);

/// Modified spherical Bessel functions of the second kind without their singularity: z^(n+1) e^z k_n(z)/(2n−1)!! for n = 0 … count − 1,
/// where k_0 = e^(−z)/z. All are between 1 (their value at z = 0) and e^z, and the upward recurrence has positive terms only, so nothing
/// overflows or cancels for large n and small z.
/// \pre count ≥ 1, 0 ≤ z < 11000 (e^z in long double).
std::vector<long double> scaled_spherical_k(int count, long double z);

}  // namespace smopt::testing
