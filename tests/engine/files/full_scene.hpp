#pragma once
#include "claystack/engine/scene.hpp"

namespace clay::test {

/// Every field differs from its default.
inline SceneSpec full_scene() {
  SceneSpec scene;
  scene.name = "vase";
  scene.model = Model::paper;
  scene.lump = {300, 0.5, 40, 35.5, 900, 2.1};
  scene.tool = {SampledSpec{{-2, 0, 2.5}, {1, 2, 0}}, ToolMode::trim, 4.5};
  scene.removal = {7, 0.5, 2, 0.25};
  scene.flow = {3, 12, 0.5};
  scene.force = ForceSpec{0.1, 4, 0.3, false, 0.75};
  scene.stability = StabilitySpec{8};
  scene.clay = ClaySpec{false, false, false, false, false, false, 90,   7,    80,  0.75,
                        0.3,   true,  true,  true,  true,  true,  true, true, true};
  return scene;
}

}  // namespace clay::test
