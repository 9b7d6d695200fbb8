#pragma once
/// The suspension layer: air and snow smoke on the MAC grid, paper Secs. 3.1 and 4.2, with the sources of
/// Sec. 4.4.1.
///
/// One step is: add_gravity, apply (the exchange's sources), advance. Between steps the velocity is divergence-free.

#include <limits>
#include <optional>
#include <span>

#include "core/stages.hpp"
#include "grid/advection.hpp"
#include "grid/confinement.hpp"
#include "grid/core_boundary.hpp"
#include "grid/diffusion.hpp"
#include "grid/grid_sources.hpp"
#include "grid/ground.hpp"
#include "grid/inflow.hpp"
#include "grid/pressure_projection.hpp"
#include "grid/smoke_transport.hpp"
#include "grid/still_tiles.hpp"

namespace spindrift {

template <int Dim>
struct SuspensionOptions {
  Vec<Dim> gravity = -9.81 * up<Dim>();                  ///< [m s^-2]
  double air_density = 1.2;                              ///< [kg m^-3]
  AdvectionScheme scheme = AdvectionScheme::maccormack;  ///< of the velocity
  bool reflection = false;            ///< two projections a step, about the middle of it: second order in time
  double viscosity = 0;               ///< kinematic, of the air [m^2 s^-1]
  bool no_slip = false;               ///< closed sides hold the air by its viscosity
  Vec<Dim> lid = Vec<Dim>::Zero();    ///< velocity of a closed top that holds it [m s^-1]
  double diffusivity = 0;             ///< of the smoke [m^2 s^-1]
  double settling_speed = 0;          ///< of the smoke relative to the air, along gravity [m s^-1] (R19)
  Vec<Dim> wind = Vec<Dim>::Zero();   ///< velocity of the air that open sides let in [m s^-1]
  std::optional<double> confinement;  ///< epsilon of vorticity confinement
  ProjectionOptions pressure;
  bool moving_core = true;  ///< R10; false: the paper's rule, normal velocity 0
  bool frozen = false;      ///< the velocity stays what set_velocity() made it: something outside holds the air
};

/// What advance() did. The momentum entries [kg m s^-1] are changes of Suspension::momentum(); their sum is its change
/// over the call.
template <int Dim>
struct SuspensionBudget {
  Vec<Dim> core = Vec<Dim>::Zero();       ///< faces set to the core's velocity, smoke pushed out of the core
  Vec<Dim> advection = Vec<Dim>::Zero();  ///< of the velocity
  Vec<Dim> smoke = Vec<Dim>::Zero();      ///< smoke that moved to cells of another velocity, left or was deposited
  Vec<Dim> diffusion = Vec<Dim>::Zero();
  Vec<Dim> confinement = Vec<Dim>::Zero();
  Vec<Dim> projection = Vec<Dim>::Zero();
  Vec<Dim> core_pressure = Vec<Dim>::Zero();  ///< impulse of the pressure on the core; not a change of the grid's, but
                                              ///< projection + core_pressure = impulse of sides and ground on the air
  double outflow = 0;                         ///< smoke that left through open sides [kg]
  double deposited = 0;                       ///< smoke that settled on the ground [kg]
  int smoke_substeps = 0;
  ProjectionResult pressure;
};

/// What steers the steps to come, beside the ground; the rest of Suspension derives from both, or is scratch.
template <int Dim>
struct SuspensionState {
  MacGrid<Dim> grid;
  FaceField<Dim> velocity;
  FaceField<Dim> carrier;        ///< not the velocity where sources have changed that since the last advance()
  RowSpeeds<Dim> carrier_speed;  ///< of before the ground sank
  Field<Dim> smoke;
  Field<Dim, CellKind> kind;
  std::vector<double> pressure;  ///< PressureProjection::guess()
  std::optional<Vec<Dim>> momentum;
  StillTiles<Dim> still;
  bool disturbed = false, kinds_are_old = false;

  std::size_t bytes() const;
};

template <int Dim>
class Suspension {
 public:
  using Sides = std::array<std::array<Side, 2>, Dim>;

  Suspension(const MacGrid<Dim>& grid, const Sides& sides, const SuspensionOptions<Dim>& options);

  const MacGrid<Dim>& grid() const { return grid_; }
  const SuspensionOptions<Dim>& options() const { return options_; }

  // State, for output and checkpoints. Everything else is derived or scratch.
  const FaceField<Dim>& velocity() const { return velocity_; }    ///< u on faces [m/s]
  const Field<Dim>& smoke_mass() const { return smoke_; }         ///< in each cell [kg], >= 0 (R7)
  const Field<Dim, CellKind>& kind() const { return kind_; }      ///< of the last step
  Field<Dim> pressure() const { return projection_.pressure(); }  ///< of the last step's projection [Pa]

  /// Initial conditions and restart, between steps. The velocity should be divergence-free; values on closed faces are
  /// kept as they are, so a stored state comes back to the bit.
  void set_velocity(const FaceField<Dim>& u);
  void set_smoke_mass(const Field<Dim>& smoke);
  void set_kind(const Field<Dim, CellKind>& kind);
  void set_pressure(const Field<Dim>& pressure) { projection_.set_pressure(pressure); }

  /// Copies the state out, into buffers that it reuses, and back. At restore() the ground must be that of save(); the
  /// steps from there on have the same bits, whatever came between.
  void save(SuspensionState<Dim>& state) const;
  void restore(const SuspensionState<Dim>& state);

