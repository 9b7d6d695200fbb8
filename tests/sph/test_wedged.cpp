#include <catch2/catch.hpp>
#include <numbers>

#include "fluid_fixture.hpp"

using namespace spindrift;
using namespace spindrift::test;

namespace {

constexpr double d = 0.1;

/// A particle at rest with cover of `cover_volume` d^Dim half a spacing below, and in snow of `snow_volume` d^Dim
/// beside.
template <int Dim>
struct Wedged {
  DenseFlow<Dim> flow{options_for<Dim>(d)};
  Particles<Dim> cover;
  std::size_t i = 0;
  double speed = 0;

  Wedged(double cover_volume, double snow_volume) {
    add_particle<Dim>(flow.particles, Vec<Dim>::Zero(), Vec<Dim>::Zero(), std::pow(d, Dim), 300);
    if (snow_volume > 0)
      add_particle<Dim>(flow.particles, d * Vec<Dim>::Unit(0), Vec<Dim>::Zero(), snow_volume * std::pow(d, Dim), 300);
    add_particle<Dim>(cover, -0.5 * d * up<Dim>(), Vec<Dim>::Zero(), cover_volume * std::pow(d, Dim), 100);
    CellList<Dim> cells(2 * d);
    cells.build(cover);
    const std::vector<Vec<Dim>> normals(1, up<Dim>());
    Stages stages;
    flow.sort(no_walls<Dim>(), stages);
    flow.find_neighbours(no_walls<Dim>(), {&cover, &cells, &normals}, stages);
    i = flow.particles.id[0] == 0 ? 0 : 1;
    flow.solve_velocity(0.005, stages);
    speed = flow.particles.velocity[i].norm();
  }
  double full() const { return flow.neighbours().full()[i]; }
  double volume_sum() const { return flow.neighbours().volume_sum()[i]; }
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("wedged snow is full: hand-computed for a particle on cover", "[wedged]", ((int Dim), Dim), 2,
                       3) {
  // V W(0) of the particle alone, h being 2 d: 10 / (7 pi) and 1 / pi. W / W(0) is 2 (3/4)^3 - 8 (1/4)^3 = 0.71875 at
  // q = 1/4 and 1/4 at q = 1/2.
  const double own = (Dim == 2 ? 10.0 / 7 : 1) / std::numbers::pi;
  SECTION("cover and the particle fill the space: they are full by definition, and nothing pushes") {
    const Wedged<Dim> wedged(4, 0);
    CHECK(wedged.full() == Approx(own * (1 + 4 * 0.71875)).epsilon(1e-6));
    CHECK(wedged.full() > 1.2);
    CHECK(wedged.volume_sum() == Approx(wedged.full()).epsilon(1e-6));
    CHECK(wedged.speed == 0);
  }
  SECTION("neighbours of the flow do not count: they can go away, and are pushed") {
    const Wedged<Dim> wedged(4, 1);
    CHECK(wedged.full() == Approx(own * (1 + 4 * 0.71875)).epsilon(1e-6));
    CHECK(wedged.volume_sum() == Approx(wedged.full() + own / 4).epsilon(1e-6));
    CHECK(wedged.speed > 0);
  }
  SECTION("with little cover full is 1") {
    const Wedged<Dim> loose(1, 0);
    CHECK(loose.volume_sum() == Approx(own * 1.71875).epsilon(1e-6));
    CHECK(loose.full() == 1);
  }
}
