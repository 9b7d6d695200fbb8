#include "terrain/profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "core/memory.hpp"

namespace spindrift {
namespace {

void check_vertices(const std::vector<Vec<2>>& v) {
  const auto refuse = [](const std::string& why) { throw Error(ExitCode::bad_input, "terrain: " + why); };
  if (v.size() < 2) refuse("at least two points are needed, got " + std::to_string(v.size()));
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (!v[i].allFinite()) refuse("point " + std::to_string(i + 1) + " is not finite");
    if (i == 0) continue;
    if (v[i][0] < v[i - 1][0]) refuse("x decreases at point " + std::to_string(i + 1));
    if (v[i] == v[i - 1]) refuse("points " + std::to_string(i) + " and " + std::to_string(i + 1) + " coincide");
  }
  if (v[1][0] == v[0][0] || v[v.size() - 1][0] == v[v.size() - 2][0])
    refuse("the first and the last piece must not be vertical");
}

}  // namespace

Profile::Profile(std::vector<Vec<2>> vertices) : vertices_(std::move(vertices)) {
  check_vertices(vertices_);
  arc_.resize(vertices_.size());
  for (std::size_t i = 1; i < vertices_.size(); ++i) arc_[i] = arc_[i - 1] + (vertices_[i] - vertices_[i - 1]).norm();

  const std::size_t n_bins = vertices_.size();
  table_x0_ = vertices_.front()[0];
  table_step_ = (vertices_.back()[0] - table_x0_) / static_cast<double>(n_bins);
  table_.resize(n_bins);
  std::uint32_t piece = 0;
  for (std::size_t b = 0; b < n_bins; ++b) {
    const double x = table_x0_ + static_cast<double>(b) * table_step_;
    while (piece + 2 < vertices_.size() && vertices_[piece + 1][0] < x) ++piece;
    table_[b] = piece;
  }
}

Vec<2> Profile::piece_tangent(std::size_t piece) const {
  return (vertices_[piece + 1] - vertices_[piece]).normalized();
}

Vec<2> Profile::piece_normal(std::size_t piece) const {
  const Vec<2> t = piece_tangent(piece);
  return {-t[1], t[0]};
}

std::size_t Profile::first_piece_reaching(double x) const {
  const double bin = std::clamp((x - table_x0_) / table_step_, 0.0, static_cast<double>(table_.size() - 1));
  std::size_t piece = table_[static_cast<std::size_t>(bin)];
  while (piece + 2 < vertices_.size() && vertices_[piece + 1][0] < x) ++piece;
  return piece;
}

double Profile::height(double x) const {
  std::size_t piece = first_piece_reaching(x);
  double z = -std::numeric_limits<double>::infinity();
  for (; piece + 1 < vertices_.size() && (vertices_[piece][0] <= x || piece == 0); ++piece) {
    const Vec<2>&a = vertices_[piece], b = vertices_[piece + 1];
    z = std::max(z, a[0] == b[0] ? std::max(a[1], b[1]) : a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]));
    if (b[0] > x) break;
  }
  return z;
}

Foot<2> Profile::foot(const Vec<2>& x, double reach) const {
  const std::size_t last = vertices_.size() - 2;

  // The surface straight above or below bounds how far away, and so how far aside, the nearest point can be.
  const double above = x[1] - height(x[0]);
  const double aside = std::min(reach, std::abs(above));
  double best = std::numeric_limits<double>::infinity(), best_t = 0;
  std::size_t best_piece = 0;
  Vec<2> best_point = x;
  for (std::size_t piece = first_piece_reaching(x[0] - aside);
       piece <= last && (piece == 0 || vertices_[piece][0] <= x[0] + aside); ++piece) {
    const Vec<2>& a = vertices_[piece];
    const Vec<2> edge = vertices_[piece + 1] - a;
    double t = (x - a).dot(edge) / edge.squaredNorm();
    if (piece != 0) t = std::max(t, 0.0);
    if (piece != last) t = std::min(t, 1.0);
    const Vec<2> point = a + t * edge;
    const double distance = (x - point).squaredNorm();
    if (distance < best) {
      best = distance, best_t = t, best_piece = piece, best_point = point;
    }
  }

  if (best >= reach * reach) {
    Foot<2> far;
    far.distance = std::copysign(reach, above);
    return far;
  }

  Vec<2> normal = piece_normal(best_piece);
  if (best_t <= 0 && best_piece > 0) normal = (normal + piece_normal(best_piece - 1)).normalized();
  if (best_t >= 1 && best_piece < last) normal = (normal + piece_normal(best_piece + 1)).normalized();
  const Vec<2> away = x - best_point;
  const double sign = away.dot(normal) < 0 ? -1 : 1;
  const double distance = away.norm();
  const double rounding = 1e-12 * (1 + x.norm());
  if (distance > 1e3 * rounding) normal = sign * away / distance;

  Foot<2> foot;
  foot.distance = sign * distance;
  foot.normal = normal;
  foot.place[0] = arc_[best_piece] + best_t * (arc_[best_piece + 1] - arc_[best_piece]);
  return foot;
}

std::size_t Profile::piece_at(double arc_length) const {
  const auto above = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, arc_length);
  return static_cast<std::size_t>(above - arc_.begin()) - 1;
}

Vec<2> Profile::tangent(double arc_length) const {
  return piece_tangent(piece_at(arc_length));
}

Vec<2> Profile::position(double arc_length, double distance) const {
  const std::size_t piece = piece_at(arc_length);
  return vertices_[piece] + (arc_length - arc_[piece]) * piece_tangent(piece) + distance * piece_normal(piece);
}

std::size_t Profile::bytes() const {
  return spindrift::bytes(vertices_) + spindrift::bytes(arc_) + spindrift::bytes(table_);
}

}  // namespace spindrift
