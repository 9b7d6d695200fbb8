#include "grid/advection.hpp"

#include "core/parallel.hpp"
#include "grid/pack.hpp"

namespace spindrift {
namespace {

/// How far in memory the neighbours of a point lie along each axis, below and above; 0 where the domain ends, so that
/// values go on constant.
template <int Dim>
struct Reach {
  const double* point;
  std::array<std::ptrdiff_t, Dim> low, high;
};

/// The surroundings of face `i` of `axis` in the lattice of velocity component `component`.
template <int Dim>
Reach<Dim> reach(const Field<Dim>& u, int component, int axis, const Index<Dim>& i) {
  const Index<Dim>& shape = u.shape();
  Reach<Dim> r;
  Index<Dim> base = i;
  for (int k = 0; k < Dim; ++k) {
    const auto at = static_cast<std::size_t>(k);
    r.low[at] = i[at] > 0 ? u.stride(k) : 0;
    r.high[at] = i[at] + 1 < shape[at] ? u.stride(k) : 0;
    if (k == axis && component != axis && i[at] == shape[at]) base[at] = shape[at] - 1, r.low[at] = 0;
  }
  r.point = &u[base];
  return r;
}

/// Reads around a face of axis `Axis`, T at a time. Displacements are in cells.
template <int Dim, int Axis, class T>
struct Near {
  /// Linear interpolation at displacement d, |d_k| <= 1, of a field on the face's own lattice; p = r.point + some
  /// faces.
  template <int K = Dim - 1>
  static T interpolate(const double* p, const Reach<Dim>& r, const std::array<T, Dim>& d) {
    if constexpr (K < 0) {
      return load<T>(p);
    } else {
      const T up = larger(d[K], T{}), down = larger(-d[K], T{});
      return down * interpolate<K - 1>(p - r.low[K], r, d) + (1 - up - down) * interpolate<K - 1>(p, r, d) +
             up * interpolate<K - 1>(p + r.high[K], r, d);
    }
  }

  /// The same of the velocity component `Other`, |d_k| <= 1/2.
  template <int Other, int K = Dim - 1>
  static T across(const double* p, const Reach<Dim>& r, const std::array<T, Dim>& d) {
    if constexpr (K < 0) {
      return load<T>(p);
    } else if constexpr (K == Axis) {
      return (0.5 - d[K]) * across<Other, K - 1>(p - r.low[K], r, d) + (0.5 + d[K]) * across<Other, K - 1>(p, r, d);
    } else if constexpr (K == Other) {
      return (0.5 - d[K]) * across<Other, K - 1>(p, r, d) + (0.5 + d[K]) * across<Other, K - 1>(p + r.high[K], r, d);
    } else {
      const T up = larger(d[K], T{}), down = larger(-d[K], T{});
      return down * across<Other, K - 1>(p - r.low[K], r, d) + (1 - up - down) * across<Other, K - 1>(p, r, d) +
             up * across<Other, K - 1>(p + r.high[K], r, d);
    }
  }

  /// across() at d = 0.
  template <int Other>
  static T mean(const double* p, const Reach<Dim>& r) {
    const double *below = p - r.low[Axis], *above = p + r.high[Other];
    return 0.25 * ((load<T>(p) + load<T>(below)) + (load<T>(above) + load<T>(above - r.low[Axis])));
  }

  struct Range {
    T low, high;
  };
  /// Least and largest of the values that interpolate() weights at d.
  template <int K = Dim - 1>
  static Range range(const double* p, const Reach<Dim>& r, const std::array<T, Dim>& d) {
    if constexpr (K < 0) {
      const T x = load<T>(p);
      return {x, x};
    } else {
      const Range here = range<K - 1>(p, r, d), below = range<K - 1>(p - r.low[K], r, d),
                  above = range<K - 1>(p + r.high[K], r, d);
      return {smaller(here.low, d[K] < 0 ? below.low : above.low),
              larger(here.high, d[K] < 0 ? below.high : above.high)};
    }
  }

