#include "experiments/solvation_study/observed_limit.h"

#include <cmath>

namespace smopt::experiments {

std::optional<ObservedLimit> observed_limit(double coarse, double middle, double fine, double ratio) {
  const double shrinking = (coarse - middle) / (middle - fine);  // ratio^order
  if (!(shrinking > 1) || !std::isfinite(shrinking)) return std::nullopt;
  ObservedLimit limit;
  limit.value = fine + (fine - middle) / (shrinking - 1);
  limit.order = std::log(shrinking) / std::log(ratio);
  limit.distance = std::abs(fine / limit.value - 1);
  return limit;
}

}  // namespace smopt::experiments
