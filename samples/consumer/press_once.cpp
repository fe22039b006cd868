// Uses the engine alone: presses a ball of 10 mm radius into a lump for a tenth of a second, 20 mm
// a second, and prints the force on it. The volume does not change.

#include <claystack/engine/wheel.hpp>

#include <cstdio>

int main() {
  clay::SceneSpec scene;
  scene.removal.rate_per_s = 0.1;  // stiff clay
  auto wheel = clay::Wheel::build(scene);
  if (!wheel) {
    std::fprintf(stderr, "%s\n", wheel.error().message.c_str());
    return 2;
  }
  const double before = wheel->stack().volume_mm3();
  clay::StepReport last;
  for (int ms = 1; ms <= 100; ++ms)
    last = wheel->step({.time_us = 1000 * ms, .position_mm = {55.0 - 0.02 * ms, 60.0, 0.0}});
  const double change_mm3 = wheel->stack().volume_mm3() - before;
  std::printf("pushed back with %.2f N; volume changed by %g mm3\n", last.force_n().x, change_mm3);
  return last.force_n().x > 0.0 && change_mm3 == 0.0 ? 0 : 1;
}
