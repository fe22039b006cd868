#include "app/studio/readings/stress_curve.hpp"

#include "app/studio/length_text.hpp"
#include "claystack/engine/tick.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::studio {

StressCurve stress_of(const ClayStack& stack, double density_g_cm3,
                      std::optional<double> limit_kpa) {
  StressCurve curve{stresses_kpa(stack, density_g_cm3), stack.ring_height_mm(), 0.0, 0.0,
                    limit_kpa};
  const auto most = std::ranges::max_element(curve.kpa);
  if (most == curve.kpa.end()) return curve;
  curve.most_kpa = *most;
  curve.at_mm = (static_cast<double>(most - curve.kpa.begin()) + 0.5) * curve.ring_height_mm;
  return curve;
}

std::string stress_words(const StressCurve& curve, LengthUnit unit) {
  const std::string at = length_text(curve.at_mm, unit);
  if (const auto part = curve.part())
    return fmt::format("{:.0f} % of what it bears, at {}", 100.0 * *part, at);
  return fmt::format("At most {:.2f} kPa, at {}; no limit is set: it bears all", curve.most_kpa,
                     at);
}

}  // namespace clay::studio