  /// -D of the face `i` beyond the reaches' points: displacement to where its air comes from, in cells; step = dt / dx
  /// (negative: to where it goes).
  static std::array<T, Dim> origin(const std::array<Reach<Dim>, Dim>& carrier, int i, double step) {
    std::array<T, Dim> half, whole;
    component<0>([&]<int K>() {
      const Reach<Dim>& r = carrier[K];
      if constexpr (K == Axis) {
        half[K] = -0.5 * step * load<T>(r.point + i);
      } else {
        half[K] = -0.5 * step * mean<K>(r.point + i, r);
      }
    });
    component<0>([&]<int K>() {
      const Reach<Dim>& r = carrier[K];
      if constexpr (K == Axis) {
        whole[K] = -step * interpolate(r.point + i, r, half);
      } else {
        whole[K] = -step * across<K>(r.point + i, r, half);
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

/// Advects faces of axis Axis; everything they need is on hand.
template <int Dim, int Axis>
struct Faces {
  const AdvectionFrame<Dim>& frame;
  const FaceField<Dim>& u;
  const FaceField<Dim>& forward;  ///< u^ of the correcting pass
  double dt;
  bool correct;

  /// With look-ups: for any displacement.
  double far(const Index<Dim>& i) const {
    const MacGrid<Dim>& grid = frame.grid;
    const Vec<Dim> x = grid.face_centre(Axis, i);
    const auto displaced = [&](double time) {
      const Vec<Dim> middle = x - 0.5 * time * velocity_at<Dim>(grid, frame.carrier, x);
      return Vec<Dim>(x - time * velocity_at<Dim>(grid, frame.carrier, middle));
    };
    const Stencil<Dim> from = face_stencil<Dim>(grid, Axis, displaced(dt));
    if (!correct) return from.gather(u[Axis]);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (std::size_t c = 0; c < Stencil<Dim>::n; ++c) {
      if (from.weight[c] <= 0) continue;
      low = std::min(low, u[Axis][from.point[c]]);
      high = std::max(high, u[Axis][from.point[c]]);
    }
    const double back = face_stencil<Dim>(grid, Axis, displaced(-dt)).gather(forward[Axis]);
    return std::max(low, std::min(high, forward[Axis][i] + 0.5 * (u[Axis][i] - back)));
  }

  /// Faces first..first + n - 1 of a row, whose surroundings are alike, for displacements up to a cell.
  void near(double* out, const Index<Dim>& first, int n) const {
    std::array<Reach<Dim>, Dim> carrier;
    for (int k = 0; k < Dim; ++k) carrier[static_cast<std::size_t>(k)] = reach<Dim>(frame.carrier[k], k, Axis, first);
    const Reach<Dim> own = reach<Dim>(u[Axis], Axis, Axis, first);
    const double* ahead = &forward[Axis][first];
    const double* area = &frame.flow_area[Axis][first];
    const double step = dt / frame.grid.dx;
    if (!correct) {
      for_each_pack_overlapping(0, n, [&]<class T>(int i) {
        using N = Near<Dim, Axis, T>;
        const T value = N::interpolate(own.point + i, own, N::origin(carrier, i, step));
        store<T>(out + i, load<T>(area + i) > 0 ? value : load<T>(own.point + i));
      });
    } else {
      for_each_pack_overlapping(0, n, [&]<class T>(int i) {
        using N = Near<Dim, Axis, T>;
        const auto range = N::range(own.point + i, own, N::origin(carrier, i, step));
        const T back = N::interpolate(ahead + i, own, N::origin(carrier, i, -step));
        const T old = load<T>(own.point + i);
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
  const Faces<Dim, Axis> faces{frame, u, forward, dt, correct};
  const int n = u[Axis].shape()[0];
  parallel_for(
      u[Axis].n_rows(),
      [&](std::size_t r) {
        const Span span = frame.rows[Axis][r];
        if (span.empty()) return;
        const Index<Dim> start = u[Axis].row_start(r);
        double* row = out[Axis].row(r).data();
        if (slow<Dim>(frame, start, dt)) {
          const auto near = [&](int begin, int end) {
            if (begin < end) faces.near(row + begin, shifted<Dim>(start, 0, begin), end - begin);
          };
          const int inner_begin = std::max(span.begin, 1), inner_end = std::max(std::min(span.end, n - 1), inner_begin);
          if (span.begin == 0) near(0, 1);
          near(inner_begin, inner_end);
          if (span.end == n && n > 1) near(n - 1, n);
        } else {
          for (int i = span.begin; i < span.end; ++i) {
            const Index<Dim> face = shifted<Dim>(start, 0, i);
            row[i] = frame.flow_area[Axis][face] > 0 ? faces.far(face) : u[Axis][face];
          }
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
