#include "samples/replay/recorded_strokes.hpp"

#include "claystack/engine/wheel.hpp"

#include <utility>

namespace clay::samples {

Result<std::vector<Pot>> thrown_again(const WorkRecord& work, const std::optional<ClaySpec>& clay) {
  std::vector<Pot> pots;
  for (std::size_t node = 0; node < work.nodes.size(); ++node) {
    const WorkNode& stroke = work.nodes[node];
    SceneSpec scene = work.scenes[stroke.scene];
    scene.clay = clay;
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
