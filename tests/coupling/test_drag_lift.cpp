#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "box.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

const ForceOptions paper_drag{0.81, ForceLaw::paper};
constexpr double r = 0.1;

/// The centre of a face normal to x: all of a particle's weight along x lies on this face.
template <int Dim>
Vec<Dim> on_a_face() {
  Vec<Dim> x = Vec<Dim>::Constant(4.5);
  x[0] = 4;
  return x;
}

}  // namespace

TEST_CASE("C1: drag in a given wind is exact at any time step", "[coupling]") {
  const double dt = GENERATE(1e-5, 1e-2, 1.0, 1e3);
  const double speed = GENERATE(1e-6, 1.0, 300.0);
  const double a = drag_stiffness(paper_drag, dt, r, 1.2, 1, 1);
  const double beta = drag_rate(a, 0, speed, false);
  CHECK(speed / (1 + beta) == Approx(speed / (1 + 0.81 * speed * dt / r)).epsilon(1e-13));
}

TEMPLATE_TEST_CASE_SIG("C2: drag between one particle and its air is exact", "[coupling]", ((int Dim), Dim), 2, 3) {
  Suspension<Dim> air = air_box<Dim>(8, 1, 0.043);
  Particles<Dim> particles;
  add_particle<Dim>(particles, on_a_face<Dim>(), 30 * Vec<Dim>::Unit(0), 0.1);
  run_exchange<Dim>(air, particles, [&](auto& region, auto& exchange) {
    exchange_drag<Dim>(region, exchange, particles, paper_drag, r, 0.043, 0.05, false);
  });
  CHECK(particles.velocity[0][0] == Approx(21.19689).epsilon(1e-6));
  CHECK(velocity_at<Dim>(air.grid(), air.velocity(), on_a_face<Dim>())[0] == Approx(20.47235).epsilon(1e-6));
}

TEST_CASE("C3: a falling particle settles at its terminal speed at any time step", "[coupling]") {
  const double g = 9.81, terminal = std::sqrt(g * r / 0.81), tau = terminal / g;
  const double steps_per_tau = GENERATE(0.1, 1.0, 100.0);
  const double dt = tau / steps_per_tau;
  double v = 0, worst = 0;
  for (int i = 1; i * dt < 40 * tau || i < 60; ++i) {
    v += g * dt;
    const double beta = drag_rate(drag_stiffness(paper_drag, dt, r, 1.2, 1, 1), 0, v, true);
    v *= 1 - beta / (1 + beta);
    worst = std::max(worst, std::abs(v - terminal * std::tanh(g * i * dt / terminal)));
  }
  CHECK(v == Approx(terminal).epsilon(1e-12));
  CHECK(worst < 0.6 * terminal / steps_per_tau);  // first order on the way there
}

TEMPLATE_TEST_CASE_SIG("C3: so does one that carries its air along", "[coupling]", ((int Dim), Dim), 2, 3) {
  // Particle and air fall together; the slip between them settles where drag makes both gain the same speed.
  const double phi = 20, g = 9.81, dt = 0.5;
  double w = 0;
  for (int i = 0; i < 200; ++i) {
    w += g * dt;
    const double beta = drag_rate(drag_stiffness(paper_drag, dt, r, 1.2, 1, 1), phi, w, true);
    w /= 1 + (1 + phi) * beta;
  }
  CHECK(w == Approx(std::sqrt(g * r / 0.81 / (1 + phi))).epsilon(1e-12));
}

TEMPLATE_TEST_CASE_SIG("C4: lift turns the slip by the damped rotation", "[coupling]", ((int Dim), Dim), 2, 3) {
  const double theta = GENERATE(1e-3, 0.1, 1.0, 50.0);
  Curl<Dim> axis = Curl<Dim>::Zero();
  axis[0] = theta;
  Vec<Dim> w = 3 * Vec<Dim>::Unit(Dim - 1);
  const Vec<Dim> turned = damped_rotation<Dim>(w, axis);
  CHECK(turned.norm() == Approx(3 / std::sqrt(1 + theta * theta)).epsilon(1e-12));
  CHECK((turned + cross<Dim>(turned, axis) - w).norm() < 1e-12 * (1 + theta));  // (I + [theta]) w' = w
  const double angle = std::acos(std::min(1.0, turned.dot(w) / turned.norm() / w.norm()));
  CHECK(angle == Approx(std::atan(theta)).margin(1e-7));  // the phase is second order
}

