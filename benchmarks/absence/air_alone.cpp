/// absence_air STEPS: takes steps of air and smoke without the simulation library, prints the state's bits.

#include "absence/air_alone.hpp"

#include <cstdio>
#include <cstdlib>

#include "core/parallel.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const spindrift::ThreadLimit one(1);
  spindrift::absence::AirAlone alone;
  for (int i = 0; i < std::atoi(argv[1]); ++i) alone.step();
  std::printf("%016lx\n", spindrift::absence::bits_of(alone.air));
}
