#include "io/lattice_points.hpp"

namespace spindrift {

StoredCloud lattice_points(const StoredFrame& image, std::span<const std::size_t> points) {
  const Lattice& lattice = *image.lattice;
  std::vector<float> positions;
  positions.reserve(3 * points.size());
  for (std::size_t rest : points)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t n = static_cast<std::size_t>(lattice.shape[axis]);
      positions.push_back(
          static_cast<float>(lattice.origin[axis] + static_cast<double>(rest % n) * lattice.spacing[axis]));
      rest /= n;
    }

  StoredCloud cloud{{"Points", 3, std::move(positions)}, {}};
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
