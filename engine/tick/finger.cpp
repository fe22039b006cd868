#include "engine/tick/finger.hpp"

#include "engine/tick/relief.hpp"

#include <algorithm>
#include <cstddef>

namespace clay {

Finger finger_of(const StepPlan& plan, const ToolState& tool, const ClayStack& stack,
                 const Contact& contact) noexcept {
  if (!(plan.clay.finger_mm > 0.0) || contact.side != Side::expansive) return {};
  const double from = tool.hip_mm.y, to = from + plan.clay.finger_mm;
  const double widest = plan.tool.widest();
  const double bore = contact.axis_distance_mm - plan.clay.finger_behind * widest;
  if (!(bore > 0.0)) return {};
  // In a tick at the speed of a hand a wall grows by far less than this, so most bores are clear of
  // the finger. The next tick removes the clay that a longer tick lays into the finger.
  constexpr double kNearMm = 5.0;
  const Quanta near = quanta_from_radius(bore + kNearMm);
  const auto rings = stack.rings();
  const double above = std::max(to / stack.ring_height_mm(), 0.0);
  const auto end = static_cast<std::size_t>(std::min(above, static_cast<double>(rings.size())));
  const std::size_t begin = std::min(contact.rings.to(), end);
  if (std::none_of(rings.begin() + static_cast<std::ptrdiff_t>(begin),
                   rings.begin() + static_cast<std::ptrdiff_t>(end),
                   [near](const Ring& ring) { return ring.inner2 < near; }))
    return {};
  return {from, to, bore, widest};
}

void relieve_finger(const StepPlan& plan, const Finger& finger, const ClayStack& stack, double dt_s,
                    const Contact& contact, StackWriter& writer, LooseClay& loose) noexcept {
  const double h = stack.ring_height_mm();
  for (std::size_t i = contact.rings.to(); i < stack.size(); ++i) {
    const Ring& ring = stack.rings()[i];
    const double middle = (static_cast<double>(i) + 0.5) * h, bore = finger.bore_at(middle);
    if (!(middle < finger.to_mm && bore > 0.0) || ring.inner2 == 0) break;
    // Most rings are clear of it, which needs no root.
    if (static_cast<double>(ring.inner2) * kMm2PerQuantum >= bore * bore) continue;
    double out = bore - ring.inner_mm();
    const Quanta all = yielded(plan.removal, dt_s, ring, false, out);
    const double part = finger.part(wall_mm(ring));
    const auto amount = static_cast<Quanta>(part * static_cast<double>(all));
    writer.take_inside(i, amount);
    loose.add(amount, ring);
  }
}

}  // namespace clay
