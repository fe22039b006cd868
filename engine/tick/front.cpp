#include "engine/tick/front.hpp"

#include "engine/clay/portable_math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <variant>

namespace clay {
namespace {

/// The values of a ring that the front may change; none where the tool does not touch it.
struct Felt {
  double* depth_mm = nullptr;
  double* coverage = nullptr;
};

/// The ring, if it yields.
Felt felt_of(Contact& contact, std::size_t ring) noexcept {
  if (!contact.rings.has(ring)) return {};
  return {&contact.rings.depth(ring), &contact.rings.coverage(ring)};
}

void level_edges(Contact& contact) noexcept {
  for (std::size_t k = 0; k < contact.edge_count; ++k) {
    const int end = contact.edge_end[k];
    const std::size_t ring = contact.edges[k].ring - static_cast<std::size_t>(end);  // modulo 2^64
    const Felt next = felt_of(contact, ring);
    double& depth = contact.edges[k].depth_mm;
    depth = next.depth_mm != nullptr ? std::min(depth, *next.depth_mm) : end == 0 ? depth : 0.0;
  }
}

/// An end of the tool in the clay, and the clay ahead of it.
struct End {
  bool up = false;          ///< the upper end of the tool; false: the lower one
  std::size_t ring = 0;     ///< the ring that contains the end
  double covered_mm = 0.0;  ///< of it
  double ahead_mm = 0.0;    ///< depth of the end in the clay ahead
  double wall_mm = 0.0;     ///< R - r there
};

/// The end that leads.
struct Lead : End {
  double decay = 0.0;  ///< kappa over the speed of the end [1/mm]

