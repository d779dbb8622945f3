#include "experiments/convergence/richardson.h"

#include <cmath>

namespace smopt::experiments {
namespace {

double extrapolated(double coarser, double finer) {
  return (4 * finer - coarser) / 3;
}

}  // namespace

Limit richardson_limit(double coarse, double middle, double fine) {
  Limit limit;
  limit.value = extrapolated(middle, fine);
  limit.residual = std::abs(limit.value - extrapolated(coarse, middle));
  limit.order = std::log2(std::abs((coarse - middle) / (middle - fine)));
  return limit;
}

}  // namespace smopt::experiments
