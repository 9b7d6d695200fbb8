#pragma once
/// The flux of a conserved scalar through a face.

#include "grid/pack.hpp"

namespace spindrift {

/// [kg] Less does not pass: it would make numbers too small for full precision, and spread a cloud over the whole grid.
inline constexpr double smallest_flux = 1e-30;
inline constexpr double smallest_divisor = 1e-300;  ///< keeps 0 / 0 away in lanes that do not count

/// Mass that passes a face with the volume `flow` from the left cell l to the right one r (or back, if negative); ll
/// and rr are the cells beyond. The face's density is third order in space and time,
///   rho_donor + (1 - c) [(2 - c) (rho_other - rho_donor) + (1 + c) (rho_donor - rho_behind)] / 6,   c = flow / volume,
/// limited to lie between donor and other, and so that what stays in the donor is no thinner than the cell behind it:
/// monotone, and never more than the donor holds.   Source: Leonard 1991 (ULTIMATE QUICKEST).
/// density, volume: of the cells; room: volume that stays in the donor when the cell is one.
template <class T>
T limited_flux(T flow, T density_ll, T density_l, T density_r, T density_rr, T volume_l, T volume_r, T room_l,
               T room_r) {
  const T donor = flow > 0 ? density_l : density_r, other = flow > 0 ? density_r : density_l;
  const T behind = flow > 0 ? density_ll : density_rr;
  const T size = magnitude(flow), room = flow > 0 ? room_l : room_r;
  const T c = size / ((flow > 0 ? volume_l : volume_r) + smallest_divisor);
  const T ahead = other - donor, back = donor - behind;
  const T ahead_size = magnitude(ahead), back_size = magnitude(back);
  const T smooth = size * (1 - c) * ((2 - c) * ahead_size + (1 + c) * back_size) * (1.0 / 6);
  const T excess = larger(smaller(smaller(size * ahead_size, smooth), 0.999 * room * back_size), T{});
  const T correction = ahead * back > 0 ? excess : T{};
  const T sum = size * donor + (ahead > 0 ? correction : -correction), mass = sum > smallest_flux ? sum : T{};
  return flow > 0 ? mass : -mass;
}

}  // namespace spindrift
