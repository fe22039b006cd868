#pragma once
// Cups of known walls for tests of the readings.

#include "app/render/pot_view.hpp"
#include "app/studio/readings/pot_check.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace clay::test {

/// A cup with vertical walls: floor 10 mm, wall 5 mm, height 60 mm, radius 40 mm; rings of 0.5 mm.
inline std::vector<Ring> cup_rings(double wall_mm = 5.0) {
  std::vector<Ring> rings(120, Ring{quanta_from_radius(40.0), 0});
  for (std::size_t i = 20; i < rings.size(); ++i)
    rings[i].inner2 = quanta_from_radius(40.0 - wall_mm);
  return rings;
}

inline history::SharedPot pot_of(std::vector<Ring> rings, WideQuanta trimmed = 0) {
  Pot pot;
  pot.stack = ClayStack::from_rings(0.5, std::move(rings), 0).value();
  pot.density_g_cm3 = 2.0;
  pot.ledger.initial = pot.stack.volume() + trimmed;
  pot.ledger.trimmed = trimmed;
  return std::make_shared<const Pot>(std::move(pot));
}

inline studio::PotQuestion question_of(const history::SharedPot& pot,
                                       const std::string& process = {}) {
  return {{pot, render::view_of(*pot), pot->density_g_cm3}, process};
}

}  // namespace clay::test
