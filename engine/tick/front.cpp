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

/// The end that leads, and the clay ahead of it.
struct Lead {
  bool up = false;          ///< which end of the tool
  std::size_t ring = 0;     ///< that the end is in
  double covered_mm = 0.0;  ///< of it
  double ahead_mm = 0.0;    ///< depth of the end in the clay ahead
  double wall_mm = 0.0;     ///< R - r there
  double decay = 0.0;       ///< kappa over the speed of the end [1/mm]

  /// How far the end goes until a depth has yielded, by the logarithmic mean of the wall.
  [[nodiscard]] double way_to_yield(double depth_mm, double min_wall_mm) const noexcept {
    const double middle = std::max(wall_mm - 0.5 * depth_mm, min_wall_mm);
    const double square = middle * middle;
    const double mean =
        std::max(square - depth_mm * depth_mm * (1.0 / 12.0), 0.5 * square);  // * middle
    return depth_mm * middle / (decay * mean);
  }
};

bool find_lead(const StepPlan& plan, const ClayStack& stack, double hip_y, double dt_s,
               const Contact& contact, Lead& lead) noexcept {
  const bool up = lead.up = contact.rise_mm > 0.0;
  const double h = stack.ring_height_mm();
  const double end_t = up ? plan.tool.high() : plan.tool.low(), level = (hip_y + end_t) / h;
  if (!(level > 0.0 && level < static_cast<double>(stack.size()))) return false;
  lead.ring = static_cast<std::size_t>(level);
  const double part = level - static_cast<double>(lead.ring);
  const double covered = up ? part : 1.0 - part;
  lead.covered_mm = covered * h;
  std::size_t ahead = lead.ring;
  if (covered >= 0.5) {
    if (up ? ahead + 1 >= stack.size() : ahead == 0) return false;
    ahead = up ? ahead + 1 : ahead - 1;
  }
  const Ring& ring = stack.rings()[ahead];
  lead.ahead_mm = depth_of(ring, plan.tool.radius(end_t), contact);
  if (!(lead.ahead_mm > 0.0)) return false;
  lead.wall_mm = wall_mm(ring);
  lead.decay = plan.removal.rate_per_s * dt_s / std::abs(contact.rise_mm);
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

/// The depth of an end of the tool in the clay that it has not passed, or has left behind. `lead`:
/// the end that leads, if its front was measured. It is as deep as the clay ahead of it: there
/// nothing has yielded yet.
double depth_at_end(const Tool& tool, const ClayStack& stack, double hip_y, const Contact& contact,
                    const Lead* lead, bool upper) noexcept {
  if (lead != nullptr && lead->up == upper) return lead->ahead_mm;
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
  // An end between two rings belongs to the ring inside the tool, wherever rounding puts it.
  if (!middle && contact.top > contact.bottom) {
    ring = upper ? ring - 1 : ring + 1;
    middle = covered_middle(ring);
  }
  if (!middle || !contact.rings.has(ring)) return 0.0;
  const double depth = contact.rings.get(ring).depth_mm;
  return depth > 0.0 ? depth + tool.radius(t) - tool.radius(*middle) : 0.0;
}

void feel_ends(const Tool& tool, const ClayStack& stack, double hip_y, const Lead* lead,
               Contact& contact) noexcept {
  contact.end_depth2 = {};
  if (std::holds_alternative<EllipseProfile>(tool.profile())) return;  // cos theta = 0 at its poles
  for (const bool upper : {false, true}) {
    const double t = upper ? tool.high() : tool.low(), slope = tool.slope(t);
    const double depth = std::max(depth_at_end(tool, stack, hip_y, contact, lead, upper), 0.0);
    contact.end_depth2[upper ? 1 : 0] = depth * depth / (1.0 + slope * slope);
  }
}

}  // namespace

void measure_front(const StepPlan& plan, const ClayStack& stack, double hip_y, double dt_s,
                   Contact& contact) noexcept {
  Lead lead;
  if (dt_s > 0.0) {
    level_edges(contact);
    if (contact.rise_mm != 0.0 && find_lead(plan, stack, hip_y, dt_s, contact, lead))
      std::visit([&](const auto& p) { measure_lead(p, plan, stack, lead, contact); },
                 plan.tool.profile());
  }
  feel_ends(plan.tool, stack, hip_y, contact.has_front ? &lead : nullptr, contact);
}

}  // namespace clay
