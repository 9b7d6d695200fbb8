#include "io/map_polygons.hpp"

#include <fmt/format.h>

#include <cmath>

#include "io/gdal_module.hpp"

namespace spindrift {
namespace {

using Ring = std::vector<std::array<double, 2>>;

/// Twice the area, with the sign of the ring's sense.
double twice_area(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    // About the first point: coordinates of a map have six digits before the point.
    const auto &a = ring[i], &b = ring[(i + 1) % ring.size()], &o = ring.front();
    sum += (a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1]);
  }
  return sum;
}

}  // namespace

bool MapPolygon::contains(double x, double y) const {
  bool inside = false;
  for (const Ring& ring : rings)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const auto &a = ring[i], &b = ring[j];
      if ((a[1] > y) != (b[1] > y) && x - a[0] < (b[0] - a[0]) * ((y - a[1]) / (b[1] - a[1]))) inside = !inside;
    }
  return inside;
}

std::vector<std::array<double, 2>> MapPolygon::one_ring() const {
  Ring ring = rings.front();
  for (std::size_t i = 1; i < rings.size(); ++i) {
    const std::array<double, 2> from = ring.back();
    ring.insert(ring.end(), rings[i].begin(), rings[i].end());
    ring.push_back(rings[i].front());
    ring.push_back(from);
  }
  return ring;
}

double MapPolygon::area() const {
  double sum = 0;
  for (std::size_t i = 0; i < rings.size(); ++i) sum += (i == 0 ? 0.5 : -0.5) * std::abs(twice_area(rings[i]));
  return sum;
}

MapFileError no_map_files(const std::filesystem::path& file) {
  return MapFileError(
      fmt::format("{}: this build reads no shapefiles or GeoJSON; install libgdal-dev, then configure and build again",
                  file.string()));
}

#ifndef SPINDRIFT_GDAL

bool reads_map_files() {
  return false;
}

std::vector<MapPolygon> read_map_polygons(const std::filesystem::path& file) {
  throw no_map_files(file);
}

#else

bool reads_map_files() {
  return true;
}

std::vector<MapPolygon> read_map_polygons(const std::filesystem::path& file) {
  return load_module<GdalModule>(file.string()).read_polygons(file);
}

#endif

}  // namespace spindrift
