#include "bie/bench/repeats.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vehd {

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double median = 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
  return {median, values.front(), values.back(), static_cast<std::int64_t>(values.size())};
}

bool wants_repeat(const std::vector<double>& seconds, int repeats) {
  constexpr double kEnough = 4.0;
  return static_cast<int>(seconds.size()) < repeats && std::accumulate(seconds.begin(), seconds.end(), 0.0) < kEnough;
}

double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += std::log(x[i]) / n;
    mean_y += std::log(y[i]) / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (std::log(x[i]) - mean_x) * (std::log(x[i]) - mean_x);
    xy += (std::log(x[i]) - mean_x) * (std::log(y[i]) - mean_y);
  }
  return xy / xx;
}

}  // namespace vehd
