// The middle and the ends of what several rounds gave.
#pragma once

#include <algorithm>
#include <vector>

namespace bench {

struct Spread {
  double median = 0, least = 0, most = 0;
};

inline Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back()};
}

// The spread of what `figure` says of each run.
template <class Run, class Figure>
Spread spread_of(const std::vector<Run> &runs, const Figure &figure) {
  std::vector<double> values;
  for (const Run &run : runs) values.push_back(figure(run));
  return spread_of(values);
}

}  // namespace bench
