#pragma once
/// The median.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace spindrift {

/// The value in the middle by size; of an even number the larger of the two there.   Pre: one value at least, no NaN.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace spindrift
