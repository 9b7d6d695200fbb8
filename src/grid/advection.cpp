#include "grid/advection.hpp"

#include "core/parallel.hpp"
#include "grid/pack.hpp"

namespace spindrift {
namespace {

/// Reads around a face of axis `Axis` with contiguous loads, T at a time. Displacements are in cells.
template <int Dim, int Axis, class T>
struct Near {
  using Strides = std::array<std::ptrdiff_t, Dim>;

  /// Linear interpolation at displacement d, |d_k| <= 1, of a field on the face's own lattice.
  template <int K = Dim - 1>
  static T interpolate(const double* p, const Strides& s, const std::array<T, Dim>& d) {
    if constexpr (K < 0) {
      return load<T>(p);
    } else {
      const T up = larger(d[K], T{}), down = larger(-d[K], T{});
      return down * interpolate<K - 1>(p - s[K], s, d) + (1 - up - down) * interpolate<K - 1>(p, s, d) +
             up * interpolate<K - 1>(p + s[K], s, d);
    }
  }

  /// The same of the velocity component `Other`, |d_k| <= 1/2; p at the index of the face.
  template <int Other, int K = Dim - 1>
  static T across(const double* p, const Strides& s, const std::array<T, Dim>& d) {
    if constexpr (K < 0) {
      return load<T>(p);
    } else if constexpr (K == Axis) {
      return (0.5 - d[K]) * across<Other, K - 1>(p - s[K], s, d) + (0.5 + d[K]) * across<Other, K - 1>(p, s, d);
    } else if constexpr (K == Other) {
      return (0.5 - d[K]) * across<Other, K - 1>(p, s, d) + (0.5 + d[K]) * across<Other, K - 1>(p + s[K], s, d);
    } else {
      const T up = larger(d[K], T{}), down = larger(-d[K], T{});
      return down * across<Other, K - 1>(p - s[K], s, d) + (1 - up - down) * across<Other, K - 1>(p, s, d) +
             up * across<Other, K - 1>(p + s[K], s, d);
    }
  }

  /// across() at d = 0.
  template <int Other>
  static T mean(const double* p, const Strides& s) {
    return 0.25 * ((load<T>(p) + load<T>(p - s[Axis])) + (load<T>(p + s[Other]) + load<T>(p + s[Other] - s[Axis])));
  }

  struct Range {
    T low, high;
  };
  /// Least and largest of the values that interpolate() weights at d.
  template <int K = Dim - 1>
  static Range range(const double* p, const Strides& s, const std::array<T, Dim>& d) {
    if constexpr (K < 0) {
      const T x = load<T>(p);
      return {x, x};
    } else {
      const Range here = range<K - 1>(p, s, d), below = range<K - 1>(p - s[K], s, d),
                  above = range<K - 1>(p + s[K], s, d);
      return {smaller(here.low, d[K] < 0 ? below.low : above.low), larger(here.high, d[K] < 0 ? below.high : above.high)};
    }
  }

  /// -D: displacement to where the air comes from, in cells; step = dt / dx (negative: where it goes to).
  static std::array<T, Dim> origin(const std::array<const double*, Dim>& p,
                                   const std::array<Strides, Dim>& s, double step) {
    std::array<T, Dim> half, whole;
    component<0>([&]<int K>() {
      if constexpr (K == Axis) {
        half[K] = -0.5 * step * load<T>(p[K]);
      } else {
        half[K] = -0.5 * step * mean<K>(p[K], s[K]);
      }
    });
    component<0>([&]<int K>() {
      if constexpr (K == Axis) {
        whole[K] = -step * interpolate(p[K], s[K], half);
      } else {
        whole[K] = -step * across<K>(p[K], s[K], half);
      }
    });
    return whole;
  }

 private:
  template <int K, class F>
  static void component(F&& f) {
    if constexpr (K < Dim) {
      f.template operator()<K>();
      component<K + 1>(f);
    }
  }
};

/// One row of faces of axis Axis; everything a face needs is on hand.
template <int Dim, int Axis>
struct Row {
  const AdvectionFrame<Dim>& frame;
  const FaceField<Dim>& u;
  const FaceField<Dim>& forward;  ///< u^ of the correcting pass
  double dt;
  bool correct;

  /// With look-ups: for any displacement, and at the border.
  double far(const Index<Dim>& i) const {
    const MacGrid<Dim>& grid = frame.grid;
    const Vec<Dim> x = grid.face_centre(Axis, i);
    const auto displaced = [&](double time) {
      const Vec<Dim> middle = x - 0.5 * time * velocity_at<Dim>(grid, frame.carrier, x);
      return Vec<Dim>(x - time * velocity_at<Dim>(grid, frame.carrier, middle));
    };
    const Stencil<Dim> from = face_stencil<Dim>(grid, Axis, displaced(dt));
    if (!correct) return from.gather(u[Axis]);
    double low = u[Axis][from.point[0]], high = low;
    for (const std::size_t point : from.point) {
      low = std::min(low, u[Axis][point]);
      high = std::max(high, u[Axis][point]);
    }
    const double back = face_stencil<Dim>(grid, Axis, displaced(-dt)).gather(forward[Axis]);
    return std::clamp(forward[Axis][i] + 0.5 * (u[Axis][i] - back), low, high);
  }

