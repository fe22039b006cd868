#pragma once
#include "claystack/export/section.hpp"

namespace clay::solid::shapes {

/// The half-section of a cup, 40 mm in radius and 60 mm high.
inline Polygon cup(double wall_mm, double floor_mm) {
  return {{0, 0}, {40, 0}, {40, 60}, {40 - wall_mm, 60}, {40 - wall_mm, floor_mm}, {0, floor_mm}};
}

}  // namespace clay::solid::shapes
