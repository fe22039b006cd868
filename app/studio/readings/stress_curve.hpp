#pragma once
// How near the clay is to falling under its own weight.

#include "app/studio/settings.hpp"
#include "claystack/engine/clay.hpp"

#include <optional>
#include <string>
#include <vector>

namespace clay::studio {

struct StressCurve {
  std::vector<double> kpa;  ///< of every ring, bottom to top
  double ring_height_mm = 0.0;
  double most_kpa = 0.0, at_mm = 0.0;  ///< the greatest, and the middle of its ring
  std::optional<double> limit_kpa;     ///< nothing: this clay bears all
  /// Of what it bears; nothing without a limit.
  [[nodiscard]] std::optional<double> part() const {
    return limit_kpa ? std::optional(most_kpa / *limit_kpa) : std::nullopt;
  }
};

/// `limit_kpa`: StabilitySpec::max_stress_kpa.
[[nodiscard]] StressCurve stress_of(const ClayStack& stack, double density_g_cm3,
                                    std::optional<double> limit_kpa);

/// "62 % of what it bears, at 12.0 mm".
[[nodiscard]] std::string stress_words(const StressCurve& curve, LengthUnit unit);

}  // namespace clay::studio
