#include "engine/tick/lump.hpp"

#include "engine/tick/beside_tool.hpp"
#include "engine/tick/shell.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace clay {
namespace {

// Limits the work of a tick.
constexpr std::size_t kMostLiftedRings = 4096;

}  // namespace

std::optional<std::size_t> place_in_lump(const StepPlan& plan, const ClayStack& stack,
                                         const ToolState& tool,
                                         std::span<const ToolRemoval> removals) noexcept {
  if (!plan.clay.pressed_lump_stretches || removals.size() != 1) return std::nullopt;
  const Contact& contact = removals[0].contact;
  if (contact.rings.empty() || contact.side != Side::compressive) return std::nullopt;
  if (tool.moved_mm.y < -kSlowMmS * tool.dt_s) return std::nullopt;
  const double hip_y = tool.hip_mm.y;
  const auto rings = stack.rings();
  const std::size_t at = std::min(contact.rings.to(), rings.size());
  if (rings[at - 1].inner2 > 0) return std::nullopt;
  if (at == rings.size()) return at;
  if (rings[at].inner2 > 0 || rings.size() - at > kMostLiftedRings) return std::nullopt;
  const Ring wider{std::max(rings[at - 1].outer2, rings[at].outer2), 0};
  if (rise_clear(plan.tool, stack, hip_y, contact, wider, at)) return at;
  // Above the tool, where no ring can rise into it.
  const double above = std::ceil((hip_y + plan.tool.high()) / stack.ring_height_mm());
  const auto over = static_cast<std::size_t>(std::max(above, static_cast<double>(at)));
  if (over >= rings.size() || rings[over - 1].inner2 > 0 || rings[over].inner2 > 0)
    return std::nullopt;
  return over;
}

double stretched_part(const ClayStack& stack, const Band& band, double yields_mm) noexcept {
  // Tresca's yield stress is 1. The hand has the power Q per mm of circumference and mm/s. A column
  // of this height becomes thinner and longer: its volume gives c, and the two discs in which it
  // turns against the rigid clay above and below it give R/6 each. A punch needs (2 + pi)/2 of c.
  constexpr double kPunch = 2.57;
  const double radius = stack.rings()[std::min(band.ring, stack.size() - 1)].outer_mm();
  const double c = std::max(yields_mm, stack.ring_height_mm());
  const double ratio = (c + radius / 3.0) / (kPunch * c), squared = ratio * ratio;
  return 1.0 / (1.0 + squared * squared);
}

WideQuanta stretched_clay(WideQuanta squeezed, const ClayStack& stack, const Band& band,
                          double yields_mm, double upward_mm_s) noexcept {
  // Falls to a small part up to the speed at which nothing stretches.
  const double v = std::min(upward_mm_s, 0.0);
  const double lifted = 1.0 + v / std::sqrt(v * v + kSlowMmS * kSlowMmS);
  const double part = lifted * stretched_part(stack, band, yields_mm);
  return (squeezed * static_cast<std::int64_t>(part * 0x1p30)) >> 30;
}

}  // namespace clay
