#include "export/job/prepare.hpp"

#include "claystack/engine/clay.hpp"
#include "core/text.hpp"
#include "export/section/stack_section.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid::inline job {
namespace {

Quanta times(Quanta count, double factor) {
  return static_cast<Quanta>(std::llround(factor * static_cast<double>(count)));
}

/// Scales one ring; a wall of a few quanta keeps at least one.
Ring times(const Ring& ring, double factor) {
  Ring larger{times(ring.outer2, factor), times(ring.inner2, factor)};
  if (larger.inner2 >= larger.outer2) larger.inner2 = larger.outer2 - 1;
  return larger;
}

/// The crown keeps its fraction of a ring in spite of the rounding of that ring. It exceeds a ring
/// where the stack has no room for another.
WideQuanta crown_of(const ClayStack& stack, const Ring& larger_top) {
  const Quanta top = stack.rings().back().volume(), larger = larger_top.volume();
  const double part = static_cast<double>(stack.crown()) / static_cast<double>(top);
  const auto crown = static_cast<WideQuanta>(std::nearbyint(part * static_cast<double>(larger)));
  return stack.crown() < top ? std::min(crown, static_cast<WideQuanta>(larger) - 1) : crown;
}

/// Number of rings below the bottom of the uppermost closed cavity; 0 if there is none.
std::size_t rings_to_drill(const ClayStack& stack) {
  std::size_t rings = 0;
  for (const PieceShape& shape : shapes_of(stack))
    for (const Cavity& cavity : shape.cavities)
      rings = static_cast<std::size_t>(cavity.bottom_mm / stack.ring_height_mm() + 0.5);
  return rings;
}

}  // namespace

Result<Pot> scaled(const Pot& pot, double radius_factor, double height_factor) {
  // Before multiplying: quanta of larger radii may not fit into 64 bits.
  if (const double radius_mm = radius_factor * largest_radius_mm(pot.stack);
      !(radius_mm <= kMaxRadiusMm))
    return failure(ErrorKind::bad_input, "expected a diameter of at most " +
                                             nine_digit_text(2.0 * kMaxRadiusMm) + " mm, found " +
                                             nine_digit_text(2.0 * radius_mm) + " mm");
  std::vector<Ring> rings;
  rings.reserve(pot.stack.size());
  // A double holds the quanta of radii up to 362 mm exactly; beyond, it loses far less than a mesh
  // file.
  for (const Ring& ring : pot.stack.rings())
    rings.push_back(times(ring, radius_factor * radius_factor));
  const WideQuanta crown = crown_of(pot.stack, rings.back());
  return ClayStack::from_rings(pot.stack.ring_height_mm() * height_factor, std::move(rings), crown,
                               pot.stack.max_rings())
      .map([&](ClayStack stack) {
        Pot larger = pot;
        larger.stack = std::move(stack);
        larger.rim = {};
        larger.ledger = {.initial = larger.stack.volume()};
        larger.rounding.reset();
        return larger;
      });
}

Result<Pot> enlarged(const Pot& pot, double shrinkage) {
  if (auto valid = check_range(kShrinkageRange, shrinkage); !valid)
    return tl::make_unexpected(valid.error());
  if (shrinkage == 0.0) return pot;
  const double factor = enlargement(shrinkage);
  return scaled(pot, factor, factor)
      .map_error([](const Error& error) {
        return Error{error.kind, "enlarged for its shrinkage: " + error.message};
      })
      .map([&](Pot larger) {
        if (larger.collapse) {
          larger.collapse->pivot_mm *= factor;
          larger.collapse->shift_mm *= factor;
        }
        return larger;
      });
}

Result<DrainedStack> drain(const ClayStack& stack, double diameter_mm) {
  const std::size_t depth = rings_to_drill(stack);
  if (depth == 0)
    return failure(ErrorKind::bad_input, "drain: expected a closed cavity, found none");
  const Quanta hole2 = quanta_from_radius(0.5 * diameter_mm);
  std::vector<Ring> rings(stack.rings().begin(), stack.rings().end());
  for (std::size_t i = 0; i < depth; ++i) {
    if (rings[i].outer2 <= hole2)
      return failure(ErrorKind::bad_input,
                     "drain: expected a hole narrower than ring " + std::to_string(i) + " (" +
                         nine_digit_text(2.0 * rings[i].outer_mm()) + " mm), found " +
                         nine_digit_text(diameter_mm) + " mm");
    rings[i].inner2 = std::max(rings[i].inner2, hole2);
  }
  return ClayStack::from_rings(stack.ring_height_mm(), std::move(rings), stack.crown(),
                               stack.max_rings())
      .map([&](ClayStack drained) {
        const double drilled =
            static_cast<double>(stack.volume() - drained.volume()) * stack.mm3_per_quantum();
        return DrainedStack{std::move(drained), drilled};
      });
}

Result<PreparedPot> prepare(const Pot& pot, const ExportOptions& options) {
  if (options.drain_mm && pot.collapse)
    return failure(ErrorKind::bad_input, "drain: expected a standing pot, found a collapsed one");
  ClayFigures clay = options.clay;
  clay.shrinkage = options.shrinkage;
  return enlarged(pot, options.shrinkage)
      .and_then([&](Pot larger) {
        clay.density_g_cm3 = larger.density_g_cm3;
        return clay.check().map([&] { return std::move(larger); });
      })
      .and_then([&](Pot larger) -> Result<PreparedPot> {
        PreparedPot prepared{std::move(larger), {.shrinkage = options.shrinkage}, std::nullopt};
        if (!options.drain_mm) return prepared;
        return drain(prepared.pot.stack, *options.drain_mm).map([&](DrainedStack drained) {
          prepared.pot.stack = std::move(drained.stack);
          prepared.done.drain_mm = *options.drain_mm;
          prepared.done.drilled_mm3 = drained.drilled_mm3;
          return std::move(prepared);
        });
      })
      .map([&](PreparedPot prepared) {
        const ClayStack& stack = prepared.pot.stack;
        prepared.done.counted_volume_mm3 = stack.volume_mm3();
        prepared.limit = options.walls.for_size(
            size_sum_mm(round_size_mm(2.0 * largest_radius_mm(stack), stack.height_mm())));
        return prepared;
      });
}

}  // namespace clay::solid::inline job
