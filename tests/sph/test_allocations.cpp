// A warm step allocates nothing: every operator new of the test executable is counted. The address sanitizer wants
// operator new for itself.
#ifndef __SANITIZE_ADDRESS__
#include <catch2/catch.hpp>

#include "core/parallel.hpp"
#include "count_allocations.hpp"
#include "fluid_fixture.hpp"

using namespace spindrift;
using namespace spindrift::test;

TEMPLATE_TEST_CASE_SIG("a warm step allocates nothing", "[dense_flow]", ((int Dim), Dim), 2, 3) {
  const ThreadLimit one(1);
  const double d = 0.05;
  DenseFlowOptions options = options_for<Dim>(d);
  options.viscosity = 1;
  options.no_slip = true;
  DenseFlow<Dim> flow(options);
  Index<Dim> n;
  n.fill(Dim == 2 ? 20 : 9);
  add_block<Dim>(flow.particles, n, d, 300, Vec<Dim>::Zero());
  shake(flow.particles, 0.05 * d, 0.5);
  const Walls<Dim> walls = box<Dim>(Vec<Dim>::Constant(n[0] * d));
  Stages stages;
  for (int k = 0; k < 60; ++k) step<Dim>(flow, 0.003, walls, -9.81 * up<Dim>(), stages);
  const std::uint64_t before = n_allocations;
  const std::size_t bytes = flow.bytes();
  for (int k = 0; k < 5; ++k) step<Dim>(flow, 0.003, walls, -9.81 * up<Dim>(), stages);
  CHECK(n_allocations == before);
  CHECK(flow.bytes() == bytes);
  CHECK(bytes > 0);
}
#endif