  void near(double* out, const Index<Dim>& start, int begin, int end) const {
    using Strides = std::array<std::ptrdiff_t, Dim>;
    std::array<const double*, Dim> carrier;
    std::array<Strides, Dim> strides;
    for (std::size_t k = 0; k < Dim; ++k) {
      carrier[k] = &frame.carrier[k][start];
      for (int l = 0; l < Dim; ++l) strides[k][static_cast<std::size_t>(l)] = frame.carrier[k].stride(l);
    }
    const double* own = &u[Axis][start];
    const double* ahead = &forward[Axis][start];
    const double* area = &frame.flow_area[Axis][start];
    const double step = dt / frame.grid.dx;
    const Strides own_strides = strides[Axis];
    const auto at = [](std::array<const double*, Dim> p, int i) {
      for (auto& q : p) q += i;
      return p;
    };
    if (!correct) {
      for_each_pack_overlapping(begin, end, [&]<class T>(int i) {
        using N = Near<Dim, Axis, T>;
        const T value = N::interpolate(own + i, own_strides, N::origin(at(carrier, i), strides, step));
        store<T>(out + i, load<T>(area + i) > 0 ? value : load<T>(own + i));
      });
    } else {
      for_each_pack_overlapping(begin, end, [&]<class T>(int i) {
        using N = Near<Dim, Axis, T>;
        const auto range = N::range(own + i, own_strides, N::origin(at(carrier, i), strides, step));
        const T back = N::interpolate(ahead + i, own_strides, N::origin(at(carrier, i), strides, -step));
        const T old = load<T>(own + i);
        const T value = load<T>(ahead + i) + 0.5 * (old - back);
        store<T>(out + i, load<T>(area + i) > 0 ? larger(range.low, smaller(range.high, value)) : old);
      });
    }
  }
};

/// Whether nothing in the row at `start` and the rows around it moves more than a cell.
template <int Dim>
bool slow(const AdvectionFrame<Dim>& frame, const Index<Dim>& start, double dt) {
  Index<Dim> box;
  box.fill(3);
  box[0] = 1;
  double speed = 0;
  for_each_index<Dim>(box, [&](const Index<Dim>& offset) {
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      Index<Dim> shape = frame.carrier[axis].shape(), i = start;
      for (std::size_t k = 1; k < Dim; ++k) i[k] = std::clamp(i[k] + offset[k] - 1, 0, shape[k] - 1);
      shape[0] = 1;
      speed = std::max(speed, frame.carrier_speed[axis][flat<Dim>(i, shape)]);
    }
  });
  return speed * dt <= frame.grid.dx;
}

template <int Dim, int Axis>
void sweep_axis(FaceField<Dim>& out, const FaceField<Dim>& u, const FaceField<Dim>& forward,
                const AdvectionFrame<Dim>& frame, double dt, bool correct) {
  const Row<Dim, Axis> faces{frame, u, forward, dt, correct};
  const Index<Dim> shape = u[Axis].shape();
  parallel_for(
      u[Axis].n_rows(),
      [&](std::size_t r) {
        const Span span = frame.ground.rows(Axis)[r];
        if (span.empty()) return;
        const Index<Dim> start = u[Axis].row_start(r);
        bool border = false;
        for (std::size_t k = 1; k < Dim; ++k) border |= start[k] == 0 || start[k] == shape[k] - 1;
        Span inner{std::max(span.begin, 1), std::min(span.end, shape[0] - 1)};
        if (border || inner.empty() || !slow<Dim>(frame, start, dt)) inner = {span.end, span.end};
        double* row = out[Axis].row(r).data();
        if (!inner.empty()) faces.near(row, start, inner.begin, inner.end);
        for (int i = span.begin; i < span.end; ++i) {
          if (i == inner.begin && !inner.empty()) i = inner.end;
          if (i >= span.end) break;
          const Index<Dim> face = shifted<Dim>(start, 0, i);
          row[i] = frame.flow_area[Axis][face] > 0 ? faces.far(face) : u[Axis][face];
        }
      },
      u[Axis].rows_per_task());
}

}  // namespace

template <int Dim>
VelocityAdvection<Dim>::VelocityAdvection(const MacGrid<Dim>& grid)
    : forward_(make_face_field<Dim>(grid)), result_(make_face_field<Dim>(grid)) {}

template <int Dim>
void VelocityAdvection<Dim>::sweep(FaceField<Dim>& out, const FaceField<Dim>& u, const AdvectionFrame<Dim>& frame,
                                   double dt, Pass pass) const {
  const bool correct = pass == Pass::correct;
  sweep_axis<Dim, 0>(out, u, forward_, frame, dt, correct);
  sweep_axis<Dim, 1>(out, u, forward_, frame, dt, correct);
  if constexpr (Dim == 3) sweep_axis<Dim, 2>(out, u, forward_, frame, dt, correct);
}

template <int Dim>
void VelocityAdvection<Dim>::advect(FaceField<Dim>& u, const AdvectionFrame<Dim>& frame, double dt,
                                    AdvectionScheme scheme) {
  sweep(forward_, u, frame, dt, Pass::forward);
  if (scheme == AdvectionScheme::maccormack) sweep(result_, u, frame, dt, Pass::correct);
  auto& result = scheme == AdvectionScheme::maccormack ? result_ : forward_;
  for (std::size_t axis = 0; axis < Dim; ++axis) u[axis].swap(result[axis]);
}

template <int Dim>
void VelocityAdvection<Dim>::clear_deep(const Ground<Dim>& ground, int begin, int end) {
  ground.clear_deep(forward_, begin, end);
  ground.clear_deep(result_, begin, end);
}

template <int Dim>
std::size_t VelocityAdvection<Dim>::bytes() const {
  std::size_t n = 0;
  for (std::size_t axis = 0; axis < Dim; ++axis) n += forward_[axis].bytes() + result_[axis].bytes();
  return n;
}

template class VelocityAdvection<2>;
template class VelocityAdvection<3>;

}  // namespace spindrift
