#include "app/bench/bellied_pot.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace clay::bench {
namespace {

constexpr double kRingMm = 0.75;

}  // namespace

Pot bellied_pot(double wall_mm) {
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < kBelliedRings; ++i) {
    const double t = (static_cast<double>(i) + 0.5) / kBelliedRings;
    const double outer =
        48.0 + 14.0 * std::sin(5.2 * t - 0.4) - 6.0 * t + 0.2 * std::sin(190.0 * t);
    const bool floor = t < 0.04 || wall_mm == 0.0;
    rings.push_back({quanta_from_radius(outer), floor ? 0 : quanta_from_radius(outer - wall_mm)});
  }
  Pot pot;
  pot.stack = ClayStack::from_rings(kRingMm, std::move(rings), 0).value();
  pot.ledger.initial = pot.stack.volume();
  return pot;
}

}  // namespace clay::bench
