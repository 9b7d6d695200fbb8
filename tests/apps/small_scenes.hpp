#pragma once

#include <string>

namespace spindrift::testing {

/// Fifty particles in a closed box, 20 ms.
inline const std::string box_scene = R"(schema_version = 1
[scene]
end_time = "20 ms"
[domain]
lower = [0, 0]
upper = [8, 4]
left = "closed"
right = "closed"
[release]
shape = "box"
lower = [0, 0]
upper = [1, 2]
[dense_flow]
support_radius = 0.4
[output]
preview = false
)";

/// A small avalanche with all three layers.
inline const std::string avalanche = R"(schema_version = 1
[scene]
end_time = 0.5
[domain]
lower = [0, 0]
upper = [20, 14]
[terrain]
start = [0, 11]
angle = "38 deg"
drop = 9
transition_radius = 4
[release]
at = 1
length = 2.5
thickness = 1.05
velocity = [4, -3]
[dense_flow]
support_radius = 0.21
[cover]
depth = 0.42
[suspension]
cell_size = 0.33
[coupling.drag]
[coupling.generation]
threshold_speed = 0
[coupling.adhesion]
[entrainment]
[output]
frames_per_second = 10
preview_width = 201
)";

/// The same in 3D, a slice a metre wide about y = 0.
inline const std::string avalanche_3d = R"(schema_version = 1
[scene]
dim = 3
end_time = 0.2
[domain]
lower = [0, -0.5, 0]
upper = [8, 0.5, 6]
[terrain]
start = [0, 5]
angle = "38 deg"
drop = 4
transition_radius = 1
[release]
at = 0.5
length = 1.5
thickness = 0.6
velocity = [4, 0, -3]
[dense_flow]
support_radius = 0.3
[cover]
depth = 0.3
[suspension]
cell_size = 0.5
[coupling.drag]
[coupling.generation]
threshold_speed = 0
[coupling.adhesion]
[entrainment]
)";

}  // namespace spindrift::testing
