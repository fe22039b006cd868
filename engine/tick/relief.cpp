#include "engine/tick/relief.hpp"

#include "engine/clay/in_place.hpp"
#include "engine/tick/shell.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

constexpr int kSamples = 512;       // of a profile
constexpr double kCutStepMm = 1.0;  // height of the step that a cutter may leave

Cone cone_of(const Tool& tool, const Shoulders& shoulders, double h, double hip_y, const Band& band,
             const Contact& contact, bool up, double step_mm) noexcept {
  Cone cone{.outside = contact.side == Side::compressive, .up = up};
  const double shoulder = hip_y + (up ? shoulders.high_mm : shoulders.low_mm);
  const double from = up ? std::min(shoulder, band.high_mm) : std::max(shoulder, band.low_mm);
  const double level = from / h - 0.5;
  const double first = static_cast<double>(contact.rings.from());
  const double last = static_cast<double>(contact.rings.to() - 1);
  const double ring = std::clamp(up ? std::floor(level) : std::ceil(level), first, last);
  const bool before = up ? ring > level : ring < level;
  cone.from_mm = before ? (ring + 0.5) * h : from;
  cone.beside = static_cast<std::size_t>(ring);
  // On the tool, not on the clay: a ring that an end has just entered still projects far. Rounding
  // must not put an end beyond the tool.
  const double out = tool.radius(std::clamp(cone.from_mm - hip_y, tool.low(), tool.high()));
  cone.base_mm = contact.axis_distance_mm + (cone.outside ? step_mm - out : out - step_mm);
  return cone;
}

bool next(std::size_t& ring, bool up, std::size_t size) noexcept {
  if (up ? ring + 1 >= size : ring == 0) return false;
  ring = up ? ring + 1 : ring - 1;
  return true;
}

double excess(const Cone& cone, const Ring& ring, double middle_mm) noexcept {
  if (!cone.outside && ring.inner2 == 0) return 0.0;
  return cone.excess(middle_mm, cone.outside ? ring.outer_mm() : ring.inner_mm());
}

double end_of(const Tool& tool, bool up) {
  const auto steep = [&](double t) { return (up ? -tool.slope(t) : tool.slope(t)) > kReliefSlope; };
  const double end = up ? tool.high() : tool.low(),
               step = (tool.low() + tool.high() - 2.0 * end) / kSamples;
  int k = 0;
  while (k < kSamples && steep(end + k * step)) ++k;
  if (k == 0) return end;
  double in = end + k * step, out = in - step;
  for (int pass = 0; pass < 40; ++pass) {
    const double middle = 0.5 * (in + out);
    (steep(middle) ? out : in) = middle;
  }
  return in;
}

/// Part of a ring's way in a cone that it goes as a wall: all of a thin wall, none of solid clay.
/// Solid clay below holds the wall that stands on it, and clay that was heaped on the ring is
/// squeezed out of it: it would go back and forth between heave and the cone.
double bent_part(const Cone& cone, std::span<const Ring> rings, double h, double foot_mm,
                 std::size_t i, double out) noexcept {
  constexpr double kAheadMm = 2.0, kHeapSlope = 0.1;  // thickness over height
  const Ring& ring = rings[i];
  const double wall = wall_mm(ring);
  const double above = ((static_cast<double>(i) + 0.5) * h - foot_mm) / (0.5 * wall);
  const double held = smooth(std::clamp(above, 0.0, 1.0));
  const auto ahead = static_cast<std::size_t>(std::max(1.0, std::round(kAheadMm / h)));
  const Ring& beyond =
      rings[cone.up ? std::min(i + ahead, rings.size() - 1) : i - std::min(i, ahead)];
  const double heaped = beyond.inner2 > 0
                            ? wall - wall_mm(beyond) - kHeapSlope * static_cast<double>(ahead) * h
                            : 0.0;
  return pliancy(ring) * held * std::clamp(1.0 - heaped / out, 0.0, 1.0);
}

/// Clay that leaves a ring on the pressed side, and the part of it that goes to its other side.
struct Yield {
  Quanta taken = 0, kept = 0;
};

/// Of a ring outside of which a cone projects by `out` [mm], and whose part `bent` is above 0. It
/// keeps the clay of that part, but for half of its hoop strain. The rest is squeezed out, and
/// leaves the minimum wall.
Yield bend_ring(const StepPlan& plan, const Ring& ring, double bent, double dt_s,
                double out) noexcept {
  constexpr double kMostOfBore = 0.25;  // in one tick
  RemovalPlan removal = plan.removal;
  const double wall = wall_mm(ring), spare = std::max(wall - removal.min_wall_mm, 0.0);
  removal.min_wall_mm = bent < 1.0 ? wall - spare / (1.0 - bent) : 0.0;
  const double outer2 = static_cast<double>(ring.outer2), inner2 = static_cast<double>(ring.inner2);
  const bool hoop = (plan.clay.rules & kHoop) != 0;
  const double keeps = bent * (1.0 - (hoop ? 0.5 * (outer2 - inner2) / (outer2 + inner2) : 0.0));
  Quanta taken = yielded(removal, dt_s, ring, true, out);
  if (keeps * static_cast<double>(taken) > kMostOfBore * inner2)
    taken = static_cast<Quanta>(kMostOfBore * inner2 / keeps);
  return {taken, static_cast<Quanta>(keeps * static_cast<double>(taken))};
}