TEMPLATE_TEST_CASE_SIG("C4: a particle in heavy rotating air circles by Eq. (11)", "[coupling]", ((int Dim), Dim), 2,
                       3) {
  const double omega = 0.3, dt = 0.1, k_lift = 0.2;
  Suspension<Dim> air = air_box<Dim>(8, 1, 1e9, Side::open);
  FaceField<Dim> u = air.velocity();
  for (int axis : {0, Dim - 1})
    for_each_index<Dim>(air.grid().faces(axis), [&](const Index<Dim>& i) {
      const Vec<Dim> x = air.grid().face_centre(axis, i) - Vec<Dim>::Constant(4);
      u[static_cast<std::size_t>(axis)][i] = axis == 0 ? 0.5 * omega * x[Dim - 1] : -0.5 * omega * x[0];
    });
  air.set_velocity(u);
  Particles<Dim> particles;
  const Vec<Dim> v = 2 * Vec<Dim>::Unit(0);
  add_particle<Dim>(particles, Vec<Dim>(Vec<Dim>::Constant(4)), v, 1.0);
  run_exchange<Dim>(air, particles, [&](auto& region, auto& exchange) {
    exchange_lift<Dim>(region, exchange, particles, air, {k_lift, ForceLaw::paper}, dt);
  });
  Curl<Dim> theta = Curl<Dim>::Zero();
  theta[Dim == 2 ? 0 : 1] = k_lift * omega * dt;
  CHECK((particles.velocity[0] - damped_rotation<Dim>(v, theta)).norm() < 1e-8);
}

TEMPLATE_TEST_CASE_SIG("C6: forces move momentum between the layers and make none, and no energy", "[coupling]",
                       ((int Dim), Dim), 2, 3) {
  const double dt = GENERATE(1e-4, 1e-2, 10.0);
  const ForceLaw law = GENERATE(ForceLaw::paper, ForceLaw::air);
  const bool with_lift = GENERATE(false, true);
  Suspension<Dim> air = air_box<Dim>(10, 0.33, 1.2);
  stir<Dim>(air, 20);
  Particles<Dim> particles;
  for (std::uint64_t i = 0; i < 10000; ++i)
    add_particle<Dim>(particles, Vec<Dim>(Vec<Dim>::Constant(1.65) + 1.6 * noise_vector<Dim>(i, 0)),
                      Vec<Dim>(30 * noise_vector<Dim>(i, 10)), 3.3 * std::pow(10, 2 * noise(i, 20)), 0.011);
  const double energy = kinetic_energy(air, particles);
  const Vec<Dim> before = particle_momentum(particles) + air.momentum();
  const Vec<Dim> air_before = air.momentum();
  double scale = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) scale += particles.mass[i] * particles.velocity[i].norm();
  const Exchange<Dim> exchange = run_exchange<Dim>(air, particles, [&](auto& region, auto& out) {
    exchange_drag<Dim>(region, out, particles, {0.81, law}, 0.0525, 1.2, dt, false);
    if (with_lift) exchange_lift<Dim>(region, out, particles, air, {0.2, law}, dt);
  });
  CHECK(momentum_imbalance(exchange).norm() <= 1e-13 * scale);
  CHECK((air.momentum() - air_before - momentum_on_grid(exchange)).norm() <= 1e-13 * scale);
  CHECK((particle_momentum(particles) + air.momentum() - before).norm() <= 1e-12 * scale);
  CHECK(kinetic_energy(air, particles) <= energy * (1 + 1e-13));
}

// u' and v' minimise (sum m_f |u' - u|^2 + sum m_p |v' - v|^2 + sum m_p beta_p |v_p' - u_p'|^2) / 2.
TEMPLATE_TEST_CASE_SIG("Drag of many particles is the direct solve of its equations", "[coupling]", ((int Dim), Dim), 2,
                       3) {
  const double k = GENERATE(1e-3, 1.0, 1e4);
  const double mass = GENERATE(0.1, 30.0);
  const double dt = 0.01;
  Suspension<Dim> air = air_box<Dim>(4, 1, 1.2);
  stir<Dim>(air, 3);
  Particles<Dim> particles;
  for (std::uint64_t i = 0; i < 20; ++i)
    add_particle<Dim>(particles, Vec<Dim>(Vec<Dim>::Constant(2) + noise_vector<Dim>(i, 0)),
                      Vec<Dim>(10 * noise_vector<Dim>(i, 10)), mass * (1.5 + noise(i, 30)));
  OverlapRegion<Dim> region;
  const std::vector<std::uint8_t> overlap(particles.size(), 1);
  find_region<Dim>(region, particles, overlap, air);
  const OverlapRegion<Dim> before = region;
  Exchange<Dim> exchange;
  exchange.clear(particles.size());
  exchange_drag<Dim>(region, exchange, particles, {k, ForceLaw::paper}, r, 1.2, dt, false);

  const auto n = static_cast<Eigen::Index>(particles.size());
  for (int axis = 0; axis < Dim; ++axis) {
    const auto n_faces = static_cast<Eigen::Index>(before.faces[axis].size());
    Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(n, n_faces);
    Eigen::MatrixXd drag = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd v(n), u(n_faces), m(n), m_face(n_faces);
    for (Eigen::Index f = 0; f < n_faces; ++f) {
      u[f] = before.face_velocity[axis][static_cast<std::size_t>(f)];
      m_face[f] = before.face_mass[axis][static_cast<std::size_t>(f)];
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto p = static_cast<std::size_t>(i);
      const Shares<Dim>& shares = before.on_faces[axis][p];
      for (std::size_t c = 0; c < Shares<Dim>::n; ++c) weight(i, shares.slot[c]) += shares.weight[c];
      v[i] = before.velocity[p][axis];
      m[i] = particles.mass[p];
      drag(i, i) = m[i] * k * dt / r * before.slip[p];
    }
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + n_faces, n + n_faces);
    matrix.topLeftCorner(n, n) = Eigen::MatrixXd(m.asDiagonal()) + drag;
    matrix.topRightCorner(n, n_faces) = -drag * weight;
    matrix.bottomLeftCorner(n_faces, n) = -weight.transpose() * drag;
    matrix.bottomRightCorner(n_faces, n_faces) =
        Eigen::MatrixXd(m_face.asDiagonal()) + weight.transpose() * drag * weight;
    Eigen::VectorXd right(n + n_faces);
    right << m.cwiseProduct(v), m_face.cwiseProduct(u);
    const Eigen::VectorXd solution = matrix.ldlt().solve(right);
    double worst = 0;
    for (Eigen::Index i = 0; i < n; ++i)
      worst = std::max(worst, std::abs(region.velocity[static_cast<std::size_t>(i)][axis] - solution[i]));
    for (Eigen::Index f = 0; f < n_faces; ++f)
      worst = std::max(worst, std::abs(region.face_velocity[axis][static_cast<std::size_t>(f)] - solution[n + f]));
    CHECK(worst < 1e-7);
  }
}

