#include "engine/tick/contact.hpp"

#include "engine/clay/packs.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>
#include <variant>

namespace clay {
namespace {

/// Equations (1), (2). Compared and clamped as doubles: a far pose must not overflow an index.
template <Model model>
bool candidates(const Tool& tool, const ClayStack& stack, double hip_y, Contact& contact) noexcept {
  const double count = static_cast<double>(stack.size());
  const double low = (hip_y + tool.low()) / stack.ring_height_mm();
  const double high = (hip_y + tool.high()) / stack.ring_height_mm();
  if (!(high > 0.0 && low < count)) return false;
  contact.top = static_cast<std::size_t>(std::min(count, std::ceil(high))) - 1;
  if constexpr (model == Model::paper) {
    contact.bottom = static_cast<std::size_t>(std::max(1.0, std::floor(low))) - 1;
    return true;
  }
  contact.bottom = static_cast<std::size_t>(std::max(0.0, low));
  // An end beyond the stack has no ring beyond it.
  contact.down_offset = std::max(low, 0.0) - static_cast<double>(contact.bottom) - 0.5;
  contact.up_offset = static_cast<double>(contact.top) + 0.5 - std::min(high, count);
  return true;
}

/// The ring whose walls are on both sides of the tool: the one at the tool's centre. If the place
/// of the hand is known, a centre in solid clay belongs to the bore through which the tool came:
/// the first one on the way to the hand, at most the height of the tool away. A centre beside a
/// solid ring is outside.
const Ring& ring_about(const Tool& tool, const ClayStack& stack, double hip_y, double axis_distance,
                       HandAt hand) noexcept {
  const auto rings = stack.rings();
  const double last = static_cast<double>(rings.size() - 1), h = stack.ring_height_mm();
  const auto ring_at = [=](double up) {
    return static_cast<std::size_t>(std::clamp(std::floor(up / h), 0.0, last));
  };
  const std::size_t at = ring_at(hip_y);
  if (hand == HandAt::unknown || rings[at].inner2 > 0 || axis_distance >= rings[at].outer_mm())
    return rings[at];
  const double reach = tool.high() - tool.low();
  const bool up = hand == HandAt::above;
  const std::size_t end = ring_at(up ? hip_y + reach : hip_y - reach);
  for (std::size_t i = at; i != end;) {
    i = up ? i + 1 : i - 1;
    if (rings[i].inner2 > 0) return rings[i];
  }
  return rings[at];
}

Side side_at(const Ring& ring, double axis_distance) noexcept {
  return axis_distance > 0.5 * (ring.outer_mm() + ring.inner_mm()) ? Side::compressive
                                                                   : Side::expansive;
}

/// The ring, met over from..to, counted from the HIP. It yields from the moment an end of the tool
/// passes its middle; the tool's advance is the rise of its surface since.
template <class Profile>
bool meet(const Profile& profile, const Tool& tool, const Ring& ring, double middle, double from,
          double to, const Contact& contact, RingContact& touch) noexcept {
  const double t = 0.5 * (from + to), rise = contact.rise_mm;
  const auto [f, facing] = profile.surface(t, to - from);
  touch.surface_mm = contact.side == Side::compressive ? ring.outer_mm() : ring.inner_mm();
  touch.depth_mm = depth_of(ring, f, contact);
  if (!(touch.depth_mm > 0.0)) return false;
  touch.facing = facing;
  touch.advance_mm = contact.approach_mm;
  if (rise == 0.0) return true;
  const double before = std::clamp(middle + rise, tool.low(), tool.high());
  if (before != middle + rise) touch.since = std::max((before - middle) / rise, 0.0);
  const double then = std::clamp(t + touch.since * rise, tool.low(), tool.high());
  touch.advance_mm = touch.since * contact.approach_mm + f - profile.radius(then);
  return true;
}

/// A ring at an end of the tool, or the crown, as far as the tool covers it. Returns whether it
/// touches.
template <class Profile>
bool meet_part(const Profile& profile, const Tool& tool, const ClayStack& stack, double middle,
               double from, double to, const Contact& contact, RingContact& part) noexcept {
  if (!(to > from)) return false;
  part.coverage = (to - from) / stack.ring_height_mm();
  return meet(profile, tool, stack.rings()[part.ring], middle, from, to, contact, part);
}

void add_edge(const RingContact& part, int end, Contact& contact) noexcept {
  contact.edge_end[contact.edge_count] = end;
  contact.edges[contact.edge_count++] = part;
}

/// As `meet`, for rings that the tool covers whole, and whose surface is known.
template <class Profile>
CLAYSTACK_INLINE inline void meet_rows(const Profile& profile, const Tool& tool, double hip_y,
                                       double h, const Contact& contact,
                                       const TouchedRings::Slice& slice) noexcept {
  const double low = tool.low(), high = tool.high(), d = contact.axis_distance_mm;
  const double rise = contact.rise_mm, approach = contact.approach_mm;
  const double outward = contact.side == Side::compressive ? 1.0 : -1.0;
  const double per_rise = std::abs(rise) > 1e-300 ? 1.0 / rise : 0.0;
  const double first = static_cast<double>(slice.ring) + 0.5;
  TouchedRings::Block& rows = slice.rows;
  // A sampled profile is not done in lanes.
  constexpr bool spare = !std::is_same_v<Profile, SampledProfile>;
  const std::size_t count = spare ? TouchedRings::with_spare(slice.size()) : slice.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = slice.begin + i;
    const double t = (first + kLevels[i]) * h - hip_y;
    const auto [f, facing] = profile.surface(t, h);
    const double depth = f + outward * (rows.surface[k] - d);
    rows.depth[k] = depth > 0.0 ? depth : 0.0;
    rows.coverage[k] = 1.0;
    rows.normal2[k] = facing.normal2;
    rows.lean[k] = facing.lean;
    rows.turn[k] = facing.turn;
    const double then = t + rise;
    const double above = then > low ? then : low, kept = above < high ? above : high;
    const double since = 1.0 - (then - kept) * per_rise;
    rows.since[k] = since;
    rows.advance[k] = since * approach + f - profile.radius(kept);
  }
}

template <class Profile>
void meet_slice(const Profile& profile, const Tool& tool, double hip_y, double h,
                const Contact& contact, const TouchedRings::Slice& slice) noexcept {
  in_lanes([&]() CLAYSTACK_INLINE { meet_rows(profile, tool, hip_y, h, contact, slice); });
}

/// Sphere or not: decided once, not for each ring.
template <bool sphere>
struct Round {
  const EllipseProfile& ellipse;
  [[nodiscard]] double radius(double t) const noexcept { return ellipse.radius(t); }
  [[nodiscard]] Surface surface(double t, double) const noexcept {
    return ellipse.surface_as<sphere>(t);
  }
};

void meet_slice(const EllipseProfile& ellipse, const Tool& tool, double hip_y, double h,
                const Contact& contact, const TouchedRings::Slice& slice) noexcept {
  if (ellipse.a == ellipse.b)
    meet_slice(Round<true>{ellipse}, tool, hip_y, h, contact, slice);
  else
    meet_slice(Round<false>{ellipse}, tool, hip_y, h, contact, slice);
}

/// Radii of the surface that the tool meets.
void measure_surfaces(std::span<const Ring> rings, bool outside, double* radii) noexcept {
  in_packs([=, from = rings.data(), count = rings.size()](auto n) CLAYSTACK_INLINE {
    std::size_t k = 0;
    for (; k + n <= count; k += n) {
      const RingPack<n> pack = load_rings<n>(from + k);
      store(radii + k, root(doubles_of(outside ? pack.outer2 : pack.inner2) * kMm2PerQuantum));
    }
    for (; k < count; ++k) radii[k] = outside ? from[k].outer_mm() : from[k].inner_mm();
  });
}

/// Rings first..end-1, each covered whole.
template <class Profile>
void touch_whole(const Profile& profile, const Tool& tool, const ClayStack& stack, double hip_y,
                 std::size_t first, std::size_t end, Contact& contact) noexcept {
  const bool outside = contact.side == Side::compressive;
  contact.rings.each_slice(first, end, [&](const TouchedRings::Slice& slice) {
    measure_surfaces(stack.rings().subspan(slice.ring, slice.size()), outside,
                     &slice.rows.surface[slice.begin]);
    meet_slice(profile, tool, hip_y, stack.ring_height_mm(), contact, slice);
  });
}

/// A ring that an end of the tool may be in.
template <class Profile>
void touch_end(const Profile& profile, const Tool& tool, const ClayStack& stack, double hip_y,
               std::size_t i, Contact& contact) noexcept {
  const double h = stack.ring_height_mm();
  const double t = (static_cast<double>(i) + 0.5) * h - hip_y;
  const double from = t - 0.5 * h, to = t + 0.5 * h;
  if (from >= tool.low() && to <= tool.high())
    return touch_whole(profile, tool, stack, hip_y, i, i + 1, contact);
  RingContact part{.ring = i};
  const bool touches = meet_part(profile, tool, stack, t, std::max(from, tool.low()),
                                 std::min(to, tool.high()), contact, part);
  const bool yields = t >= tool.low() && t <= tool.high();
  contact.rings.put(touches && yields ? part : RingContact{.ring = i});
  if (touches && !yields)
    add_edge(part, (to > tool.high() ? 1 : 0) - (from < tool.low() ? 1 : 0), contact);
}

template <class Profile>
void touch_rings(const Profile& profile, const Tool& tool, const ClayStack& stack, double hip_y,
                 Contact& contact) noexcept {
  touch_end(profile, tool, stack, hip_y, contact.bottom, contact);
  touch_whole(profile, tool, stack, hip_y, contact.bottom + 1, contact.top, contact);
  if (contact.top > contact.bottom) touch_end(profile, tool, stack, hip_y, contact.top, contact);
  if (contact.top + 1 < stack.size()) return;
  const double top = static_cast<double>(stack.size()) * stack.ring_height_mm() - hip_y;
  RingContact crown{.ring = contact.top};
  if (meet_part(profile, tool, stack, top, std::max(top, tool.low()),
                std::min(stack.height_mm() - hip_y, tool.high()), contact, crown))
    add_edge(crown, 0, contact);
}

/// As printed: each ring by its middle.
template <class Profile>
void touch_middles(const Profile& profile, const Tool& tool, const ClayStack& stack, double hip_y,
                   Contact& contact) noexcept {
  for (std::size_t i = contact.bottom; i <= contact.top; ++i) {
    RingContact touch{.ring = i};
    const double t = (static_cast<double>(i) + 0.5) * stack.ring_height_mm() - hip_y;
    if (t >= tool.low() && t <= tool.high()) {
      touch.depth_mm = std::max(depth_of(stack.rings()[i], profile.radius(t), contact), 0.0);
      touch.slope = profile.slope(t);
    }
    contact.rings.put(touch);
  }
}

template <Model model>
void touch_rings(const Tool& tool, const ClayStack& stack, double hip_y,
                 Contact& contact) noexcept {
  contact.rings.lay_out(contact.bottom, contact.top + 1);
  std::visit(
      [&](const auto& profile) {
        if constexpr (model == Model::paper)
          touch_middles(profile, tool, stack, hip_y, contact);
        else
          touch_rings(profile, tool, stack, hip_y, contact);
      },
      tool.profile());
  contact.rings.trim();
}

/// The tool's centre at `at` along the HIP's radius, and `before`; below 0 it is beyond the axis.
void stand(double at, double before, double radial_x, double radial_z, Contact& contact) noexcept {
  const double sense = at > 0.0 ? 1.0 : at < 0.0 ? -1.0 : 0.0;
  contact.axis_distance_mm = std::abs(at);
  contact.approach_mm = std::abs(before) - std::abs(at);
  contact.radial_x = sense * radial_x;
  contact.radial_z = sense * radial_z;
}

void clear(Contact& contact) noexcept {
  contact.rings.clear();
  contact.edge_count = 0;
  contact.has_front = false;
}

template <class Past>
void drop_if(Contact& contact, Past past) noexcept {
  for (std::size_t i = contact.rings.from(); i < contact.rings.to(); ++i)
    if (past(contact.rings.get(i))) contact.rings.depth(i) = 0.0;
  contact.rings.trim();
  for (std::size_t k = 0; k < contact.edge_count; ++k)
    if (past(contact.edges[k])) contact.edges[k].depth_mm = 0.0;
}

}  // namespace

