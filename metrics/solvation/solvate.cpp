#include "metrics/solvation/solvate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "metrics/extent.h"
#include "metrics/solvation/boundary_operator.h"
#include "metrics/solvation/charge_sums.h"
#include "metrics/solvation/charges_outside.h"
#include "metrics/solvation/gmres.h"
#include "metrics/solvation/memory_prediction.h"
#include "metrics/solvation/solvable_surface.h"
#include "smopt/error.h"
#include "smopt/mesh/orientation.h"
#include "smopt/physical_memory.h"
#include "smopt/timing.h"

namespace smopt::metrics {
namespace {

constexpr double kBytesPerMb = 1024.0 * 1024.0;

/// GMRES goes by a residual that it carries along; what is recomputed may be larger by rounding.
constexpr double kResidualSlack = 1.01;

void require_valid(const SolvationOptions& options) {
  const DielectricModel& medium = options.medium;
  const auto require = [](bool is_valid, const char* what) {
    if (!is_valid) throw InvalidOption(fmt::format("solvation: {}", what));
  };
  require(medium.inner > 0 && std::isfinite(medium.inner), "the inner permittivity must be positive and finite");
  require(medium.outer > 0 && std::isfinite(medium.outer), "the outer permittivity must be positive and finite");
  require(medium.ionic_strength >= 0 && std::isfinite(medium.ionic_strength), "the ionic strength must be at least 0 and finite");
  require(medium.temperature > 0 && std::isfinite(medium.temperature), "the temperature must be positive and finite");
  require(std::isfinite(medium.kappa()), "ionic strength, outer permittivity and temperature give no finite screening length");
  require(std::isfinite(options.surface_tension), "the surface tension must be finite");
  require(std::isfinite(options.pressure), "the pressure must be finite");
  require(options.residual > 0 && options.residual < 1, "the residual must be in (0, 1)");
  require(options.max_iterations >= 1, "the number of iterations must be at least 1");
  require(options.restart >= 1, "the restart must be at least 1");
  require(options.block >= 1, "the block must be at least 1");
}

void require_finite(const Molecule& molecule) {
  for (std::size_t k = 0; k < molecule.atom_count(); ++k)
    if (!molecule.centers[k].allFinite() || !std::isfinite(molecule.charges[k]))
      throw InvalidInput(fmt::format("solvation: atom {} has a coordinate or a charge that is not finite", k));
}

bool has_charges(const Molecule& molecule) {
  return std::ranges::any_of(molecule.charges, [](double q) { return q != 0; });
}

/// One stage for what reports several, of which each starts anew: the bar does not go back.
ProgressCallback as_stage(const ProgressCallback& progress, std::string name, double begin = 0, double end = 1) {
  if (!progress) return {};
  return [&progress, name = std::move(name), begin, end, furthest = 0.0](std::string_view, double fraction) mutable {
    furthest = std::max(furthest, fraction);
    return progress(name, begin + furthest * (end - begin));
  };
}

/// How far a solve is whose length nobody knows: each product with the matrix brings it the same part of what is left nearer to its end.
double part_solved_after(int products) {
  constexpr double kUsual = 20;  // iterations on a molecule's improved mesh
  return products / (products + kUsual);
}

GmresResult solve(const BoundaryOperator& equations, Eigen::VectorXd right_side, const SolvationOptions& options) {
  int products = 0;
  LinearSystem system;
  system.product = [&](const Eigen::VectorXd& x) {
    const double before = part_solved_after(products++);
    return equations.product(x, as_stage(options.progress, "solving", before, part_solved_after(products)));
  };
  system.preconditioned = [&](const Eigen::VectorXd& r) { return equations.preconditioned(r); };
  system.right_side = std::move(right_side);
  return solve_by_gmres(system, {options.residual, options.max_iterations, options.restart});
}

void end_as(Solvation& result, SolvationStatus status, std::string reason) {
  result.status = status;
  result.reason = std::move(reason);
  if (status == SolvationStatus::nonfinite) result.polar = std::numeric_limits<double>::quiet_NaN();
}

/// Where a vector of unknowns or equations has its first number that is not finite, as a vertex of the surface.
VertexId first_nonfinite(const Eigen::VectorXd& vector, const SolvableSurface& surface) {
  const auto n = static_cast<Eigen::Index>(surface.surface.size());
  Eigen::Index i = 0;
  while (std::isfinite(vector[i])) ++i;
  return surface.vertices[static_cast<std::size_t>(i % n)];
}

void spread(const Eigen::VectorXd& unknowns, const SolvableSurface& surface, Solvation& result) {
  const auto n = static_cast<Eigen::Index>(surface.surface.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    const VertexId v = surface.vertices[static_cast<std::size_t>(i)];
    result.potential[v] = kPotentialUnit * unknowns[i];
    result.normal_derivative[v] = kPotentialUnit * unknowns[n + i];
  }
}

void solve_for_polar(const SolvableSurface& surface, const Molecule& molecule, const SolvationOptions& options, Solvation& result) {
  const DielectricModel& medium = options.medium;
  const SurfaceSums sums = surface_sums_for(options.accuracy, medium.kappa(), options.is_direct);
  Eigen::VectorXd right_side = ChargeSums(surface.surface, molecule, medium, sums).right_side(as_stage(options.progress, "charges"));
  if (!right_side.allFinite())
    return end_as(
        result, SolvationStatus::nonfinite,
        fmt::format("the charges' potential is not finite at vertex {}: a charge lies on it", first_nonfinite(right_side, surface)));
  if (right_side.isZero(0)) return spread(right_side, surface, result);  // charges that cancel where they are
  Eigen::VectorXd unknowns;
  {
    const BoundaryOperator equations(surface.surface, {medium.kappa(), medium.ratio()}, sums, static_cast<std::size_t>(options.block),
                                     options.progress);
    GmresResult solved = solve(equations, std::move(right_side), options);
    result.iterations = solved.iterations;
    result.relative_residual = solved.relative_residual;
    unknowns = std::move(solved.solution);
  }
  if (!std::isfinite(result.relative_residual))
    return end_as(result, SolvationStatus::nonfinite, "a product with the system's matrix is not finite");
  spread(unknowns, surface, result);
  result.polar = ChargeSums(surface.surface, molecule, medium, sums).energy(unknowns, as_stage(options.progress, "energy"));
  if (!std::isfinite(result.polar)) return end_as(result, SolvationStatus::nonfinite, "the energy is not finite");
  if (result.relative_residual > kResidualSlack * options.residual)
    end_as(result, SolvationStatus::not_converged,
           fmt::format("the relative residual is {:.1e} after {} iterations, where {:.1e} was asked", result.relative_residual,
                       result.iterations, options.residual));
}

void require_memory(double bytes, const SolvationOptions& options) {
  const double most = static_cast<double>(options.max_memory_bytes == 0 ? physical_memory_bytes() : options.max_memory_bytes);
  if (bytes > most)
    throw InvalidInput(fmt::format("the solvation energy would need some {:.0f} MB of memory, more than the limit of {:.0f} MB",
                                   bytes / kBytesPerMb, most / kBytesPerMb));
}

}  // namespace

std::string to_string(SolvationStatus status) {
  constexpr std::array<const char*, 4> kNames = {"success", "not_converged", "nonfinite", "no_charges"};
  return kNames[static_cast<std::size_t>(status)];
}

Solvation solvate(const TriangleMesh& mesh, const Molecule& molecule, const SolvationOptions& options) {
  const Stopwatch watch;
  require_valid(options);
  require_finite(molecule);
  const SolvableSurface surface(mesh);
  Solvation result;
  const double bytes = predicted_solvation_bytes(surface.surface, molecule, options);
  require_memory(bytes, options);
  result.predicted_memory_mb = bytes / kBytesPerMb;
  result.area = surface_area(surface.surface.mesh);
  result.volume = signed_volume(surface.surface.mesh);
  result.nonpolar = options.surface_tension * result.area + options.pressure * result.volume;
  for (const VertexId v : degenerate_vertices(surface.surface.mesh, surface.surface.stars))
    result.degenerate_vertices.push_back(surface.vertices[v]);
  result.charges_outside = count_charges_outside(surface.surface.mesh, molecule);
  const bool is_charged = has_charges(molecule);
  const double nowhere = std::numeric_limits<double>::quiet_NaN();
  result.potential.assign(mesh.vertex_count(), nowhere);
  result.normal_derivative.assign(mesh.vertex_count(), nowhere);
  if (is_charged) {
    solve_for_polar(surface, molecule, options, result);
  } else {
    spread(Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(surface.surface.size())), surface, result);
    end_as(result, SolvationStatus::no_charges, "all charges are 0");
  }
  result.seconds = watch.elapsed().wall;
  return result;
}

double predicted_solvation_bytes(const TriangleMesh& mesh, const Molecule& molecule, const SolvationOptions& options) {
  require_valid(options);
  return predicted_solvation_bytes(SolvableSurface(mesh).surface, molecule, options);
}

}  // namespace smopt::metrics
