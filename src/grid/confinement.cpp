#include "grid/confinement.hpp"

#include "core/parallel.hpp"

namespace spindrift {
namespace {

/// Air that turns slower than this is left alone [s^-1]: far from the cloud it is the pressure solver's rounding.
constexpr double quiet_vorticity = 0.01;

/// Calls f(flat number, index) for the cells that have neighbours on all sides, in the rows for which wanted(row).
template <int Dim, class Wanted, class F>
void for_each_inner_cell(const Field<Dim>& field, Wanted&& wanted, F&& f) {
  const Index<Dim> shape = field.shape();
  parallel_for(
      field.n_rows(),
      [&](std::size_t r) {
        if (!wanted(r)) return;
        Index<Dim> i = field.row_start(r);
        for (std::size_t k = 1; k < Dim; ++k)
          if (i[k] == 0 || i[k] + 1 == shape[k]) return;
        for (i[0] = 1; i[0] + 1 < shape[0]; ++i[0])
          f(r * static_cast<std::size_t>(shape[0]) + static_cast<std::size_t>(i[0]), i);
      },
      field.rows_per_task());
}

}  // namespace

template <int Dim>
void Confinement<Dim>::apply(FaceField<Dim>& u, const FaceField<Dim>& flow_area, const MacGrid<Dim>& grid,
                             double strength, double dt) {
  if (size_.size() == 0) {
    size_ = inner_ = Field<Dim>(grid.cells);
    centre_.fill(size_);
    curl_.fill(size_);
  }
  std::array<std::size_t, Dim> stride;
  for (int k = 0; k < Dim; ++k) stride[static_cast<std::size_t>(k)] = static_cast<std::size_t>(size_.stride(k));
  parallel_for(
      size_.n_rows(),
      [&](std::size_t r) {
        const Index<Dim> start = size_.row_start(r);
        const auto n = static_cast<std::size_t>(grid.cells[0]);
        double* inner = inner_.row(r).data();
        std::fill(inner, inner + n, 1.0);
        for (std::size_t k = 0; k < Dim; ++k) {
          const double *low = &u[k][start], *area = &flow_area[k][start];
          double* centre = centre_[k].row(r).data();
          const auto next = static_cast<std::size_t>(u[k].stride(static_cast<int>(k)));
          for (std::size_t i = 0; i < n; ++i) {
            centre[i] = 0.5 * (low[i] + low[i + next]);
            inner[i] = area[i] > 0 && area[i + next] > 0 ? inner[i] : 0;
          }
        }
      },
      size_.rows_per_task());
  const double half = 0.5 / grid.dx;
  turning_.assign(size_.n_rows(), 0);
  const std::size_t row_length = static_cast<std::size_t>(grid.cells[0]);
  const auto every = [](std::size_t) { return true; };
  for_each_inner_cell<Dim>(size_, every, [&](std::size_t n, const Index<Dim>&) {
    const auto d = [&](std::size_t component, std::size_t axis) {
      return half * (centre_[component][n + stride[axis]] - centre_[component][n - stride[axis]]);
    };
    if constexpr (Dim == 2) {
      curl_[0][n] = d(0, 1) - d(1, 0);
      size_[n] = std::abs(curl_[0][n]);
    } else {
      curl_[0][n] = d(2, 1) - d(1, 2);
      curl_[1][n] = d(0, 2) - d(2, 0);
      curl_[2][n] = d(1, 0) - d(0, 1);
      size_[n] = std::hypot(curl_[0][n], curl_[1][n], curl_[2][n]);
    }
    if (size_[n] > quiet_vorticity) turning_[n / row_length] = 1;
  });
  // A face takes half of the force of each cell beside it: rows beside one whose air turns have a share in it.
  const auto turns = [&](std::size_t r) { return turning_[r] != 0; };
  const auto turns_below = [&](std::size_t r) {
    bool any = turns(r);
    for (std::size_t k = 1; k < Dim; ++k)
      any = any || (r * row_length >= stride[k] && turns(r - stride[k] / row_length));
    return any;
  };
  const auto turns_near = [&](std::size_t r) {
    bool any = turns_below(r);
    for (std::size_t k = 1; k < Dim; ++k) {
      const std::size_t above = r + stride[k] / row_length;
      any = any || (above < turning_.size() && turns(above));
    }
    return any;
  };
  parallel_for(
      size_.n_rows(),
      [&](std::size_t r) {
        if (!turns_near(r)) return;
        for (auto& force : centre_) std::fill(force.row(r).begin(), force.row(r).end(), 0.0);
      },
      size_.rows_per_task());
  for_each_inner_cell<Dim>(size_, turns, [&](std::size_t n, const Index<Dim>&) {
    if (!(size_[n] > quiet_vorticity)) return;
    Vec<Dim> gradient;
    bool inner = inner_[n] > 0;
    for (std::size_t k = 0; k < Dim; ++k) {
      inner = inner && inner_[n + stride[k]] > 0 && inner_[n - stride[k]] > 0;
      gradient[static_cast<int>(k)] = half * (size_[n + stride[k]] - size_[n - stride[k]]);
    }
    const double steepness = gradient.norm();
    if (!inner || !(steepness > 0)) return;
    Curl<Dim> omega;
    for (std::size_t k = 0; k < n_curl<Dim>; ++k) omega[static_cast<int>(k)] = curl_[k][n];
    const Vec<Dim> force = strength * grid.dx * cross<Dim>(Vec<Dim>(gradient / steepness), omega);
    for (std::size_t k = 0; k < Dim; ++k) centre_[k][n] = force[static_cast<int>(k)];
  });
  for (std::size_t k = 0; k < Dim; ++k) {
    for_each_inner_cell<Dim>(size_, turns_below, [&](std::size_t n, const Index<Dim>& i) {
      if (flow_area[k][i] > 0) u[k][i] += dt * 0.5 * (centre_[k][n] + centre_[k][n - stride[k]]);
    });
  }
}

template <int Dim>
std::size_t Confinement<Dim>::bytes() const {
  std::size_t n = size_.bytes() + inner_.bytes() + spindrift::bytes(turning_);
  for (const auto& f : centre_) n += f.bytes();
  for (const auto& f : curl_) n += f.bytes();
  return n;
}

template class Confinement<2>;
template class Confinement<3>;

}  // namespace spindrift
