#pragma once
// Random stacks for property tests, and a scene.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"

#include <rapidcheck.h>

#include <random>
#include <vector>

namespace clay::samples {

/// Uniform in [0, 1), the same on every platform.
inline double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Rings of 20 to 60 mm outer radius, with walls from one quantum to solid.
inline ClayStack stack(std::mt19937_64& random, std::size_t count, double ring_height_mm = 1.0) {
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < count; ++i) {
    const Quanta outer2 = quanta_from_radius(20.0 + 40.0 * uniform(random));
    const double kind = uniform(random);
    Quanta inner2 = 0;
    if (kind > 0.95)
      inner2 = outer2 - 1;
    else if (kind > 0.3)
      inner2 = static_cast<Quanta>(static_cast<double>(outer2) * 0.98 * uniform(random));
    rings.push_back({outer2, inner2});
  }
  return ClayStack::from_rings(ring_height_mm, std::move(rings), 0).value();
}

/// A solid lump of 40 rings and a ball of 8 mm; all stages but stability are on.
inline SceneSpec scene_of(Model model) {
  SceneSpec scene;
  scene.model = model;
  scene.lump = {.rings = 40,
                .ring_height_mm = 1.0,
                .outer_radius_mm = 30.0,
                .inner_radius_mm = 0.0,
                .max_rings = 120};
  scene.tool.shape = SphereSpec{8.0};
  scene.removal = {.rate_per_s = 40.0, .min_wall_mm = 0.5, .paper_fraction = {}};
  scene.flow = {.sigma_mm = 3.0, .reach_mm = 10.0, .inside_share = 0.27};
  scene.force->friction = 0.2;
  return scene;
}

inline rc::Gen<std::mt19937_64> random_engine() {
  return rc::gen::map(rc::gen::arbitrary<std::uint64_t>(),
                      [](std::uint64_t seed) { return std::mt19937_64(seed); });
}

}  // namespace clay::samples

namespace rc {
inline void showValue(const std::mt19937_64&, std::ostream& os) { os << "random engine"; }
}  // namespace rc