std::size_t most_contacts(const Tool& tool, double ring_height_mm, std::size_t max_rings) {
  const double rings = (tool.high() - tool.low()) / ring_height_mm + 3.0;
  return static_cast<std::size_t>(std::min(rings, static_cast<double>(max_rings)));
}

template <Model model>
void find_contact(const Tool& tool, const ClayStack& stack, const glm::dvec3& hip_mm,
                  Contact& contact, const glm::dvec3& moved_mm, HandAt hand) noexcept {
  clear(contact);
  contact.rise_mm = moved_mm.y;
  const double d = std::sqrt(hip_mm.x * hip_mm.x + hip_mm.z * hip_mm.z);
  contact.axis_distance_mm = d;
  contact.radial_x = d > 0.0 ? hip_mm.x / d : 0.0;
  contact.radial_z = d > 0.0 ? hip_mm.z / d : 0.0;
  contact.side = side_at(ring_about(tool, stack, hip_mm.y, d, hand), d);
  if (!candidates<model>(tool, stack, hip_mm.y, contact)) return;
  const double x = hip_mm.x - moved_mm.x, z = hip_mm.z - moved_mm.z;
  const double way = std::sqrt(x * x + z * z) - d;
  contact.approach_mm = contact.side == Side::compressive ? way : -way;
  touch_rings<model>(tool, stack, hip_mm.y, contact);
}

