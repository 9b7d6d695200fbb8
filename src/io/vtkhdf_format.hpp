#pragma once
/// What the writer and the reader of VTKHDF agree upon.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "io/vtkhdf.hpp"

namespace spindrift {

namespace vtkhdf {
inline constexpr const char* root_group = "VTKHDF";
inline constexpr const char* point_data = "PointData";
inline constexpr const char* own_group = "spindrift";
inline constexpr const char* positions = "Points";
inline constexpr const char* point_cloud = "UnstructuredGrid";
inline constexpr const char* lattice_image = "ImageData";
inline constexpr std::array<std::int64_t, 2> vtk_version{1, 0};
inline constexpr std::array<std::int64_t, 2> format_version{1, 0};  ///< of ours; a reader refuses a newer first number
inline constexpr std::uint8_t vertex = 1;                           ///< VTK_VERTEX
}  // namespace vtkhdf

/// The digest that a file carries: over the lattice, if any, and the arrays (name, components, type, values).
std::string frame_digest(const std::optional<Lattice>& lattice, std::span<const NamedArray> sorted_arrays);

}  // namespace spindrift
