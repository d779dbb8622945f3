#pragma once

#include <span>

#include "smopt/mesh/triangle_mesh.h"
#include "tests/metrics/solvation/kirkwood.h"

namespace smopt::testing {

/// The polar energy (kcal/mol) that given surface unknowns stand for, by the plainest sum there is, for comparing a solver's energy with.
///
///   E = ½ · 4π · 332.06 · Σ_k q_k ∫ [K1(x_k, y) ∂φ/∂ν + K2(x_k, y) φ] dS_y,   K1 = G0 − Gκ,   K2 = ε ∂Gκ/∂ν − ∂G0/∂ν,
///   G0 = 1/(4πr),   Gκ = e^(−κr)/(4πr),   ε = outer/inner   (Juffer et al. 1991; Geng & Krasny 2013)
/// over the flat triangles with their own normals, the unknowns linear on each. Every triangle is divided into four, each with the 7-point
/// rule of degree 5 (Radon 1948), in long double. With exact unknowns at the vertices the error is the mesh's, second order in the edge
/// length. The rule itself errs by 2e-7 for a charge one edge length below the surface (of the solid angle, on icospheres), by 4e-5 for
/// half an edge length, by 3e-3 for a quarter.
/// \param unknowns  one for each vertex, in the units of `SurfacePotential`.
/// \pre   no charge is on the surface; triangles point outwards. A triangle without area adds nothing.
/// \throws InvalidInput when the numbers of unknowns and of vertices differ.
/// Cost: 28 kernels for each triangle and charge.
double direct_polar_energy(const TriangleMesh& mesh, const DielectricSphere& medium, std::span<const PointCharge> charges,
                           std::span<const SurfacePotential> unknowns);

}  // namespace smopt::testing
