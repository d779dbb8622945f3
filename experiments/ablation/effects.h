#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace smopt::experiments {

/// What came out of every case of a full factorial design.
struct FactorialResponse {
  std::vector<std::size_t> level_counts;  ///< of each factor
  std::vector<std::optional<double>>
      values;  ///< of each combination, the last factor's level changing fastest; nothing where there is none
};

/// What each factor, and each two together, do to a number, over a full factorial design.
///
/// The number is taken apart as mean + main effects + two-factor interactions + rest; the design is balanced, so the parts are orthogonal and
/// their sums of squares add up to the whole variation between the cases (Montgomery, Design and Analysis of Experiments, chapter 5). The
/// cases are computed, not drawn: there is no error term, and no test of significance.
struct Effects {
  /// Mean over all cases with that level of that factor; nothing at a level that was left out.
  std::vector<std::vector<std::optional<double>>> level_means;
  /// Part of the variation, 0 to 1: of a factor's main effect on the diagonal, of two factors' interaction beside it (symmetric). Nothing for a
  /// factor with one level left, and nowhere anything where all cases are alike.
  std::vector<std::vector<std::optional<double>>> shares;
  std::optional<double> rest_share;  ///< interactions of three factors and more
  double mean = 0;
  bool varies = false;  ///< whether the cases differ at all

  /// A level that takes no part in the other numbers.
  struct LeftOut {
    std::size_t factor = 0;
    std::size_t level = 0;
  };
  std::vector<LeftOut> left_out;
};

/// Works out the effects. Where a case has no value the design is not balanced any more: the level with the largest part of its cases
/// missing is left out, until the rest is complete. \return nothing when no factor has two levels left.
/// Cost: O(cases × factors²).
std::optional<Effects> effects_of(const FactorialResponse& response);

}  // namespace smopt::experiments
