// Run a servo for 2 s: a simulated arm presses into a lump, behind the force guard.
#include <claystack/falcon/sim.hpp>
#include <claystack/servo/servo.hpp>

#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>

int main() {
  const clay::servo::LiveSettings settings{
      .seconds = 2.0, .mapping = {.reach_mm = 50.0, .height_mm = 40.0}, .guard = {.ramp_s = 0.5}};
  clay::SceneSpec scene;
  scene.removal.rate_per_s = 0.1;  // stiff clay
  clay::falcon::SimulatedSettings arm = clay::falcon::simulated_and_loaded();
  arm.path = [](double t_s) { return glm::dvec3(5.0 - 5.0 * std::clamp(t_s, 0.0, 2.0), 0, 0); };
  const auto simulated = clay::falcon::make_simulated_falcon(arm);
  if (!simulated || !simulated->device->open() || !clay::servo::soften(scene, settings)) return 2;
  auto wheel = clay::Wheel::build(scene);
  auto live = clay::servo::LiveThrow::build(
      {.wheel = *wheel, .device = *simulated->device, .scene = scene}, settings);
  if (!live) return std::fprintf(stderr, "%s\n", live.error().message.c_str()), 2;
  if (!live->start()) return 2;
  const bool whole = live->join() == clay::servo::Ending::time_up;
  const double clay_n = glm::length(live->status().clay_n);
  std::printf("%.1f s on the clay, which pushes back with %.2f N\n", live->status().time_s, clay_n);
  return whole && clay_n > 0.0 ? 0 : 1;
}
