#pragma once
/// A scalar on a box of grid points, first axis fastest. Access is by index or by rows along the first axis, so that
/// the layout stays private.

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/memory.hpp"
#include "core/vec.hpp"

namespace spindrift {

template <int Dim, class T = double>
class Field {
 public:
  Field() = default;
  explicit Field(const Index<Dim>& shape, T value = T{}) : shape_(shape), data_(count<Dim>(shape), value) {}

  const Index<Dim>& shape() const { return shape_; }
  std::size_t size() const { return data_.size(); }
  T& operator[](const Index<Dim>& i) { return data_[flat<Dim>(i, shape_)]; }
  const T& operator[](const Index<Dim>& i) const { return data_[flat<Dim>(i, shape_)]; }
  /// By flat number, in memory order.
  T& operator[](std::size_t n) { return data_[n]; }
  const T& operator[](std::size_t n) const { return data_[n]; }

  /// The row along the first axis that holds i.
  std::span<T> row(Index<Dim> i) {
    i[0] = 0;
    return {data_.data() + flat<Dim>(i, shape_), static_cast<std::size_t>(shape_[0])};
  }
  std::span<const T> row(Index<Dim> i) const {
    i[0] = 0;
    return {data_.data() + flat<Dim>(i, shape_), static_cast<std::size_t>(shape_[0])};
  }
  /// Rows by number, in memory order.
  std::size_t n_rows() const { return shape_[0] == 0 ? 0 : data_.size() / static_cast<std::size_t>(shape_[0]); }
  std::span<T> row(std::size_t r) {
    const auto length = static_cast<std::size_t>(shape_[0]);
    return {data_.data() + r * length, length};
  }
  std::span<const T> row(std::size_t r) const {
    const auto length = static_cast<std::size_t>(shape_[0]);
    return {data_.data() + r * length, length};
  }
  /// Index of the first point of row r.
  Index<Dim> row_start(std::size_t r) const { return unflat<Dim>(r * static_cast<std::size_t>(shape_[0]), shape_); }
  /// Distance in memory of neighbours along `axis`.
  std::ptrdiff_t stride(int axis) const {
    std::ptrdiff_t s = 1;
    for (int k = 0; k < axis; ++k) s *= shape_[k];
    return s;
  }
  std::span<T> values() { return data_; }
  std::span<const T> values() const { return data_; }

  /// Rows a task of a parallel loop takes: about 4096 points.
  std::size_t rows_per_task() const { return static_cast<std::size_t>(std::max(1, 4096 / std::max(1, shape_[0]))); }

  void fill(T value) { data_.assign(data_.size(), value); }
  void swap(Field& other) {
    std::swap(shape_, other.shape_);
    data_.swap(other.data_);
  }
  std::size_t bytes() const { return spindrift::bytes(data_); }

 private:
  Index<Dim> shape_{};
  std::vector<T> data_;
};

}  // namespace spindrift
