#include "experiments/ablation/effects.h"

#include <algorithm>
#include <numeric>

namespace smopt::experiments {
namespace {

/// Relative to the squares of the values: a sum of squares below is rounding.
constexpr double kRoundingRel = 1e-20;

/// One case with a value: its level of every factor.
struct ValuedCase {
  std::vector<std::size_t> levels;
  std::optional<double> value;
};

std::vector<ValuedCase> cases_of(const FactorialResponse& response) {
  std::vector<ValuedCase> cases;
  std::vector<std::size_t> levels(response.level_counts.size(), 0);
  for (const std::optional<double>& value : response.values) {
    cases.push_back({levels, value});
    for (std::size_t i = levels.size(); i-- > 0;) {
      if (++levels[i] < response.level_counts[i]) break;
      levels[i] = 0;
    }
  }
  return cases;
}

/// The level with the largest part of its cases without a value; nothing where every case has one.
std::optional<Effects::LeftOut> least_complete_level(const std::vector<ValuedCase>& cases, const std::vector<std::size_t>& level_counts) {
  std::optional<Effects::LeftOut> worst;
  double worst_part = 0;
  for (std::size_t factor = 0; factor < level_counts.size(); ++factor) {
    for (std::size_t level = 0; level < level_counts[factor]; ++level) {
      double missing = 0, all = 0;
      for (const ValuedCase& c : cases) {
        if (c.levels[factor] != level) continue;
        all += 1;
        missing += c.value ? 0 : 1;
      }
      if (all > 0 && missing / all > worst_part) {
        worst_part = missing / all;
        worst = {factor, level};
      }
    }
  }
  return worst;
}

/// Means over the cases that agree in the levels of some factors.
class CellMeans {
 public:
  CellMeans(const std::vector<ValuedCase>& cases, const std::vector<std::size_t>& level_counts) : cases_(cases), counts_(level_counts) {}

  [[nodiscard]] double all() const {
    double sum = 0;
    for (const ValuedCase& c : cases_) sum += *c.value;
    return sum / static_cast<double>(cases_.size());
  }

  /// By level of the one factor and of the other; for one factor give it twice.
  [[nodiscard]] std::vector<std::optional<double>> of(std::size_t factor, std::size_t other) const {
    std::vector<double> sums(counts_[factor] * counts_[other], 0), numbers(sums.size(), 0);
    for (const ValuedCase& c : cases_) {
      const std::size_t cell = c.levels[factor] * counts_[other] + c.levels[other];
      sums[cell] += *c.value;
      numbers[cell] += 1;
    }
    std::vector<std::optional<double>> means(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i)
      if (numbers[i] > 0) means[i] = sums[i] / numbers[i];
    return means;
  }

  [[nodiscard]] std::vector<std::optional<double>> of(std::size_t factor) const {
    const std::vector<std::optional<double>> cells = of(factor, factor);
    std::vector<std::optional<double>> means(counts_[factor]);
    for (std::size_t level = 0; level < means.size(); ++level) means[level] = cells[level * counts_[factor] + level];
    return means;
  }

 private:
  const std::vector<ValuedCase>& cases_;
  const std::vector<std::size_t>& counts_;
};

class Decomposition {
 public:
  Decomposition(const std::vector<ValuedCase>& cases, const std::vector<std::size_t>& level_counts)
      : cases_(cases), counts_(level_counts), means_(cases, level_counts), mean_(means_.all()) {
    for (std::size_t i = 0; i < counts_.size(); ++i) main_.push_back(means_.of(i));
  }

  [[nodiscard]] double mean() const { return mean_; }
  [[nodiscard]] const std::vector<std::vector<std::optional<double>>>& level_means() const { return main_; }

  [[nodiscard]] double total() const {
    return sum_over_cases([&](const ValuedCase& c) { return *c.value - mean_; });
  }
  [[nodiscard]] double of_main(std::size_t factor) const {
    return sum_over_cases([&](const ValuedCase& c) { return *main_[factor][c.levels[factor]] - mean_; });
  }
  [[nodiscard]] double of_interaction(std::size_t i, std::size_t j) const {
    const std::vector<std::optional<double>> cells = means_.of(i, j);
    return sum_over_cases([&](const ValuedCase& c) {
      return *cells[c.levels[i] * counts_[j] + c.levels[j]] - *main_[i][c.levels[i]] - *main_[j][c.levels[j]] + mean_;
    });
  }
  [[nodiscard]] bool is_varied(std::size_t factor) const {
    return std::count_if(main_[factor].begin(), main_[factor].end(), [](const auto& m) { return m.has_value(); }) > 1;
  }
  [[nodiscard]] bool is_any_varied() const {
    for (std::size_t i = 0; i < counts_.size(); ++i)
      if (is_varied(i)) return true;
    return false;
  }
  [[nodiscard]] double rounding() const {
    return kRoundingRel * sum_over_cases([&](const ValuedCase& c) { return *c.value; });
  }

 private:
  /// Of squares.
  template <class Part>
  double sum_over_cases(const Part& part) const {
    return std::accumulate(cases_.begin(), cases_.end(), 0.0, [&](double sum, const ValuedCase& c) { return sum + part(c) * part(c); });
  }

  const std::vector<ValuedCase>& cases_;
  const std::vector<std::size_t>& counts_;
  CellMeans means_;
  double mean_;
  std::vector<std::vector<std::optional<double>>> main_;
};

void add_shares(Effects& effects, const Decomposition& parts) {
  const std::size_t factors = effects.level_means.size();
  effects.shares.assign(factors, std::vector<std::optional<double>>(factors));
  const double total = parts.total();
  effects.varies = total > parts.rounding();
  if (!effects.varies) return;
  double rest = 1;
  for (std::size_t i = 0; i < factors; ++i) {
    for (std::size_t j = i; j < factors; ++j) {
      if (!parts.is_varied(i) || !parts.is_varied(j)) continue;
      const double share = (i == j ? parts.of_main(i) : parts.of_interaction(i, j)) / total;
      effects.shares[i][j] = effects.shares[j][i] = share;
      rest -= share;
    }
  }
  effects.rest_share = std::max(0.0, rest);
}

}  // namespace

std::optional<Effects> effects_of(const FactorialResponse& response) {
  Effects effects;
  std::vector<ValuedCase> cases = cases_of(response);
  while (const auto worst = least_complete_level(cases, response.level_counts)) {
    effects.left_out.push_back(*worst);
    std::erase_if(cases, [&](const ValuedCase& c) { return c.levels[worst->factor] == worst->level; });
  }
  if (cases.empty()) return std::nullopt;
  const Decomposition parts(cases, response.level_counts);
  if (!parts.is_any_varied()) return std::nullopt;
  effects.mean = parts.mean();
  effects.level_means = parts.level_means();
  add_shares(effects, parts);
  return effects;
}

}  // namespace smopt::experiments
