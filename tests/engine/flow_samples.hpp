#pragma once
// How clay flows and where a tool touches, said outright.

#include "claystack/engine/step_plan.hpp"
#include "contact.hpp"

namespace clay::samples {

inline StepPlan plan_of(double sigma, double reach, double alpha, double h = 1.0) {
  SceneSpec scene;
  scene.lump.ring_height_mm = h;
  scene.flow = {sigma, reach, alpha};
  return StepPlan::build(scene).value();
}

inline Contact contact_on(std::size_t bottom, std::size_t top, Side side = Side::compressive) {
  Contact contact;
  contact.side = side;
  contact.bottom = bottom;
  contact.top = top;
  for (std::size_t i = bottom; i <= top; ++i)
    contact.rings.push_back({static_cast<std::uint32_t>(i), 1.0, 0.0});
  return contact;
}

}  // namespace clay::samples
