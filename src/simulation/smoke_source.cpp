#include "simulation/smoke_source.hpp"

#include "grid/face_mass.hpp"

namespace spindrift {

template <int Dim>
SmokeSource<Dim>::SmokeSource(const Field<Dim>& rate) {
  for (std::size_t cell = 0; cell < rate.size(); ++cell) {
    if (rate[cell] > 0) rate_.smoke.push_back({cell, rate[cell]});
    total_rate_ += rate[cell];
  }
  for (int axis = 0; axis < Dim; ++axis) {
    const Index<Dim> faces = shifted<Dim>(rate.shape(), axis, 1);
    for_each_index<Dim>(faces, [&](const Index<Dim>& face) {
      const double share = smoke_of_face<Dim>(rate, axis, face);
      if (share > 0) rate_.momentum[static_cast<std::size_t>(axis)].push_back({flat<Dim>(face, faces), share});
    });
  }
  now_ = rate_;
}

template <int Dim>
const GridSources<Dim>& SmokeSource<Dim>::over(double dt, const Suspension<Dim>& air) {
  for (std::size_t i = 0; i < rate_.smoke.size(); ++i) now_.smoke[i].amount = dt * rate_.smoke[i].amount;
  for (std::size_t axis = 0; axis < Dim; ++axis)
    for (std::size_t i = 0; i < rate_.momentum[axis].size(); ++i) {
      const auto& [face, rate] = rate_.momentum[axis][i];
      now_.momentum[axis][i].amount = dt * rate * air.velocity()[axis][face];
    }
  return now_;
}

template <int Dim>
std::size_t SmokeSource<Dim>::bytes() const {
  std::size_t n = spindrift::bytes(rate_.smoke, now_.smoke);
  for (std::size_t axis = 0; axis < Dim; ++axis) n += spindrift::bytes(rate_.momentum[axis], now_.momentum[axis]);
  return n;
}

template class SmokeSource<2>;
template class SmokeSource<3>;

}  // namespace spindrift
