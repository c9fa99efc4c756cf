// Pearson's chi-square test of observed counts against expected ones.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace raytrace::test {

/// How many standard deviations the counts lie from what chance gives (Wilson and Hilferty's normal approximation):
/// beyond +4 the counts do not follow `expected` (one in 30,000 by chance), below -4 they are too even to be random.
/// Cells in which fewer than 10 are expected are put together.
inline double chi_square_deviation(const std::vector<double>& observed, const std::vector<double>& expected) {
  double statistic = 0, cells = 0, rare_observed = 0, rare_expected = 0;
  const auto add = [&](double seen, double wanted) {
    statistic += (seen - wanted) * (seen - wanted) / wanted;
    ++cells;
  };
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] >= 10) {
      add(observed[i], expected[i]);
    } else {
      rare_observed += observed[i];
      rare_expected += expected[i];
    }
  }
  // What falls where nothing may fall is wrong however rare it is.
  if (rare_observed > 0 || rare_expected > 0) add(rare_observed, std::fmax(rare_expected, 1e-3));
  const double freedom = cells - 1, spread = 2 / (9 * freedom);
  return (std::cbrt(statistic / freedom) - (1 - spread)) / std::sqrt(spread);
}

/// The same where all cells are equally likely.
inline double chi_square_deviation(const std::vector<double>& observed) {
  double total = 0;
  for (const double count : observed) total += count;
  return chi_square_deviation(observed,
                              std::vector<double>(observed.size(), total / static_cast<double>(observed.size())));
}

}  // namespace raytrace::test
