#pragma once
// Where the clay is: the ledger in grams, and to the quantum.

#include "app/servo/live_view.hpp"
#include "claystack/engine/clay.hpp"

#include <string>

namespace clay::studio {

struct ClayAccount {
  double initial_g = 0.0, added_g = 0.0, in_stack_g = 0.0, trimmed_g = 0.0, outside_g = 0.0;
  std::string unaccounted;  ///< quanta; "0" in a sound engine
  double unaccounted_g = 0.0;
  double capacity_mm3 = 0.0;  ///< to the brim
  friend bool operator==(const ClayAccount&, const ClayAccount&) = default;
};

[[nodiscard]] ClayAccount account_of(const Pot& pot);
/// In mid-stroke: what the servo tells of the ledger, and `stack` for what it holds. `before`: the
/// account as the stroke began.
[[nodiscard]] ClayAccount account_of(const servo::LiveStatus& status, const ClayStack& stack,
                                     double density_g_cm3, const ClayAccount& before);

/// "3.2 g", "1.25 kg".
[[nodiscard]] std::string mass_text(double grams);
/// "340 ml", "1.20 l".
[[nodiscard]] std::string capacity_text(double mm3);

}  // namespace clay::studio
