#pragma once
/// Every parameter of a run, in SI units and radians. A section that the scene file does not name is an empty optional,
/// or an empty list where there may be several of its kind: its physics does not exist. The values here are the preset
/// "physical"; names, units, ranges and docs of the keys stand in registry.cpp.

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spindrift {

struct ElevationGrid;

struct SceneSection {
  std::string name;  ///< of the run folder and the pictures; default: the file's stem
  int dim = 2;
  std::uint64_t seed = 1;
  std::string preset = "physical";  ///< "paper" | "physical"
  double end_time = 10;             ///< [s]
  double max_step = 0.01;           ///< [s], whatever else allows more
};

/// Lengths are vectors of `dim` numbers; the last axis points up.
struct DomainSection {
  std::vector<double> lower, upper;  ///< corners [m]
  std::vector<double> gravity;       ///< [m s^-2], default 9.81 downwards
  /// "open" | "closed" for each side; front and back exist in 3D only
  std::string left = "open", right = "open", bottom = "closed", top = "open", front = "closed", back = "closed";
};

/// Kinds of ground that are heights over a plane, in 3D only.
inline constexpr std::array<std::string_view, 8> field_shapes = {"plane", "parabola",   "bowl",   "helix",
                                                                 "ridge", "cliff_band", "valley", "grid"};

struct TerrainSection {
  std::string shape = "slope";                ///< "slope" | "bumps" | "cliff" | "polyline" | one of field_shapes
  std::array<double, 2> start{0, 0};          ///< upper left end of the slope (x, z) [m]
  double angle = 0.5934119456780721;          ///< of the slope [rad], default 34 deg
  double drop = 50;                           ///< height of the whole slope from start to its foot [m]
  double runout_angle = 0;                    ///< of the ground beyond the foot [rad]
  double transition_radius = 15;              ///< of the arc between slope and run-out, or floor and wall [m]
  double bump_height = 1;                     ///< crest to trough [m] (bumps)
  double bump_length = 15;                    ///< wavelength along the slope [m] (bumps)
  double cliff_at = 20;                       ///< drop from start at which the cliff begins [m] (cliff, cliff_band)
  double cliff_height = 20;                   ///< [m] (cliff, cliff_band)
  double cliff_angle = 1.2217304763960306;    ///< [rad], default 70 deg (cliff_band)
  double side_angle = 0;                      ///< by which it falls along y [rad] (plane)
  double bend_radius = 50;                    ///< of the channel's middle [m] (helix)
  double channel_depth = 5;                   ///< [m] (helix)
  double channel_width = 20;                  ///< between its edges [m] (helix)
  std::string ridge_runs = "across";          ///< "across" | "along" (ridge)
  double ridge_at = 40;                       ///< x of the crest from start on, of one that runs across [m] (ridge)
  double ridge_height = 5;                    ///< [m] (ridge)
  double ridge_width = 5;                     ///< from the crest to 0.61 of its height [m] (ridge)
  double floor_width = 20;                    ///< [m] (valley)
  double wall_angle = 0.7853981633974483;     ///< [rad], default 45 deg (valley)
  double cell_size = 1;                       ///< of the grid that a 3D shape is sampled on [m]
  std::vector<std::array<double, 2>> points;  ///< vertices (x, z) [m] (polyline)
  std::string file;                           ///< of the points, empty once they are read, or of the grid's heights
  std::string avaframe;                       ///< folder of an elevation model and its areas, empty once it is read

  bool is_field() const { return std::find(field_shapes.begin(), field_shapes.end(), shape) != field_shapes.end(); }
};

/// Something solid: an axis-aligned box, or ground that is raised.
struct ObstacleSection {
  std::string shape = "box";                  ///< "box" | "area": on a 3D ground
  std::vector<double> lower, upper;           ///< corners of the box [m]
  std::vector<std::array<double, 2>> points;  ///< corners (x, y) of the area [m]
  std::string file;                           ///< of the areas, empty once they are read
  double height = 5;                          ///< of the area above the ground [m]
};

/// Snow released at the start, on a lattice of the particle spacing.
struct ReleaseSection {
  std::string shape = "slab";                 ///< "slab", "area": on the ground or cover | "box" | "ball" | "polygon"
  double density = 0;                         ///< [kg m^-3]; 0: the dense flow's
  double at = 5;                              ///< arc length along the ground of the slab's upper end [m]
  double length = 5;                          ///< of the slab along the ground [m]
  double thickness = 2;                       ///< of slab or area, normal to the ground [m]
  int layers = 0;                             ///< of particles, in place of a thickness; 0 once it is told
  std::vector<double> lower, upper;           ///< corners of the box [m]
  std::vector<double> center;                 ///< of the ball [m]
  double radius = 1;                          ///< of the ball [m]
  std::vector<std::array<double, 2>> points;  ///< corners (x, z) of the polygon, (x, y) of the area [m]
  std::string file;                           ///< of the areas, empty once they are read
  std::vector<double> velocity;               ///< initial velocity [m s^-1], default 0
  double shear = 0;     ///< growth of the velocity along x with height over the snow's foot [s^-1]
  double rotation = 0;  ///< angular velocity about the snow's middle, from x to z [s^-1]
};

/// Smoke in the air: at the start, or given off as long as the run lasts.
struct SmokeSection {
  std::string shape = "box";                  ///< "box" | "ball" | "polygon"
  double density = 3;                         ///< rho_smoke at the start [kg m^-3]
  double rate = 0;                            ///< at which more is given off [kg m^-3 s^-1]
  std::vector<double> lower, upper;           ///< corners of the box [m]
  std::vector<double> center;                 ///< of the ball [m]
  double radius = 1;                          ///< of the ball [m]
  std::vector<std::array<double, 2>> points;  ///< corners (x, z) of the polygon [m]
};

struct DenseFlowSection {
  std::string solver = "dfsph";         ///< "dfsph" | "wcsph"
  std::string kernel = "cubic_spline";  ///< "cubic_spline" | "wendland"
  double support_radius = 0.21;         ///< h [m]
  double support_ratio = 2;             ///< h over the particle spacing
  double density = 300;                 ///< [kg m^-3]
  double viscosity = 0;                 ///< mu [Pa s]
  std::string wall = "slip";            ///< "slip" | "no_slip": of the viscous stress at walls
  double density_tolerance = 5e-4;      ///< mean compression allowed
  double divergence_tolerance = 1e-1;   ///< mean rate of compression allowed, in percent of the volume a step
  double relative_tolerance = 0.1;      ///< compression left over what the velocities alone would make; 0: off
  int max_iterations = 100;
  double cfl = 0.4;                            ///< of the spacing
  double sound_speed = 0;                      ///< [m s^-1] (wcsph); 0: ten times the largest speed expected
  double friction_mu = 0.155;                  ///< Coulomb coefficient
  double friction_xi = 4000;                   ///< Voellmy turbulent coefficient [m s^-2]; 0: no turbulent part
  std::string friction_acts_on = "column";     ///< "column" | "base" | "none"
  double compaction_time = 0.1;                ///< [s]; 0: off (R20)
  std::string neighbour_search = "cell_list";  ///< "cell_list" | "kd_tree"

  double spacing() const { return support_radius / support_ratio; }  ///< d of the particles [m]
};

struct CoverSection {
  double depth = 0.525;      ///< normal to the ground [m]
  double density = 100;      ///< rho_a [kg m^-3]
  double from = 0, to = -1;  ///< extent along the ground [m]; to < 0: its end
  /// Outlines (x, y) of where it lies on a 3D ground [m]; none: everywhere.
  std::vector<std::vector<std::array<double, 2>>> areas;
  std::string file;  ///< of the areas, empty once they are read
  int relaxation_steps = 40;
  bool sleeping = true;  ///< on a height field it is laid where something comes near
};

struct ConfinementSection {
  double strength = 0.15;  ///< epsilon of vorticity confinement
};

struct TilesSection {
  int margin = 1;             ///< [tiles]
  double still_speed = 0.1;   ///< [m s^-1]
  double clear_smoke = 1e-3;  ///< [kg m^-3]
};
struct SuspensionSection {
  double cell_size = 0.33;            ///< dx [m]
  double air_density = 1.2;           ///< [kg m^-3]
  std::string scheme = "maccormack";  ///< "semi_lagrangian" | "maccormack" | "reflection"
  double viscosity = 0;               ///< kinematic, of the air [m^2 s^-1]
  std::string wall = "slip";          ///< "slip" | "no_slip": of the viscous stress at closed sides
  std::vector<double> lid;            ///< velocity of the closed top [m s^-1] (no_slip), default 0
  double diffusivity = 0;             ///< of smoke [m^2 s^-1]
  double settling_speed = 0.5;        ///< of smoke [m s^-1]; 0: off (R19)
  double cfl = 1;                     ///< of the cell size
  double tolerance = 1e-3;            ///< relative residual of the pressure solve
  int max_iterations = 200;
  bool moving_core = true;            ///< R10; false: the paper's rule
  std::vector<double> wind;           ///< velocity of the air at the start and beyond open sides [m s^-1], default 0
  std::string initial_flow = "wind";  ///< "wind" | "vortices" | "rotation" | "potential": of the air at the start
  double initial_speed = 1;           ///< U of all but the wind [m s^-1]
  bool frozen = false;                ///< the air keeps the velocity that it began with
  std::optional<ConfinementSection> confinement;
  std::optional<TilesSection> tiles;
};

struct DragSection {
  double constant = 0.81;   ///< k_drag
  std::string law = "air";  ///< "air" | "paper" (R2)
};
struct LiftSection {
  double constant = 0.2;  ///< k_lift
  std::string law = "air";
};
struct GenerationSection {
  double constant = 0.02;      ///< C_g [kg m^-2 s^-1 (m/s)^-1.7]
  double threshold_speed = 5;  ///< [m s^-1]
};
struct AdhesionSection {
  double constant = 0.2;  ///< C_a
};
struct CouplingSection {
  double overlap_fraction = 0.8;         ///< beta: n_0 = beta n_interior (R1)
  double min_mass = 0.05, max_mass = 2;  ///< of a particle, in masses of a released one (R17)
  std::optional<DragSection> drag;
  std::optional<LiftSection> lift;
  std::optional<GenerationSection> generation;
  std::optional<AdhesionSection> adhesion;
};

struct EntrainmentSection {
  std::string rule = "clock";       ///< "clock" | "bernoulli"
  double rate = 10;                 ///< Er [kg m^-2 s^-1]
  double threshold_surface = 1e-6;  ///< gamma_0 at the cover's initial surface [s^-1]
  double threshold_base = 1e-4;     ///< gamma_0 at its base [s^-1]
  std::string column = "normal";    ///< "normal" | "vertical"
  bool spontaneous = false;
  double friction_strain = 1;   ///< factor on gamma_f = tau_f / eta; 0: off (R14)
  bool shared_traction = true;  ///< bed friction spares what brings entrained snow up to speed (R16)
};

/// The line along which the front is measured, on a 3D ground.
struct PathSection {
  std::vector<std::array<double, 2>> points;  ///< vertices (x, y), downhill [m]
  std::string file;                           ///< of the line, empty once it is read
};

/// An instrument that stands at one place.
struct PylonSection {
  std::string name;              ///< of its columns; default: "pylon1", "pylon2", ...
  std::vector<double> position;  ///< seen from above: (x) in 2D, (x, y) in 3D [m]
  double height = 1;             ///< over the ground, straight up [m]
};

struct OutputSection {
  double frames_per_second = 10;
  bool particles = true, smoke = true;
  bool rasters = true;     ///< in 3D over a terrain
  double raster_cell = 0;  ///< [m]; 0: the terrain's grid, over a profile two particle spacings
  bool preview = true;
  int preview_width = 1380;  ///< [px]
  /// density that hides 63 % of what is behind it in the pictures, in 3D behind a metre of it [kg m^-3]
  double opaque_smoke = 1;
};

struct Scene {
  SceneSection scene;
  DomainSection domain;
  std::optional<TerrainSection> terrain;
  std::vector<ObstacleSection> obstacle;
  std::vector<ReleaseSection> release;
  std::optional<DenseFlowSection> dense_flow;
  std::optional<CoverSection> cover;
  std::optional<SuspensionSection> suspension;
  std::vector<SmokeSection> smoke;
  std::optional<CouplingSection> coupling;
  std::optional<EntrainmentSection> entrainment;
  std::optional<PathSection> path;
  std::vector<PylonSection> pylon;
  OutputSection output;

  /// The heights of terrain.file, once they are read, in the coordinates of the file.
  std::shared_ptr<const ElevationGrid> elevation;
  /// Of all other places here, in the coordinates of the scene file [m]: not zero in the solver's scene alone.
  std::array<double, 3> origin{};
};

}  // namespace spindrift
