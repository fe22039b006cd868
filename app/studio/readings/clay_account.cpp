#include "app/studio/readings/clay_account.hpp"

#include "claystack/engine/tick.hpp"

#include <fmt/format.h>

#include <cmath>

namespace clay::studio {
namespace {

constexpr double kCm3PerMm3 = 1e-3;

}  // namespace

ClayAccount account_of(const Pot& pot) {
  const double g = pot.stack.mm3_per_quantum() * kCm3PerMm3 * pot.density_g_cm3;
  const auto grams = [g](WideQuanta quanta) { return g * static_cast<double>(quanta); };
  const WideQuanta unaccounted = pot.ledger.imbalance(pot.stack.recount());
  return {grams(pot.ledger.initial), grams(pot.ledger.added),   grams(pot.stack.volume()),
          grams(pot.ledger.trimmed), grams(pot.ledger.outside), to_string(unaccounted),
          grams(unaccounted),        capacity_mm3(pot.stack)};
}

ClayAccount account_of(const servo::LiveStatus& status, const ClayStack& stack,
                       double density_g_cm3, const ClayAccount& before) {
  const double g = kCm3PerMm3 * density_g_cm3;
  ClayAccount account = before;
  account.in_stack_g = g * status.stack_mm3;
  account.trimmed_g = g * status.trimmed_mm3;
  account.outside_g = g * status.outside_mm3;
  account.unaccounted = fmt::format("{:.0f}", status.imbalance);
  account.unaccounted_g = account.in_stack_g + account.trimmed_g + account.outside_g -
                          account.initial_g - account.added_g;
  if (status.imbalance == 0.0) account.unaccounted_g = 0.0;
  account.capacity_mm3 = capacity_mm3(stack);
  return account;
}

std::string mass_text(double grams) {
  if (std::abs(grams) >= 1000.0) return fmt::format("{:.3f} kg", 1e-3 * grams);
  return fmt::format("{:.1f} g", grams);
}

std::string capacity_text(double mm3) {
  const double ml = 1e-3 * mm3;
  if (ml >= 1000.0) return fmt::format("{:.2f} l", 1e-3 * ml);
  return fmt::format("{:.{}f} ml", ml, ml < 10.0 ? 1 : 0);
}

}  // namespace clay::studio
