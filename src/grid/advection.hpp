#pragma once
/// Advection of the face velocities: semi-Lagrangian (Stam 1999) or MacCormack with clamping (Selle et al. 2008).

#include <array>
#include <span>
#include <vector>

#include "grid/ground.hpp"

namespace spindrift {

enum class AdvectionScheme { semi_lagrangian, maccormack };

/// Largest |u_k| in each row of the faces of each axis [m/s].
template <int Dim>
using RowSpeeds = std::array<std::vector<double>, Dim>;

/// Where one call of advect() takes place.
template <int Dim>
struct AdvectionFrame {
  const MacGrid<Dim>& grid;
  const std::array<std::vector<Span>, Dim>& rows;  ///< of each row of faces: only these are looked at, others are 0
  const FaceField<Dim>& carrier;  ///< velocity that carries [m/s], with sane values in the ground's layers
  const RowSpeeds<Dim>& carrier_speed;
  const FaceField<Dim>& flow_area;  ///< only faces with a positive one are advected, the others keep their value
};

template <int Dim>
class VelocityAdvection {
 public:
  explicit VelocityAdvection(const MacGrid<Dim>& grid);

  /// u(x) <- u(x - D(x)), the displacement D by the midpoint rule through the carrier:
  ///   D = dt c(x - dt/2 c(x))
  /// MacCormack, D' being the displacement forward:
  ///   u^ = u(x - D),   back = u^(x + D'),   u <- u^ + (u - back) / 2,
  /// clamped to the values that made u^ (those with a weight). Interpolation is (bi/tri)linear, constant beyond the
  /// domain; stable for any dt. Rows where nothing moves more than a cell (|c| dt <= dx, also in the rows next to them)
  /// read their neighbours in order, with weights instead of look-ups: the same interpolation, several times faster.
  /// u   in-out: [m/s]
  /// dt  [s]
  /// Source: paper Sec. 3.1 (stable fluids).
  void advect(FaceField<Dim>& u, const AdvectionFrame<Dim>& frame, double dt, AdvectionScheme scheme);

  /// Forgets what lies deep in the ground, see Ground::clear_deep.
  void clear_deep(const Ground<Dim>& ground, int begin, int end);
  /// Calls f(field) for each of its own fields of velocity, which must be 0 where frames look no more.
  template <class F>
  void for_each_buffer(F&& f) {
    f(forward_), f(result_);
  }

  std::size_t bytes() const;

 private:
  enum class Pass { forward, correct };
  void sweep(FaceField<Dim>& out, const FaceField<Dim>& u, const AdvectionFrame<Dim>& frame, double dt,
             Pass pass) const;

  FaceField<Dim> forward_, result_;
};

}  // namespace spindrift