TEMPLATE_TEST_CASE_SIG("A face that a particle hardly touches is hardly dragged along, however stiff the drag",
                       "[coupling]", ((int Dim), Dim), 2, 3) {
  Suspension<Dim> air = air_box<Dim>(8, 1, 1.2);
  Particles<Dim> particles;
  Vec<Dim> x = on_a_face<Dim>();
  x[0] += 0.001;
  add_particle<Dim>(particles, x, 30 * Vec<Dim>::Unit(0), 1000.0);
  run_exchange<Dim>(air, particles, [&](auto& region, auto& exchange) {
    exchange_drag<Dim>(region, exchange, particles, {1e6, ForceLaw::paper}, r, 1.2, 0.01, false);
  });
  const auto speed_at = [&](const Vec<Dim>& face) { return velocity_at<Dim>(air.grid(), air.velocity(), face)[0]; };
  const double held = speed_at(on_a_face<Dim>()), touched = speed_at(on_a_face<Dim>() + Vec<Dim>::Unit(0));
  CHECK(held == Approx(30).epsilon(0.01));
  CHECK(touched == Approx(0.001 / 0.999 * held).epsilon(1e-6));
}

TEMPLATE_TEST_CASE_SIG("F3: drag of any stiffness makes no energy", "[coupling]", ((int Dim), Dim), 2, 3) {
  const double k = GENERATE(0.0, 1.0, 1e6, 1e12);
  const double mass = GENERATE(1e-6, 1.0, 1e6);
  Suspension<Dim> air = air_box<Dim>(4, 1, 1.2);
  Particles<Dim> particles;
  for (std::uint64_t i = 0; i < 20; ++i)
    add_particle<Dim>(particles, Vec<Dim>(Vec<Dim>::Constant(2) + noise_vector<Dim>(i, 0)),
                      Vec<Dim>(10 * noise_vector<Dim>(i, 10)), mass);
  const double energy = kinetic_energy(air, particles);
  run_exchange<Dim>(air, particles, [&](auto& region, auto& exchange) {
    exchange_drag<Dim>(region, exchange, particles, {k, ForceLaw::paper}, r, 1.2, 0.01, false);
  });
  CHECK(kinetic_energy(air, particles) <= energy * (1 + 1e-13));
  // What is light answers what is heavy: the air may overshoot, by its weights, and the snow with it.
  for (const Vec<Dim>& v : particles.velocity) CHECK(v.cwiseAbs().maxCoeff() <= 1.1 * 10);
}

TEMPLATE_TEST_CASE_SIG("No particles, or none near the grid, exchange nothing", "[coupling]", ((int Dim), Dim), 2, 3) {
  Suspension<Dim> air = air_box<Dim>(4, 1, 1.2);
  Particles<Dim> particles;
  if (GENERATE(false, true)) add_particle<Dim>(particles, Vec<Dim>(Vec<Dim>::Constant(99)), Vec<Dim>::Unit(0), 1.0);
  const Exchange<Dim> exchange = run_exchange<Dim>(air, particles, [&](auto& region, auto& out) {
    exchange_drag<Dim>(region, out, particles, paper_drag, r, 1.2, 0.01, true);
    exchange_lift<Dim>(region, out, particles, air, {0.2, ForceLaw::paper}, 0.01);
    SmokeOptions smoke{GenerationOptions{}, AdhesionOptions{}, r, 0.1, 2};
    exchange_smoke<Dim>(region, out, particles, air, smoke, 0.01);
  });
  CHECK(momentum_on_grid(exchange).norm() == 0);
  CHECK(exchange.on_grid.smoke.empty());
}
