#include "app/bench/hands/tasks.hpp"

#include "app/bench/hands/potter.hpp"
#include "app/bench/timing.hpp"
#include "claystack/engine/wheel.hpp"

#include <cmath>

namespace clay::bench {
namespace {

constexpr double kLumpMm3 = 526'316.0;  // 1 kg of 1.9 g/cm3
constexpr double kFlatRadiusMm = 80.0, kTallRadiusMm = 50.0;

void throw_by(Potter& potter, Task task) {
  if (task == Task::plate) {
    potter.open(5.0);
    potter.widen(48.0);
    potter.pull(16.0);
    potter.pull(10.0);
    potter.flare(22.0);
    return;
  }
  potter.open();
  potter.widen();
  if (task == Task::open) return;
  if (task == Task::bowl) {
    potter.pull(12.0);
    potter.pull(8.0);
    potter.flare(28.0);
    return;
  }
  potter.pull(13.0);
  potter.pull(10.0, 38.0);
  potter.pull(7.5, 38.0);
  if (task == Task::belly) potter.belly(18.0);
  if (task == Task::collar) potter.collar(15.0);
  if (task == Task::bottle) {
    potter.collar(12.0);
    potter.pull(7.0);
    potter.collar(10.0);
  }
}

}  // namespace

const TaskFacts& facts_of(Task task) {
  static constexpr std::array<TaskFacts, kTasks.size()> kFacts{{
      {"open", "open, widen twice", 122.0, 0.95},
      {"cylinder", "open, widen, three pulls between 13, 10 and 7.5 mm", 108.0, 0.95},
      {"belly", "a cylinder, bellied by 18 mm in four passes", 120.0, 0.95},
      {"collar", "a cylinder, collared by 15 mm in four passes", 108.0, 0.95},
      {"bowl", "open, widen, two pulls, flared by 28 mm in five passes", 150.0, 0.95},
      {"plate", "a flat lump: open, widen, two pulls, laid out by 22 mm", 220.0, 0.85},
      {"bottle", "a cylinder, collared by 12 mm, pulled, collared by 10 mm", 108.0, 0.85},
  }};
  return kFacts[static_cast<std::size_t>(task)];
}

SceneSpec hands_scene(Task task, const std::optional<ClaySpec>& clay, double ring_height_mm) {
  const double radius = task == Task::plate ? kFlatRadiusMm : kTallRadiusMm;
  const double height = kLumpMm3 / (3.141592653589793 * radius * radius);
  const auto rings = static_cast<std::size_t>(height / ring_height_mm + 0.5);
  SceneSpec scene;
  scene.name = "hands";
  scene.lump = {.rings = rings,
                .ring_height_mm = ring_height_mm,
                .outer_radius_mm = radius,
                .inner_radius_mm = 0.0,
                .max_rings = 8 * static_cast<std::size_t>(67.0 / ring_height_mm),
                .density_g_cm3 = 1.9};
  scene.tool = {SphereSpec{10.0}, ToolMode::press, 10.0};
  scene.removal = {20.0, 2.0, 3.0, {}};
  scene.flow = {8.0415, 33.506, 0.25};
  scene.force.reset();
  scene.clay = clay;
  return scene;
}

ThrownPot throw_pot(Task task, const SceneSpec& scene, std::uint64_t seed) {
  Wheel wheel = Wheel::build(scene).value();
  Potter potter(wheel, seed + 1);
  ThrownPot thrown;
  potter.watch = [&](const Pose& pose, const StepReport& report) {
    thrown.ticks.push_back({pose, (report.flags & kContact) != 0});
  };
  throw_by(potter, task);
  thrown.stack = wheel.stack();
  thrown.measures = measure(wheel.stack());
  thrown.wheel_s = potter.time_s();
  thrown.volume_error = wheel.ledger().imbalance(wheel.stack().recount());
  return thrown;
}

double contact_tick_us(const SceneSpec& scene, const std::vector<PlayedTick>& ticks) {
  Wheel wheel = Wheel::build(scene).value();
  double seconds = 0.0;
  std::size_t in_contact = 0;
  // The clock is read once for each contact, because reading it takes as long as a tick on some
  // machines.
  for (std::size_t k = 0; k < ticks.size();) {
    const std::size_t first = k;
    const bool touches = ticks[k].in_contact;
    const double spent = work_seconds_of([&] {
      for (; k < ticks.size() && ticks[k].in_contact == touches; ++k) wheel.step(ticks[k].pose);
    });
    if (!touches) continue;
    seconds += spent;
    in_contact += k - first;
  }
  return 1e6 * seconds / static_cast<double>(in_contact);
}

}  // namespace clay::bench