  /// The bed's surface: signed distance at nodes [m], positive in the air.  Throws Error(bad_input): not finite.
  /// columns: only cells of these (along the first axis, apart from each other, ascending) have changed; the result is
  /// the same to the bit. Returns the change of momentum() [kg m s^-1].
  void set_ground(const Field<Dim>& node_distance);
  Vec<Dim> set_ground(const Field<Dim>& node_distance, std::span<const Span> columns);
  const Ground<Dim>& ground() const { return ground_; }

  /// What goes with air that is not computed any more.
  struct Forgotten {
    Vec<Dim> momentum = Vec<Dim>::Zero();  ///< change of momentum() [kg m s^-1]
    double smoke = 0;                      ///< [kg]
  };
  /// Makes the grid another window of the same whole one: cells of both keep their state, new ones hold still air.
  /// Between steps.   sides: of the window;   node_distance: as of set_ground(); empty: no ground
  Forgotten move_window(const MacGrid<Dim>& window, const Sides& sides, const Field<Dim>& node_distance);
  /// Chooses the cells whose air is not computed: it comes to rest, loses its smoke, and has pressure 0.
  /// Pre: no wind, sizes of the tiles as of this grid.
  Forgotten set_still(const StillTiles<Dim>& still);
  const StillTiles<Dim>& still() const { return still_; }
  const Sides& sides() const { return sides_; }

  /// Faces that the exchange may use, 1 or 0: open, between two open cells or at an open side.
  const FaceField<Dim, unsigned char>& active_faces() const { return active_; }

  /// Air and smoke of a face's control volume [kg]: half of each neighbour cell's; 0 on closed faces.
  double face_mass(int axis, std::size_t face) const;
  /// rho_smoke of a cell [kg m^-3] over its open volume, floored as in Ground.
  double smoke_density(std::size_t cell) const;
  /// sum over faces of face_mass u [kg m s^-1].
  Vec<Dim> momentum() const { return momentum({0, std::numeric_limits<int>::max()}); }
  double total_smoke() const;  ///< [kg]
  double max_speed() const;    ///< largest face velocity at the last step's end [m/s]; NaN: not finite

  /// One term (R8): du = dt r_s g on active faces, r_s = rho_smoke / (rho_air + rho_smoke), Eqs. (7)-(9).
  /// Returns the change of momentum() [kg m s^-1]; frozen air does not change.
  Vec<Dim> add_gravity(double dt);

  /// u' = (m_f u + J_f) / m_f' on listed active faces, smoke' = smoke + source. Listed faces that are not active, and
  /// all of frozen air, take no momentum. Returns the change of momentum() [kg m s^-1]: the sum of the J_f where all
  /// faces of a cell with a source are active and listed.
  Vec<Dim> apply(const GridSources<Dim>& sources);

  /// The rest of the step, paper Sec. 4.2: kinds of cells, core boundary (R10), advection, smoke transport (R7),
  /// diffusion and confinement where present, projection (R9). In frozen air the smoke's transport alone, cores or not.
  /// cores  in-out: in order of `cell`, no cell twice, mass > 0; their outputs are set
  /// Throws Error(unstable): the step starts from a velocity that is not finite.
  void advance(double dt, std::span<CoreCell<Dim>> cores, Stages& stages);

  const SuspensionBudget<Dim>& budget() const { return budget_; }
  std::size_t bytes() const;

 private:
  Vec<Dim> momentum(Span columns) const;
  bool at_rest(std::span<const CoreCell<Dim>> cores) const;
  void classify(std::span<CoreCell<Dim>> cores);
  void update_active(int begin, int end);
  void update_rows();
  void move_smoke(double dt, Stages& stages);
  void carry_velocity(double dt, Stages& stages);
  void project(double dt, double weight, std::span<CoreCell<Dim>> cores, Stages& stages);
  void start_from_velocity();
  void find_carrier_speeds();
  void find_carrier_speed(std::size_t axis, std::size_t row);
  Span moving_faces(std::size_t axis, std::size_t row) const;
  void reflect(std::span<CoreCell<Dim>> cores, double dt, Stages& stages);
  void set_density();

  MacGrid<Dim> grid_;
  Sides sides_;
  SuspensionOptions<Dim> options_;

  FaceField<Dim> velocity_;
  Field<Dim> smoke_;
  Field<Dim, CellKind> kind_, last_kind_;
  PressureProjection<Dim> projection_;

  Ground<Dim> ground_;
  StillTiles<Dim> still_;
  std::array<std::vector<Span>, Dim> rows_;  ///< of each row of faces: those of Ground::rows() that are not still
  FaceField<Dim, unsigned char> active_;
  FaceField<Dim> flow_area_;    ///< open area of active faces [m^(Dim-1)], 0 of the others
  FaceField<Dim> carrier_;      ///< divergence-free velocity of the step's start or middle, which carries air and smoke
  FaceField<Dim> unprojected_;  ///< scratch of reflect(); empty without it
  RowSpeeds<Dim> carrier_speed_;
  bool disturbed_ = false;            ///< gravity or sources have changed the velocity since the last advance()
  std::optional<Vec<Dim>> momentum_;  ///< momentum() where the entries since the last step tell it
  bool kinds_are_old_ = false;        ///< ground or kinds have been set since they were derived

  VelocityAdvection<Dim> advection_;
  SmokeTransport<Dim> smoke_transport_;
  Diffusion<Dim> diffusion_;
  Confinement<Dim> confinement_;
  CoreBoundary<Dim> core_boundary_;
  Components<Dim> components_;
  Field<Dim> density_;                 ///< air and smoke [kg m^-3], scratch of the projection
  std::vector<double> face_momentum_;  ///< scratch of apply()
  std::vector<Span> smoke_span_;       ///< of each row of cells, scratch
  std::vector<Span> dense_span_;       ///< where density_ is not the air's
  SuspensionBudget<Dim> budget_;
};

}  // namespace spindrift
