#pragma once
// Figures of the clay: the ledger, the stress in proportion to its limit, and the section in rows
// of pixels.

#include "app/render/picture.hpp"
#include "app/servo/live_view.hpp"
#include "app/studio/units.hpp"
#include "claystack/engine/clay.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace clay::studio {

/// The ledger in grams, and its imbalance to the quantum.
struct ClayAccount {
  double initial_g = 0.0, added_g = 0.0, in_stack_g = 0.0, trimmed_g = 0.0, outside_g = 0.0;
  std::string unaccounted;  ///< quanta; "0" unless the engine has a fault
  double unaccounted_g = 0.0;
  double capacity_mm3 = 0.0;  ///< to the brim
  friend bool operator==(const ClayAccount&, const ClayAccount&) = default;
};

[[nodiscard]] ClayAccount account_of(const Pot& pot);
/// During a stroke: computed from the ledger figures of the servo; `stack` gives the capacity.
/// `before`: the ledger at the start of the stroke.
[[nodiscard]] ClayAccount account_of(const servo::LiveStatus& status, const ClayStack& stack,
                                     double density_g_cm3, const ClayAccount& before);

struct StressCurve {
  std::vector<double> kpa;  ///< one for each ring, bottom to top
  double ring_height_mm = 0.0;
  double most_kpa = 0.0, at_mm = 0.0;  ///< maximum, and the height of the middle of its ring
  std::optional<double> limit_kpa;     ///< stress at which the clay falls; empty: no limit
  /// Maximum as a fraction of the limit; empty without a limit.
  [[nodiscard]] std::optional<double> part() const {
    return limit_kpa ? std::optional(most_kpa / *limit_kpa) : std::nullopt;
  }
};

/// `limit_kpa`: StabilitySpec::max_stress_kpa.
[[nodiscard]] StressCurve stress_of(const ClayStack& stack, double density_g_cm3,
                                    std::optional<double> limit_kpa);

/// "62 % of the limit, at a height of 12.0 mm".
[[nodiscard]] std::string stress_text(const StressCurve& curve, LengthUnit unit);

/// Extremes of the rings in one row of pixels. Between inner_most and outer_least all of these
/// rings hold clay; between inner_least and outer_most some do.
struct SectionRow {
  float inner_least_mm = 0.0f, inner_most_mm = 0.0f;
  float outer_least_mm = 0.0f, outer_most_mm = 0.0f;
  friend bool operator==(const SectionRow&, const SectionRow&) = default;
};

/// `rows` equal parts of the height of the stack, bottom to top; the crown counts as a ring.
/// O(rings + rows).
[[nodiscard]] std::vector<SectionRow> section_rows(const ClayStack& stack, std::size_t rows);

/// Wall thickness at a height [mm]: the smaller of the values of both faces; infinite if unknown.
[[nodiscard]] double wall_at_height(std::span<const render::RowWall> walls, double height_mm,
                                    double y_mm);

}  // namespace clay::studio
