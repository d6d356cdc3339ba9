// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a world, a list of movers (YAML) and an .ini file: refused, or values that can be
// used.
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "cca_mrpt/io/parameters.hpp"
#include "cca_mrpt/simulation/world.hpp"
#include "memory_file.hpp"
#include "simulation/movers.hpp"

namespace {

void check(bool good) {
  if (!good) std::abort();
}

template <class Read>
void tryTo(const Read& read) {
  try {
    read();
  } catch (const std::runtime_error&) {
  }
}

/// 24 m x 16 m without a wall: movers of the seeds can walk there.
const cca::World& freeWorld() {
  static const cca::World world("free", 240, 160, std::vector<unsigned char>(240 * 160, 0), 0.1,
                                Eigen::Vector2d::Zero());
  return world;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const cca::MemoryFile file(bytes, size);
  tryTo([&] { check(cca::loadWorld(file.path()).width() > 0); });
  tryTo([&] {
    for (const auto& mover : cca::loadMovers(file.path(), freeWorld())) {
      check(std::isfinite(mover.speed));
    }
  });
  tryTo([&] {
    cca::Parameters parameters;
    cca::loadParameters(file.path(), parameters);
    for (const auto& field : cca::listParameters(parameters)) field.set(field.get());
  });
  return 0;
}
