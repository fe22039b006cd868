#include "engine/tick/rim_press.hpp"

#include "engine/tick/shell.hpp"
#include "engine/tick/shift.hpp"

#include <algorithm>

namespace clay {
namespace {

/// The part of the tool's motion that presses the rim down: all of it where the tool's axis is over
/// the wall. Beside the wall it is the square of the vertical part of the normal, of an ellipsoid
/// at the edge of the rim, and less if the tool moves along the wall or up. A tool whose middle has
/// come down to the rim presses it down only over the wall, and if it moves mainly down. A tool
/// inside of clay that is nearly solid opens it instead.
double part_down(const Tool& tool, const Motion& motion, const ClayStack& stack, double hip_y,
                 const Contact& contact) noexcept {
  const Ring& top = stack.rings().back();
  const double d = contact.axis_distance_mm;
  const double beyond_mm = std::max({d - top.outer_mm(), top.inner_mm() - d, 0.0});
  const double beyond = beyond_mm / tool.widest(), level = beyond * beyond;
  if (!(level < 1.0)) return 0.0;
  const double high = 0.5 * (tool.high() - tool.low());
  const double deep = (stack.height_mm() - (hip_y + tool.low())) / high;
  const double above = std::clamp(2.0 - 2.0 * deep, 0.0, 1.0);
  const double sinks = std::min(motion.upward_mm_s, 0.0), rises = motion.upward_mm_s - sinks;
  const double down2 = sinks * sinks + kSlowMmS * kSlowMmS;
  const double other2 = rises * rises + motion.outward_mm_s * motion.outward_mm_s;
  const double from_above = down2 / (down2 + level * other2);
  const double mainly_down = down2 > other2 ? 1.0 : down2 / other2;
  const double in_clay = mainly_down * std::max(1.0 - 4.0 * beyond, 0.0);
  const double opens = contact.side == Side::expansive ? 1.0 - pliancy(top) : 0.0;
  return (1.0 - opens) * (1.0 - level) * (above * from_above + (1.0 - above) * in_clay);
}

/// The part of a ring's section that the tool covers, as R^2 - r^2 [mm^2].
double covered_mm2(const Ring& ring, double radius_mm, double axis_distance_mm) noexcept {
  const double outer = std::min(ring.outer_mm(), axis_distance_mm + radius_mm);
  const double inner = std::max(ring.inner_mm(), axis_distance_mm - radius_mm);
  return outer > inner ? outer * outer - inner * inner : 0.0;
}

}  // namespace

RimPress press_rim(const Tool& tool, const Motion& motion, const ClayStack& stack, double hip_y,
                   Contact& contact) noexcept {
  if (contact.rings.to() != stack.size()) return {};
  const double d = contact.axis_distance_mm, part = part_down(tool, motion, stack, hip_y, contact);
  if (!(part > 0.0)) return {};
  const double outward = contact.side == Side::compressive ? 1.0 : -1.0;
  double mm2 = 0.0;
  contact.rings.each_slice([&](const TouchedRings::Slice& slice) {
    for (std::size_t k = slice.begin, i = slice.ring; k < slice.end; ++k, ++i) {
      const double depth = slice.rows.depth[k];
      if (!(depth > 0.0)) continue;
      const double radius = depth - outward * (slice.rows.surface[k] - d);
      double& give = slice.rows.give[k];
      mm2 += give / depth * covered_mm2(stack.rings()[i], radius, d);
      give *= 1.0 - part;
    }
  });
  return {1.0 - part, static_cast<WideQuanta>(part * mm2 * kQuantaPerMm2)};
}

void limit_to_rim(const ClayStack& stack, RimPress& press) noexcept {
  const auto rings = stack.rings();
  WideQuanta found = stack.crown();
  std::size_t i = rings.size();
  for (std::size_t k = 0; k < kMostSunk && found < press.down && --i > 0; ++k)
    found += rings[i].volume();
  press.down = std::clamp<WideQuanta>(press.down, 0, std::max<WideQuanta>(found, 0));
}

}  // namespace clay
