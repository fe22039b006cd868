#include "stability.hpp"

namespace clay {
namespace {

/// Rings from..to downward; `above` is what stands on ring `from`.
std::optional<Failure> weakest(const StabilityPlan& plan, std::span<const Ring> rings,
                               WideQuanta above, std::size_t from, std::size_t to) noexcept {
  // A running double is within 1e-9 of the exact sum; only rings that near the threshold, or past
  // it, are worth exact arithmetic.
  constexpr double kNear = 1.0 - 1e-9;
  const double scale = plan.kpa_per_ratio, limit = plan.max_stress_kpa * kNear;
  std::optional<Failure> worst;
  double above_ring = static_cast<double>(above);
  WideQuanta exact = above;
  std::size_t exact_at = from;
  for (std::size_t i = from + 1; i-- > to;) {
    const double volume = static_cast<double>(rings[i].volume());
    if (scale * above_ring >= limit * volume) {
      for (; exact_at > i; --exact_at) exact += rings[exact_at].volume();
      const double stress = stress_kpa(plan, exact, rings[i].volume());
      if (stress > plan.max_stress_kpa && (!worst || stress > worst->stress_kpa))
        worst = Failure{i, stress};
    }
    above_ring += volume;
  }
  return worst;
}

}  // namespace

double stress_kpa(const StabilityPlan& plan, WideQuanta above, Quanta ring) noexcept {
  return plan.kpa_per_ratio * (static_cast<double>(above) / static_cast<double>(ring));
}

void StabilityWatch::move_to(const ClayStack& stack, std::size_t highest) noexcept {
  const auto rings = stack.rings();
  if (!placed_) {
    cursor_ = rings.size() - 1;
    above_cursor_ = 0;
    placed_ = true;
  }
  for (; cursor_ > highest; --cursor_) above_cursor_ += rings[cursor_].volume();
  for (; cursor_ < highest; ++cursor_) above_cursor_ -= rings[cursor_ + 1].volume();
}

std::optional<Failure> StabilityWatch::check(const StabilityPlan& plan, const ClayStack& stack,
                                             std::size_t lowest, std::size_t grown) noexcept {
  const auto rings = stack.rings();
  for (std::size_t i = rings.size() - grown; i < rings.size(); ++i)
    above_cursor_ += rings[i].volume();
  // Growth and the crown weigh on every ring between the flow and the top.
  if (grown > 0) move_to(stack, rings.size() - 1);
  return weakest(plan, rings, above_cursor_ + stack.crown(), cursor_, lowest);
}

std::optional<Failure> StabilityWatch::check_all(const StabilityPlan& plan,
                                                 const ClayStack& stack) noexcept {
  return weakest(plan, stack.rings(), stack.crown(), stack.size() - 1, 0);
}

}  // namespace clay