  /// Way of the end until a depth has yielded [mm], by the logarithmic mean of the wall.
  [[nodiscard]] double way_to_yield(double depth_mm, double min_wall_mm) const noexcept {
    const double middle = std::max(wall_mm - 0.5 * depth_mm, min_wall_mm);
    const double square = middle * middle;
    const double mean =
        std::max(square - depth_mm * depth_mm * (1.0 / 12.0), 0.5 * square);  // * middle
    return depth_mm * middle / (decay * mean);
  }
};

/// Whether there is clay ahead of `end.up`.
bool find_end(const Tool& tool, const ClayStack& stack, double hip_y, const Contact& contact,
              End& end) noexcept {
  const double h = stack.ring_height_mm();
  const double end_t = end.up ? tool.high() : tool.low(), level = (hip_y + end_t) / h;
  if (!(level > 0.0 && level < static_cast<double>(stack.size()))) return false;
  end.ring = static_cast<std::size_t>(level);
  const double part = level - static_cast<double>(end.ring);
  const double covered = end.up ? part : 1.0 - part;
  end.covered_mm = covered * h;
  std::size_t ahead = end.ring;
  if (covered >= 0.5) {
    if (end.up ? ahead + 1 >= stack.size() : ahead == 0) return false;
    ahead = end.up ? ahead + 1 : ahead - 1;
  }
  const Ring& ring = stack.rings()[ahead];
  end.ahead_mm = depth_of(ring, tool.radius(end_t), contact);
  end.wall_mm = wall_mm(ring);
  return end.ahead_mm > 0.0;
}

/// Whether an end leads into clay that yields. `rise_mm`: of the tool in `dt_s`.
bool find_lead(const StepPlan& plan, const ClayStack& stack, double hip_y, double dt_s,
               double rise_mm, const Contact& contact, Lead& lead) noexcept {
  lead.up = rise_mm > 0.0;
  if (rise_mm == 0.0 || !find_end(plan.tool, stack, hip_y, contact, lead)) return false;
  lead.decay = plan.removal.rate_per_s * dt_s / std::abs(rise_mm);
  return lead.wall_mm > plan.removal.min_wall_mm;
}

/// The ring that the lead is in, and the one behind it.
std::array<Felt, 2> rings_at(const Lead& lead, Contact& contact) noexcept {
  std::array<Felt, 2> rings{felt_of(contact, lead.ring),
                            felt_of(contact, lead.up ? lead.ring - 1 : lead.ring + 1)};
  for (std::size_t k = 0; rings[0].depth_mm == nullptr && k < contact.edge_count; ++k)
    if (contact.edge_end[k] == (lead.up ? 1 : -1))
      rings[0] = {&contact.edges[k].depth_mm, &contact.edges[k].coverage};
  return rings;
}

/// A ring that yields late, as a whole, has really yielded, like the one behind it.
void yield_in_time(const StepPlan& plan, const Lead& lead, std::array<Felt, 2>& rings,
                   Contact& contact) noexcept {
  const double* const behind = felt_of(contact, lead.up ? lead.ring - 2 : lead.ring + 2).depth_mm;
  const double yielded = std::max(plan.removal.yield_depth_mm, behind != nullptr ? *behind : 0.0);
  for (const Felt& ring : rings)
    if (ring.depth_mm != nullptr) *ring.depth_mm = std::min(*ring.depth_mm, yielded);
}

/// Divides the clay that yields behind the lead into pieces, finer than rings.
template <class Profile>
void measure_lead(const Profile& profile, const StepPlan& plan, const ClayStack& stack,
                  const Lead& lead, Contact& contact) noexcept {
  const double h = stack.ring_height_mm(), min_wall = plan.removal.min_wall_mm;
  const double end = lead.up ? plan.tool.high() : plan.tool.low();
  const double at_end = profile.radius(end), all = lead.covered_mm + h;
  const auto t_of = [&](double behind) { return lead.up ? end - behind : end + behind; };
  const double first = std::min(lead.way_to_yield(lead.ahead_mm, min_wall), all);
  const double deeper = lead.ahead_mm + profile.radius(t_of(first)) - at_end;
  const double reach = std::min(std::min(lead.way_to_yield(deeper, min_wall), all),
                                plan.tool.high() - plan.tool.low());
  if (!(reach > 0.0)) return;
  std::array<Felt, 2> rings = rings_at(lead, contact);
  if (reach < all) yield_in_time(plan, lead, rings, contact);

  const double piece = reach / static_cast<double>(contact.front.size());
  double left = exp_neg(lead.decay * 0.5 * piece);  // of the wall
  const double left_by_piece = left * left;
  for (std::size_t k = 0; k < contact.front.size(); ++k) {
    const double behind = (static_cast<double>(k) + 0.5) * piece;
    const double* const ring = rings[behind < lead.covered_mm ? 0 : 1].depth_mm;
    const Surface surface = profile.surface(t_of(behind), piece);
    RingContact& part = contact.front[k];
    const double depth = lead.ahead_mm + surface.radius - at_end - lead.wall_mm * (1.0 - left);
    left *= left_by_piece;
    part.depth_mm =
        std::max(depth, ring != nullptr ? std::min(*ring, plan.removal.yield_depth_mm) : 0.0);
    part.coverage = piece / h;
    part.facing = surface.facing;
  }
  contact.has_front = true;
  // The coverage that the pieces have taken over.
  if (rings[0].depth_mm != nullptr) *rings[0].coverage = std::max(lead.covered_mm - reach, 0.0) / h;
  if (rings[1].depth_mm != nullptr) *rings[1].coverage = std::min(all - reach, h) / h;
}

/// The depth of an end of the tool in the clay beside it, which has yielded. `settled`: a ring that
/// yields late, as a whole, counts as deep as the one behind it at most.
double depth_at_end(const Tool& tool, const ClayStack& stack, double hip_y, const Contact& contact,
                    bool upper, bool settled) noexcept {
  const double t = upper ? tool.high() : tool.low(), h = stack.ring_height_mm();
  const double level = (hip_y + t) / h;
  if (!(level > 0.0 && level * h < stack.height_mm())) return 0.0;
  const bool in_crown = level >= static_cast<double>(stack.size());
  for (std::size_t k = 0; k < contact.edge_count; ++k)
    if (contact.edge_end[k] == (in_crown ? 0 : upper ? 1 : -1)) return contact.edges[k].depth_mm;
  if (in_crown) return 0.0;
  // The ring's depth was measured in the middle of the part that the tool covers, as here.
  const auto covered_middle = [&](std::size_t ring) -> std::optional<double> {
    const double middle = (static_cast<double>(ring) + 0.5) * h - hip_y;
    const double low = std::max(middle - 0.5 * h, tool.low());
    const double high = std::min(middle + 0.5 * h, tool.high());
    return high > low ? std::optional(0.5 * (low + high)) : std::nullopt;
  };
  std::size_t ring = upper ? contact.top : contact.bottom;
  std::optional<double> middle = covered_middle(ring);
  // An end between two rings belongs to the ring inside the tool, even if rounding puts it into the
  // other one.
  if (!middle && contact.top > contact.bottom) {
    ring = upper ? ring - 1 : ring + 1;
    middle = covered_middle(ring);
  }
  if (!middle || !contact.rings.has(ring)) return 0.0;
  double depth = contact.rings.get(ring).depth_mm;
  if (settled) depth = std::min(depth, contact.rings.get(upper ? ring - 1 : ring + 1).depth_mm);
  return depth > 0.0 ? depth + tool.radius(t) - tool.radius(*middle) : 0.0;
}

/// `lead`: the end that leads, if its front was measured. It is as deep as the clay ahead of it:
/// there nothing has yielded yet.
void feel_ends(const Tool& tool, const ClayStack& stack, double hip_y, const Lead* lead,
               EndMotion* motion, Contact& contact) noexcept {
  contact.end_depth2 = {};
  if (std::holds_alternative<EllipseProfile>(tool.profile())) return;  // cos theta = 0 at its poles
  for (const bool upper : {false, true}) {
    const auto square = [](double depth) { return depth > 0.0 ? depth * depth : 0.0; };
    double depth2 = square(depth_at_end(tool, stack, hip_y, contact, upper, motion != nullptr));
    if (motion != nullptr) {
      End end{.up = upper};
      if (!find_end(tool, stack, hip_y, contact, end)) end.ahead_mm = 0.0;
      FlatEnd& flat = motion->ends[upper ? 1 : 0];
      flat.advance(upper ? contact.rise_mm : -contact.rise_mm, end.ahead_mm);
      depth2 += flat.part() * (square(end.ahead_mm) - depth2);
    } else if (lead != nullptr && lead->up == upper) {
      depth2 = square(lead->ahead_mm);
    }
    const double slope = tool.slope(upper ? tool.high() : tool.low());
    contact.end_depth2[upper ? 1 : 0] = depth2 / (1.0 + slope * slope);
  }
}

}  // namespace

/// If the tool gets deeper in the clay ahead, the force of the end is unchanged; if it gets less
/// deep, the way is unchanged. So the stored energy never rises without a motion toward the clay
/// ahead.
void FlatEnd::advance(double way_mm, double ahead_mm) noexcept {
  if (ahead_mm > depth_mm) pressed_mm *= depth_mm / ahead_mm;
  depth_mm = ahead_mm;
  pressed_mm = std::clamp(pressed_mm + way_mm, 0.0, 0.5 * depth_mm);
}

void measure_front(const StepPlan& plan, const ClayStack& stack, double hip_y, double dt_s,
                   Contact& contact, EndMotion* motion) noexcept {
  Lead lead;
  if (dt_s > 0.0) {
    const double rise = motion != nullptr ? motion->upward_mm_s * dt_s : contact.rise_mm;
    level_edges(contact);
    if (find_lead(plan, stack, hip_y, dt_s, rise, contact, lead))
      std::visit([&](const auto& p) { measure_lead(p, plan, stack, lead, contact); },
                 plan.tool.profile());
  }
  feel_ends(plan.tool, stack, hip_y, contact.has_front ? &lead : nullptr, motion, contact);
}

}  // namespace clay
