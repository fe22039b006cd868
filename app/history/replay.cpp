#include "app/history/replay.hpp"

#include <utility>

namespace clay::history {

Thrown replay(Wheel wheel, std::span<const Pose> poses) {
  std::vector<bool> touching;
  touching.reserve(poses.size());
  for (const Pose& pose : poses)
    touching.push_back(works(wheel.plan().mode, wheel.step(pose).flags));
  return {wheel.pot(), std::move(touching)};
}

}  // namespace clay::history
