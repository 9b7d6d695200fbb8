#include "verification/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spindrift {

void ErrorNorms::add(double value, double reference, double weight) {
  difference_squared_ += weight * (value - reference) * (value - reference);
  reference_squared_ += weight * reference * reference;
  // A maximum that forgets no NaN.
  const double difference = std::abs(value - reference);
  if (!(difference <= difference_max_)) difference_max_ = difference;
  reference_max_ = std::max(reference_max_, std::abs(reference));
}

double ErrorNorms::l2() const {
  return std::sqrt(reference_squared_ > 0 ? difference_squared_ / reference_squared_ : difference_squared_);
}

double ErrorNorms::max() const {
  return reference_max_ > 0 ? difference_max_ / reference_max_ : difference_max_;
}

Series with_settings(const Series& base, std::string factor, std::string label,
                     const std::vector<std::string>& settings) {
  Series series{std::move(factor), std::move(label), base.settings, base.levels};
  series.settings.insert(series.settings.end(), settings.begin(), settings.end());
  for (Level& level : series.levels) level.gate = std::numeric_limits<double>::infinity();
  return series;
}

Series first_levels(Series series, std::size_t n) {
  series.levels.resize(n);
  return series;
}

Series over_values(const Series& base, std::size_t level, std::string factor, std::string key,
                   const std::vector<std::string>& values) {
  const Level& at = base.levels.at(level);
  Series series{std::move(factor), fmt::format("{}, {}", key, at.label), base.settings, {}};
  series.settings.insert(series.settings.end(), at.settings.begin(), at.settings.end());
  for (const std::string& value : values) series.levels.push_back({value, {fmt::format("{}={}", key, value)}});
  return series;
}

Series over_supports(const Series& base, std::size_t level, std::string factor, std::string kernel,
                     const std::vector<double>& ratios) {
  const Level& at = base.levels.at(level);
  Series series{std::move(factor), fmt::format("{}, {}", kernel, at.label), base.settings, {}};
  series.settings.push_back("dense_flow.kernel=" + kernel);
  for (const double ratio : ratios)
    series.levels.push_back({fmt::format("h/d = {}", ratio),
                             {fmt::format("dense_flow.support_radius={}", ratio * at.size),
                              fmt::format("dense_flow.support_ratio={}", ratio)}});
  return series;
}

}  // namespace spindrift
