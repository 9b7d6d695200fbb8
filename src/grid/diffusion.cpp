#include "grid/diffusion.hpp"

#include "core/parallel.hpp"
#include "grid/pack.hpp"

namespace spindrift {
namespace {

/// The arrays of a line of points: w x' = w x + link_next (x_next' - x') - link_last (x' - x_last') + hold (held - x'),
/// x' = x where fixed.
struct Lines {
  double *x, *ratio;
  const double *weight, *fixed, *link, *hold, *held;
};

/// Gaussian elimination along one line (or a pack of lines side by side) of n points, `stride` apart. The sum of w x
/// over lines with nothing fixed or held is kept: round-off of the elimination must not add up over thousands of steps.
template <class T>
void solve_line(const Lines& lines, std::ptrdiff_t stride, int n) {
  T link_last{}, x_last{}, ratio_last{}, sum{}, n_fixed{};
  for (int i = 0; i < n; ++i) {
    const std::ptrdiff_t at = i * stride;
    const T w = load<T>(lines.weight + at), x = load<T>(lines.x + at), link = load<T>(lines.link + at);
    const T fixed = load<T>(lines.fixed + at);
    const T hold = fixed > 0 ? T{} : load<T>(lines.hold + at);
    const T below = fixed > 0 ? T{} : link_last, above = fixed > 0 ? T{} : link;
    const T diagonal = w + above + hold + below * (1 - ratio_last);
    x_last = (w * x + hold * load<T>(lines.held + at) + below * x_last) / diagonal;
    ratio_last = above / diagonal;
    store<T>(lines.x + at, x_last);
    store<T>(lines.ratio + at, ratio_last);
    link_last = link;
    sum += w * x;
    n_fixed += fixed + hold;
  }
  T next{}, solved{}, size{};
  for (int i = n - 1; i >= 0; --i) {
    const std::ptrdiff_t at = i * stride;
    next = load<T>(lines.x + at) + load<T>(lines.ratio + at) * next;
    store<T>(lines.x + at, next);
    solved += load<T>(lines.weight + at) * next;
    size += load<T>(lines.weight + at) * magnitude(next);
  }
  // In proportion to |x|: positive values stay positive, and a sum that is next to nothing does no harm.
  const T correction = n_fixed > 0 || size <= 0 ? T{} : (sum - solved) / (size > 0 ? size : T{} + 1);
  for (int i = 0; i < n; ++i) {
    const T x = load<T>(lines.x + i * stride);
    store<T>(lines.x + i * stride, x + correction * magnitude(x));
  }
}

}  // namespace

template <int Dim>
void Diffusion<Dim>::resize(std::size_t n) {
  for (auto* array : {&x_, &weight_, &link_, &ratio_, &fixed_, &hold_, &held_}) array->resize(n);
}

template <int Dim>
void Diffusion<Dim>::solve_lines(std::vector<double>& x, const Index<Dim>& shape, int axis) {
  std::ptrdiff_t stride = 1;
  for (int k = 0; k < axis; ++k) stride *= shape[k];
  const auto lines_at = [&](std::size_t n) {
    return Lines{&x[n], &ratio_[n], &weight_[n], &fixed_[n], &link_[n], &hold_[n], &held_[n]};
  };
  Index<Dim> starts = shape;
  starts[axis] = 1;
  if (axis == 0) {
    parallel_for(
        count<Dim>(starts),
        [&](std::size_t r) { solve_line<double>(lines_at(r * static_cast<std::size_t>(shape[0])), 1, shape[0]); }, 16);
    return;
  }
  constexpr int wide = 64;
  starts[0] = (shape[0] + wide - 1) / wide;
  parallel_for(
      count<Dim>(starts),
      [&](std::size_t chunk) {
        Index<Dim> start = unflat<Dim>(chunk, starts);
        start[0] *= wide;
        const std::size_t first = flat<Dim>(start, shape);
        for_each_pack(0, std::min(wide, shape[0] - start[0]), [&]<class T>(int i) {
          solve_line<T>(lines_at(first + static_cast<std::size_t>(i)), stride, shape[axis]);
        });
      },
      1);
}

/// Links of the outermost points to no-slip sides, half a cell away: four times as strong as half a link.
template <int Dim>
void Diffusion<Dim>::hold_at_sides(const ViscousSides<Dim>& sides, const Index<Dim>& shape, int component, int axis,
                                   double spread) {
  std::fill(hold_.begin(), hold_.end(), 0.0);
  if (!sides.no_slip || component == axis) return;
  for (std::size_t end = 0; end < 2; ++end) {
    if (sides.sides[static_cast<std::size_t>(axis)][end] != Side::closed) continue;
    const bool lid = axis == up_axis<Dim> && end == 1;
    Index<Dim> rim = shape;
    rim[axis] = 1;
    for_each_index<Dim>(rim, [&](Index<Dim> i) {
      if (end == 1) i[axis] = shape[axis] - 1;
      const std::size_t n = flat<Dim>(i, shape);
      hold_[n] += 4 * spread * weight_[n];
      held_[n] = lid ? sides.lid[component] : 0;
    });
  }
}

template <int Dim>
void Diffusion<Dim>::diffuse_velocity(FaceField<Dim>& u, const Field<Dim>& smoke, const FaceField<Dim>& flow_area,
                                      const MacGrid<Dim>& grid, const Ground<Dim>& ground,
                                      const ViscousSides<Dim>& sides, double viscosity, double dt) {
  const double spread = 0.5 * viscosity * dt / (grid.dx * grid.dx);
  for (int component = 0; component < Dim; ++component) {
    const Index<Dim> shape = grid.faces(component);
    const auto& air = ground.air_mass()[component];
    resize(air.size());
    std::size_t n = 0;
    for_each_index<Dim>(shape, [&](const Index<Dim>& i) {
      x_[n] = u[component][n];
      fixed_[n] = flow_area[component][n] > 0 ? 0 : 1;
      weight_[n] = air[n] > 0 ? air[n] + smoke_of_face<Dim>(smoke, component, i) : 1;
      ++n;
    });
    for (int axis = 0; axis < Dim; ++axis) {
      const auto stride = static_cast<std::size_t>(air.stride(axis));
      n = 0;
      for_each_index<Dim>(shape, [&](const Index<Dim>& i) {
        const bool joined = i[axis] + 1 < shape[axis] && air[n] > 0 && air[n + stride] > 0;
        // A face on a side has half a cell of mass, while the cell that it shares with the next face is a whole one.
        const double of_low = component == axis && i[axis] == 0 ? 2 : 1;
        const double of_high = component == axis && i[axis] + 2 == shape[axis] ? 2 : 1;
        link_[n] = joined ? spread * (of_low * weight_[n] + of_high * weight_[n + stride]) : 0;
        ++n;
      });
      hold_at_sides(sides, shape, component, axis, spread);
      solve_lines(x_, shape, axis);
    }
    std::copy_n(x_.begin(), u[component].size(), u[component].values().begin());
  }
}

template <int Dim>
void Diffusion<Dim>::diffuse_smoke(Field<Dim>& smoke, const FaceField<Dim>& flow_area, const MacGrid<Dim>& grid,
                                   const Ground<Dim>& ground, double diffusivity, double dt) {
  const auto& volume = ground.volume();
  resize(smoke.size());
  for (std::size_t n = 0; n < smoke.size(); ++n) {
    weight_[n] = volume[n] > 0 ? volume[n] : 1;
    x_[n] = smoke[n] / weight_[n];
    fixed_[n] = hold_[n] = 0;
  }
  for (int axis = 0; axis < Dim; ++axis) {
    std::size_t n = 0;
    for_each_index<Dim>(grid.cells, [&](const Index<Dim>& i) {
      const bool last = i[axis] + 1 == grid.cells[axis];
      link_[n++] = last ? 0 : diffusivity * dt / grid.dx * flow_area[axis][shifted<Dim>(i, axis, 1)];
    });
    solve_lines(x_, grid.cells, axis);
  }
  for (std::size_t n = 0; n < smoke.size(); ++n) smoke[n] = x_[n] * weight_[n];
}

template class Diffusion<2>;
template class Diffusion<3>;

}  // namespace spindrift
