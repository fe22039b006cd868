#include "engine/clay/stack_writer.hpp"
#include "engine/wheel/wheel_state.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>

namespace clay {
namespace {

// From the axis, where there is no bore: counts as through.
constexpr double kThroughMm = 2.0;

/// Whether a point at this height is beyond the wall, seen from outside.
bool through_wall(const Ring& ring, const glm::dvec3& hip_mm) noexcept {
  const double d = std::sqrt(hip_mm.x * hip_mm.x + hip_mm.z * hip_mm.z);
  return d <= std::max(ring.inner_mm(), kThroughMm);
}

/// The tick of a needle or a wire. It cuts once, between the nearest rings, when the HIP goes
/// through the wall. At least one ring stays.
template <bool probes>
StepReport cut(WheelState& s, const Pose& pose) noexcept {
  StepReport report;
  ToolTracker tracker = s.tracker;
  const ToolState tool = tracker.advance(pose, kFarthestMm);
  if constexpr (!probes) s.tracker = tracker;
  report.flags = (tool.valid ? 0u : kRefused) | (tool.dt_clamped ? kLongStep : 0u);
  const auto rings = s.stack.rings();
  const double level = tool.hip_mm.y / s.stack.ring_height_mm();
  if (!tool.valid || !(level >= 0.0 && level < static_cast<double>(rings.size()))) return report;
  const Ring& ring = rings[static_cast<std::size_t>(level)];
  const glm::dvec3 &now = tool.hip_mm, before = now - tool.moved_mm;
  const double from_axis_mm2 = now.x * now.x + now.z * now.z;
  if (from_axis_mm2 >= mm2_from_quanta(ring.outer2)) return report;
  if (from_axis_mm2 >= mm2_from_quanta(ring.inner2)) {  // not in the bore
    report.flags |= kContact;
    report.rings_touched = 1;
  }
  if constexpr (probes) return report;
  const auto at = static_cast<std::size_t>(level + 0.5);
  if (!through_wall(ring, now) || through_wall(ring, before) || at == 0 || at >= rings.size())
    return report;
  StackWriter writer(s.stack);
  s.ledger.trimmed += s.plan.mode == ToolMode::needle ? writer.cut_above(at) : writer.cut_below(at);
  s.rim = {};
  report.flags |= kContact | kCut;
  report.rings_touched = 1;
  return report;
}

}  // namespace

Tick cut_tick() noexcept { return {&cut<false>, &cut<true>}; }

}  // namespace clay
