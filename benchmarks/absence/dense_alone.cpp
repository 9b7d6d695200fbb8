/// absence_dense STEPS bare|cover: takes steps of the dense flow without the simulation library, prints the state's
/// bits.

#include "absence/dense_alone.hpp"

#include <cstdio>
#include <cstdlib>
#include <string_view>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const spindrift::ThreadLimit one(1);
  spindrift::absence::DenseAlone alone(std::string_view(argv[2]) == "cover");
  for (int i = 0; i < std::atoi(argv[1]); ++i) alone.step();
  std::printf("%016lx\n", spindrift::absence::bits_of(alone.dense.particles));
}
