#include "io/lattice_points.hpp"

#include <algorithm>
#include <cmath>

namespace spindrift {
namespace {

template <class T>
StoredArray positions(const Lattice& lattice, std::span<const std::size_t> points) {
  std::vector<T> places;
  places.reserve(3 * points.size());
  for (std::size_t rest : points)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t n = static_cast<std::size_t>(lattice.shape[axis]);
      places.push_back(static_cast<T>(lattice.origin[axis] + static_cast<double>(rest % n) * lattice.spacing[axis]));
      rest /= n;
    }
  return {"Points", 3, std::move(places)};
}

}  // namespace

StoredCloud lattice_points(const StoredFrame& image, std::span<const std::size_t> points) {
  const auto is_far = [](double x) { return std::abs(x) > far_from_zero; };
  StoredCloud cloud{std::ranges::any_of(image.lattice->origin, is_far) ? positions<double>(*image.lattice, points)
                                                                       : positions<float>(*image.lattice, points),
                    {}};
  for (const StoredArray& array : image.arrays) {
    const std::size_t components = static_cast<std::size_t>(array.components);
    std::visit(
        [&](const auto& from) {
          std::decay_t<decltype(from)> to;
          to.reserve(points.size() * components);
          for (const std::size_t point : points)
            for (std::size_t k = 0; k < components; ++k) to.push_back(from[point * components + k]);
          cloud.arrays.push_back({array.name, array.components, std::move(to)});
        },
        array.values);
  }
  return cloud;
}

}  // namespace spindrift