template <Model model>
void find_pinch(const Tool& tool, const ClayStack& stack, const glm::dvec3& hip_mm, double gap_mm,
                Contact& outer, Contact& inner, const glm::dvec3& moved_mm) noexcept {
  clear(outer);
  clear(inner);
  const double d = std::sqrt(hip_mm.x * hip_mm.x + hip_mm.z * hip_mm.z);
  const double radial_x = d > 0.0 ? hip_mm.x / d : 0.0, radial_z = d > 0.0 ? hip_mm.z / d : 0.0;
  const double reach = 0.5 * gap_mm + tool.widest();
  const double x = hip_mm.x - moved_mm.x, z = hip_mm.z - moved_mm.z,
               before = std::sqrt(x * x + z * z);
  stand(d + reach, before + reach, radial_x, radial_z, outer);
  stand(d - reach, before - reach, radial_x, radial_z, inner);
  outer.side = Side::compressive;
  inner.side = Side::expansive;
  inner.approach_mm = -inner.approach_mm;
  outer.rise_mm = inner.rise_mm = moved_mm.y;
  if (!candidates<model>(tool, stack, hip_mm.y, outer)) return;
  candidates<model>(tool, stack, hip_mm.y, inner);
  touch_rings<model>(tool, stack, hip_mm.y, outer);
  touch_rings<model>(tool, stack, hip_mm.y, inner);
  // The depth is above 0 even if the tool is past the wall and clear of the ring.
  drop_if(outer, [&](const RingContact& touch) {
    const Ring& ring = stack.rings()[touch.ring];
    return 2.0 * outer.axis_distance_mm + touch.depth_mm - ring.outer_mm() <= ring.inner_mm();
  });
  drop_if(inner, [&](const RingContact& touch) {
    const Ring& ring = stack.rings()[touch.ring];
    return 2.0 * inner.axis_distance_mm - touch.depth_mm - ring.inner_mm() >= ring.outer_mm();
  });
}

template void find_contact<Model::paper>(const Tool&, const ClayStack&, const glm::dvec3&, Contact&,
                                         const glm::dvec3&, HandAt) noexcept;
template void find_contact<Model::conserving>(const Tool&, const ClayStack&, const glm::dvec3&,
                                              Contact&, const glm::dvec3&, HandAt) noexcept;
template void find_pinch<Model::paper>(const Tool&, const ClayStack&, const glm::dvec3&, double,
                                       Contact&, Contact&, const glm::dvec3&) noexcept;
template void find_pinch<Model::conserving>(const Tool&, const ClayStack&, const glm::dvec3&,
                                            double, Contact&, Contact&, const glm::dvec3&) noexcept;

}  // namespace clay
