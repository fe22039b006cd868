#pragma once
// Explicit flow settings.

#include "claystack/engine/plan.hpp"
#include "tests/engine/tick/contact_samples.hpp"

namespace clay::samples {

inline StepPlan plan_of(double sigma, double reach, double alpha, double h = 1.0) {
  SceneSpec scene;
  scene.lump.ring_height_mm = h;
  scene.flow = {sigma, reach, alpha};
  return StepPlan::build(scene).value();
}

}  // namespace clay::samples
