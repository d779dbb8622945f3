#pragma once

namespace smopt::experiments {

/// What a quantity tends to as the spacing goes to zero.
struct Limit {
  double value = 0;
  double residual = 0;  ///< how much the extrapolation still changed when the finest surface came in
  double order = 0;     ///< seen in the three values; 2 is what the extrapolation takes it to be
};

/// Richardson's extrapolation of a quantity of second order (area and volume of a surface with vertices where φ crosses the edges of a
/// grid) from its values at spacings 4h, 2h and h: from the last two, (4·fine − middle)/3.
Limit richardson_limit(double coarse, double middle, double fine);

}  // namespace smopt::experiments
