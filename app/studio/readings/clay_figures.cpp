#include "app/studio/readings/clay_figures.hpp"

#include "app/studio/units.hpp"
#include "claystack/engine/clay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

std::string stress_text(const StressCurve& curve, LengthUnit unit) {
  const std::string at = length_text(curve.at_mm, unit);
  if (const auto part = curve.part())
    return fmt::format("{:.0f} % of the limit, at a height of {}", 100.0 * *part, at);
  return fmt::format("Maximum {:.2f} kPa, at a height of {}; no limit is set", curve.most_kpa, at);
}

namespace {

void add(const Ring& ring, bool first, SectionRow& row) {
  const auto outer = static_cast<float>(ring.outer_mm());
  const auto inner = static_cast<float>(ring.inner_mm());
  if (first) {
    row = {inner, inner, outer, outer};
    return;
  }
  row.inner_least_mm = std::min(row.inner_least_mm, inner);
  row.inner_most_mm = std::max(row.inner_most_mm, inner);
  row.outer_least_mm = std::min(row.outer_least_mm, outer);
  row.outer_most_mm = std::max(row.outer_most_mm, outer);
}

}  // namespace

std::vector<SectionRow> section_rows(const ClayStack& stack, std::size_t rows) {
  std::vector<SectionRow> section(rows);
  const auto rings = stack.rings();
  if (rings.empty()) return {};
  const double row_mm = stack.height_mm() / static_cast<double>(rows);
  const double last = static_cast<double>(rings.size() - 1);
  const auto ring_at = [&](double y_mm) {
    return static_cast<std::size_t>(std::clamp(y_mm / stack.ring_height_mm(), 0.0, last));
  };
  // A ring that only touches the edge of a row does not count.
  const double edge = 1e-9 * stack.ring_height_mm();
  for (std::size_t row = 0; row < rows; ++row) {
    const double low = row_mm * static_cast<double>(row);
    const std::size_t from = ring_at(low + edge), to = ring_at(low + row_mm - edge);
    for (std::size_t ring = from; ring <= to; ++ring) add(rings[ring], ring == from, section[row]);
  }
  return section;
}

double wall_at_height(std::span<const render::RowWall> walls, double height_mm, double y_mm) {
  if (walls.empty() || !(height_mm > 0.0) || y_mm < 0.0 || y_mm > height_mm)
    return std::numeric_limits<double>::infinity();
  const double part = y_mm / height_mm * static_cast<double>(walls.size());
  const auto row = std::min(static_cast<std::size_t>(part), walls.size() - 1);
  return static_cast<double>(std::min(walls[row].outer_mm, walls[row].inner_mm));
}

}  // namespace clay::studio
