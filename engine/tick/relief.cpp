#include "engine/tick/relief.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

constexpr double kSteepest = 2.0;
constexpr int kSamples = 512;  // of a profile

/// The cone at one end of a contact, as the clay's surface lies against it.
class Cone {
 public:
  Cone(const Overhang& overhang, const ClayStack& stack, const Band& band, const Contact& contact,
       bool up) noexcept
      : rings_(stack.rings()),
        h_(stack.ring_height_mm()),
        outside_(contact.side == Side::compressive),
        up_(up) {
    const double shoulder =
        overhang.hip_y + (up ? overhang.shoulders.high_mm : overhang.shoulders.low_mm);
    from_mm_ = up ? std::min(shoulder, band.high_mm) : std::max(shoulder, band.low_mm);
    // The clay is as deep in the tool there as in the nearest ring before the shoulder.
    const double level = from_mm_ / h_ - 0.5;
    const double first = static_cast<double>(contact.rings.from());
    const double last = static_cast<double>(contact.rings.to() - 1);
    const double ring = std::clamp(up ? std::floor(level) : std::ceil(level), first, last);
    if (up ? ring > level : ring < level) from_mm_ = (ring + 0.5) * h_;
    beside_ = static_cast<std::size_t>(ring);
    const double out =
        overhang.tool.radius(from_mm_ - overhang.hip_y) - contact.rings.get(beside_).depth_mm;
    base_mm_ = outside_ ? contact.axis_distance_mm - out : contact.axis_distance_mm + out;
  }

  /// The last ring before the cone; where it is the last of all, there is none.
  [[nodiscard]] std::size_t beside() const noexcept { return beside_; }

  /// How far a surface stands out into the cone.
  [[nodiscard]] double excess(std::size_t ring, double surface_mm) const noexcept {
    const double middle = (static_cast<double>(ring) + 0.5) * h_;
    const double way = up_ ? middle - from_mm_ : from_mm_ - middle;
    return (outside_ ? surface_mm - base_mm_ : base_mm_ - surface_mm) - kSteepest * way;
  }
  [[nodiscard]] double excess(std::size_t ring) const noexcept {
    const Ring& there = rings_[ring];
    if (!outside_ && there.inner2 == 0) return 0.0;
    return excess(ring, outside_ ? there.outer_mm() : there.inner_mm());
  }
  [[nodiscard]] bool next(std::size_t& ring) const noexcept {
    if (up_ ? ring + 1 >= rings_.size() : ring == 0) return false;
    ring = up_ ? ring + 1 : ring - 1;
    return true;
  }

 private:
  std::span<const Ring> rings_;
  double h_;
  bool outside_, up_;
  double from_mm_ = 0.0, base_mm_ = 0.0;
  std::size_t beside_ = 0;
};

/// How far a wall gives way that stands out by `out`: d out / dt = -kappa (R - r) min(1, out /
/// yield depth), by a step that cannot go too far.
double yielded(const RemovalPlan& plan, double dt_s, double wall_mm, double out) noexcept {
  const double z = plan.rate_per_s * wall_mm * dt_s / std::max(plan.yield_depth_mm, out);
  return std::min(out * z / (1.0 + z), std::max(wall_mm - plan.min_wall_mm, 0.0));
}

Quanta taken(const Ring& ring, double by, bool outside) noexcept {
  const double surface = outside ? ring.outer_mm() : ring.inner_mm();
  const Quanta asked = quanta_from_mm2(by * (2.0 * surface + (outside ? -by : by)));
  static const Quanta smallest = quanta_from_radius(kMinRadiusMm);
  const Quanta spare =
      outside ? ring.outer2 - std::max(ring.inner2 + 1, smallest) : ring.volume() - 1;
  return std::clamp<Quanta>(asked, 0, std::max<Quanta>(spare, 0));
}

double end_of(const Tool& tool, bool up) {
  const auto steep = [&](double t) { return (up ? -tool.slope(t) : tool.slope(t)) > kSteepest; };
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

/// A ring as a shift and what is removed leave it.
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

Shoulders shoulders_of(const Tool& tool) { return {end_of(tool, false), end_of(tool, true)}; }

void relieve_touched(const Overhang& overhang, const ClayStack& stack, const Band& band,
                     const Squeeze& squeeze, std::span<ToolRemoval> removals,
                     std::size_t tool) noexcept {
  const Contact& contact = removals[tool].contact;
  TouchedRings& rings = removals[tool].contact.rings;
  const bool outside = contact.side == Side::compressive;
  const double h = stack.ring_height_mm(), d = contact.axis_distance_mm;
  for (const bool up : {true, false}) {
    if (up ? band.high_mm <= overhang.hip_y + overhang.shoulders.high_mm
           : band.low_mm >= overhang.hip_y + overhang.shoulders.low_mm)
      continue;
    const Cone cone(overhang, stack, band, contact, up);
    for (std::size_t i = cone.beside(); cone.next(i) && rings.has(i);) {
      double& depth = rings.depth(i);
      if (!(depth > 0.0)) continue;
      const double f = overhang.tool.radius((static_cast<double>(i) + 0.5) * h - overhang.hip_y);
      const double out = cone.excess(i, outside ? d - f + depth : d + f - depth);
      const Ring ring = left_of(i, stack, squeeze, removals);
      if (!(out > 0.0) || (!outside && ring.inner2 == 0)) continue;
      const double wall = wall_mm(ring);
      const double by = yielded(overhang.plan, overhang.dt_s, wall, out);
      removals[tool].removed[i - rings.from()] += taken(ring, by, outside);
      depth = std::max(depth - by, 0.0);
    }
  }
}

bool overhangs(const Overhang& overhang, const ClayStack& stack, const Band& band,
               const Contact& contact, bool up) noexcept {
  std::size_t ring = up ? contact.rings.to() - 1 : contact.rings.from();
  const Cone cone(overhang, stack, band, contact, up);
  return cone.next(ring) && cone.excess(ring) > 0.0;
}

WideQuanta relieve_beyond(const Overhang& overhang, const ClayStack& stack, const Band& band,
                          const Contact& contact, StackWriter& writer) noexcept {
  const bool outside = contact.side == Side::compressive;
  const double reach = kReliefMm / stack.ring_height_mm();
  WideQuanta total = 0;
  for (const bool up : {true, false}) {
    const Cone cone(overhang, stack, band, contact, up);
    std::size_t ring = up ? contact.rings.to() - 1 : contact.rings.from();
    for (double k = 1.0; k <= reach && cone.next(ring); k += 1.0) {
      const double out = cone.excess(ring);
      if (!(out > 0.0)) break;
      const Ring& there = stack.rings()[ring];
      const double wall = wall_mm(there);
      const Quanta amount = taken(there, yielded(overhang.plan, overhang.dt_s, wall, out), outside);
      if (outside)
        writer.take_outside(ring, amount);
      else
        writer.take_inside(ring, amount);
      total += amount;
    }
  }
  return total;
}

}  // namespace clay