/// Height of the solid clay or the wheel head on which the wall of a contact stands [mm]; very low
/// if it is far below.
double foot_of(const ClayStack& stack, const Contact& contact) noexcept {
  const double h = stack.ring_height_mm();
  std::size_t i = contact.rings.from();
  for (double down = 0.0; down <= 2.0 * kReliefMm / h; down += 1.0, --i) {
    if (pliancy(stack.rings()[i]) <= 0.0) return static_cast<double>(i + 1) * h;
    if (i == 0) return 0.0;
  }
  return -1e300;
}

/// A ring after the shift and the removal.
Ring left_of(std::size_t i, const ClayStack& stack, const Squeeze& squeeze,
             std::span<const ToolRemoval> removals) noexcept {
  Ring ring = squeeze.ring(i, stack.rings());
  for (const auto& [contact, removed] : removals) {
    if (!contact.rings.has(i)) continue;
    const Quanta gone = removed[i - contact.rings.from()];
    if (contact.side == Side::compressive)
      ring.outer2 -= gone;
    else
      ring.inner2 += gone;
  }
  return ring;
}

}  // namespace

Quanta yielded(const RemovalPlan& plan, double dt_s, const Ring& ring, bool outside,
               double& out) noexcept {
  const double outer = ring.outer_mm(), inner = ring.inner_mm(), wall = outer - inner;
  const double z = plan.rate_per_s * wall * dt_s / std::max(plan.yield_depth_mm, out);
  out = std::min(out * z / (1.0 + z), std::max(wall - plan.min_wall_mm, 0.0));
  return outside ? take_outside(ring, outer, out) : take_inside(ring, inner, out);
}

Shoulders shoulders_of(const Tool& tool) { return {end_of(tool, false), end_of(tool, true)}; }

std::array<Cone, 2> relieve_touched(const StepPlan& plan, const Shoulders& shoulders,
                                    const ClayStack& stack, const ToolState& tool, const Band& band,
                                    const Squeeze& squeeze, std::span<ToolRemoval> removals,
                                    std::size_t which, bool trim) noexcept {
  Contact& contact = removals[which].contact;
  TouchedRings& rings = contact.rings;
  const double h = stack.ring_height_mm(), d = contact.axis_distance_mm, hip_y = tool.hip_mm.y;
  std::array<Cone, 2> cones;
  for (const bool up : {false, true}) {
    Cone& cone = cones[up ? 1 : 0];
    make_in_place(cone, [&] {
      return cone_of(plan.tool, shoulders, h, hip_y, band, contact, up, trim ? kCutStepMm : 0.0);
    });
    std::size_t i = cone.beside;
    while (next(i, up, stack.size()) && rings.has(i)) {
      double& depth = rings.depth(i);
      if (!(depth > 0.0)) continue;
      const double middle = (static_cast<double>(i) + 0.5) * h;
      const double in = plan.tool.radius(middle - hip_y) - depth;
      double out = cone.excess(middle, cone.outside ? d - in : d + in);
      if (!(out > 0.0)) continue;
      const Ring ring = left_of(i, stack, squeeze, removals);
      if (!cone.outside && ring.inner2 == 0) continue;
      removals[which].removed[i - rings.from()] +=
          yielded(plan.removal, tool.dt_s, ring, cone.outside, out);
      depth = std::max(depth - out, 0.0);
    }
    cone.meets =
        !rings.has(i) && excess(cone, stack.rings()[i], (static_cast<double>(i) + 0.5) * h) > 0.0;
  }
  return cones;
}

std::size_t relieve_beyond(const StepPlan& plan, const Cone& cone, const ClayStack& stack,
                           double dt_s, const Contact& contact, bool bends, StackWriter& writer,
                           LooseClay& loose) noexcept {
  std::size_t yielding = 0;
  const double h = stack.ring_height_mm(), reach = kReliefMm / h;
  const double foot_mm = bends ? foot_of(stack, contact) : 0.0;
  std::size_t i = cone.up ? contact.rings.to() - 1 : contact.rings.from();
  for (double k = 1.0; k <= reach && next(i, cone.up, stack.size()); k += 1.0) {
    const Ring& ring = stack.rings()[i];
    double out = excess(cone, ring, (static_cast<double>(i) + 0.5) * h);
    if (!(out > 0.0)) break;
    ++yielding;
    const double bent = bends ? bent_part(cone, stack.rings(), h, foot_mm, i, out) : 0.0;
    const auto [taken, kept] = bent > 0.0
                                   ? bend_ring(plan, ring, bent, dt_s, out)
                                   : Yield{yielded(plan.removal, dt_s, ring, cone.outside, out), 0};
    if (kept > 0) writer.gain(writer.put_inside(i, kept));
    if (cone.outside)
      writer.take_outside(i, taken);
    else
      writer.take_inside(i, taken);
    loose.add(taken - kept, ring);
  }
  return yielding;
}

}  // namespace clay
