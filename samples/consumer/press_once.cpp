// Uses the engine alone: presses a thumb into a lump for a tenth of a second and prints the mass.

#include <claystack/engine/wheel.hpp>

#include <cstdio>

int main() {
  clay::SceneSpec scene;
  auto wheel = clay::Wheel::build(scene);
  if (!wheel) {
    std::fprintf(stderr, "%s\n", wheel.error().message.c_str());
    return 2;
  }
  const double before = wheel->stack().volume_mm3();
  clay::StepReport last;
  for (int tick = 0; tick < 100; ++tick)
    last =
        wheel->step({.time_us = 1000 * (tick + 1), .position_mm = {52.0, 60.0 + 0.05 * tick, 0.0}});
  std::printf("pushed back with %.2f N; volume changed by %g mm3\n", last.force_n().x,
              wheel->stack().volume_mm3() - before);
  return wheel->stack().volume_mm3() == before ? 0 : 1;
}
