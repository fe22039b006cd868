#include "samples/replay/recorded_strokes.hpp"

#include "claystack/engine/wheel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clay::samples {
namespace {

/// A surface at a height, between the middles of two rings.
double surface_at(const ClayStack& stack, double up_mm, double (Ring::*surface)() const) {
  const auto rings = stack.rings();
  const double last = static_cast<double>(rings.size() - 1);
  const double level = std::clamp(up_mm / stack.ring_height_mm() - 0.5, 0.0, last);
  const auto i = static_cast<std::size_t>(level);
  const double part = level - std::floor(level);
  return (1.0 - part) * (rings[i].*surface)() +
         part * (rings[std::min(i + 1, rings.size() - 1)].*surface)();
}

}  // namespace

bool cuts(const WorkRecord& work, std::size_t node) {
  const WorkNode& stroke = work.nodes[node];
  return work.scenes[stroke.scene].tool.mode == ToolMode::trim ||
         std::ranges::any_of(stroke.poses, &Pose::trim);
}

double mean_difference_mm(const ClayStack& one, const ClayStack& other) {
  constexpr double kStepMm = 0.5;
  const auto whole = [](const ClayStack& stack) {
    return stack.ring_height_mm() * static_cast<double>(stack.size());
  };
  const double top = std::min(whole(one), whole(other));
  double sum = 0.0;
  int count = 0;
  for (double up = 0.5 * kStepMm; up < top; up += kStepMm)
    for (const auto surface : {&Ring::outer_mm, &Ring::inner_mm}) {
      sum += std::abs(surface_at(one, up, surface) - surface_at(other, up, surface));
      ++count;
    }
  return sum / std::max(count, 1);
}

Result<std::vector<Pot>> thrown_again(const WorkRecord& work, const std::optional<ClaySpec>& clay,
                                      int finer) {
  std::vector<Pot> pots;
  for (std::size_t node = 0; node < work.nodes.size(); ++node) {
    const WorkNode& stroke = work.nodes[node];
    SceneSpec scene = work.scenes[stroke.scene];
    scene.clay = clay;
    scene.lump.ring_height_mm /= finer;
    scene.lump.rings *= static_cast<std::size_t>(finer);
    scene.lump.max_rings *= static_cast<std::size_t>(finer);
    const Pot* start = node > 0 ? &pots[stroke.parent] : work.start ? &*work.start : nullptr;
    if (start != nullptr && start->collapse) {
      pots.push_back(*start);
      continue;
    }
    auto wheel = start != nullptr ? Wheel::build(scene, *start) : Wheel::build(scene);
    if (!wheel) return tl::make_unexpected(wheel.error());
    for (const Pose& pose : stroke.poses) wheel->step(pose);
    pots.push_back(wheel->pot());
  }
  return pots;
}

}  // namespace clay::samples
