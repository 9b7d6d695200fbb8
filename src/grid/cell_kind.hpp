#pragma once
/// What a cell of the grid holds.

#include <cstdint>

namespace spindrift {

enum class CellKind : std::uint8_t {
  open,    ///< air and smoke
  solid,   ///< no open volume: terrain, cover
  core,    ///< dense flow, which moves its faces (R10)
  pocket,  ///< open cells shut in between core and bed: not projected
  still,   ///< air far from everything, which is not computed: at rest, pressure 0
};

}  // namespace spindrift
