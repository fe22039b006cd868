#include "engine/tick/rim_growth.hpp"

#include "engine/tick/beside_tool.hpp"
#include "engine/tick/lump.hpp"
#include "engine/tick/relief.hpp"
#include "engine/tick/shell.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

// Limits the work of a tick; the crown holds the rest of the clay for the next one.
constexpr std::size_t kMostGrowthPerTick = 64;

// Taper of a thick rim: loss of thickness over height.
constexpr double kTaper = 0.5;

// Limits of the lip that a tick moves.
constexpr double kHighestLipMm = 12.0, kMostLiftedRings = 4096.0;
// A wall stretches where its rings hold this much more clay than those of the rim.
constexpr double kWiderWall = 1.25;
// A lip is rounded: its largest thickness at the rim and half-way down, relative to the wall below.
constexpr double kThinRim = 0.7, kThinLip = 0.93;
// The wall that a thin rim is compared with is so far below it.
constexpr double kBelowThinRimMm = 6.0;
// Steps of the search from the rim down for the wall that is twice as thick as the lip is high.
constexpr int kLipPasses = 4;

/// A copy of the top ring, plus the excess of the rim. A quarter of the ring at most, so that it
/// stays a ring.
Ring next_ring(const Ring& top, const Rim* rim) noexcept {
  if (rim == nullptr) return top;
  const WideQuanta most = top.volume() / 4;
  const auto more = [&](WideQuanta q) {
    return static_cast<Quanta>(std::clamp<WideQuanta>(q, -most, most));
  };
  Ring ring = top;
  ring.outer2 = std::clamp(top.outer2 + more(rim->outside), kSmallestOuter2, kLargestOuter2);
  if (top.inner2 > 0) ring.inner2 = std::max<Quanta>(top.inner2 - more(rim->inside), 0);
  return ring;
}

/// A ring, and below which ring it rises: the stack's size for one on top.
struct Growth {
  Ring ring;
  std::size_t at;
};

/// Steps (a), (b): whole rings from the excess. `paper` keeps the remainder outside the body,
/// below one top ring after every tick; `conserving` shows it as the crown.
template <Model model, class NextRing>
void grow(Flow& flow, ClayStack& stack, Ledger& ledger, StackWriter& writer, Rim* rim,
          NextRing next) noexcept {
  const auto excess = [&] { return model == Model::paper ? ledger.outside : stack.crown(); };
  // With less than half of the top ring no ring can grow: no ring above it is smaller.
  while (2 * excess() >= stack.rings().back().volume()) {
    const auto [ring, at] = next();
    if (ring.volume() <= 0 || excess() < ring.volume()) return;
    flow.ring_limit = stack.size() >= stack.max_rings();
    if (flow.ring_limit) return;
    if (model == Model::conserving && flow.grown >= kMostGrowthPerTick) return;
    if constexpr (model == Model::paper)
      ledger.outside -= ring.volume();
    else
      writer.put_on_crown(-ring.volume());
    writer.grow(at, ring);
    if (rim != nullptr) *rim = {};
    flow.lip = std::min(flow.lip, at);
    flow.grown_volume += ring.volume();
    ++flow.grown;
  }
}

/// The ring of the wall as far below the rim as the rim is thick. Expects two rings.
const Ring& below_rim(const ClayStack& stack, double rim_mm) noexcept {
  const auto rings = stack.rings();
  const double down = rim_mm / stack.ring_height_mm() + 0.5;
  const double most = static_cast<double>(rings.size()) - 1.0;
  return rings[rings.size() - 1 - static_cast<std::size_t>(std::clamp(down, 1.0, most))];
}

/// The unchanged rim: its middle line continues upright, because a lifted wall keeps its radius,
/// and a rim thicker than the wall below it tapers back to that wall.
Ring copied_rim(const ClayStack& stack) noexcept {
  const auto rings = stack.rings();
  const Ring& top = rings.back();
  if (rings.size() < 2 || top.inner2 == 0) return top;
  const double h = stack.ring_height_mm(), outer = top.outer_mm(), inner = top.inner_mm();
  const double wall = outer - inner;
  const Ring& old = below_rim(stack, wall);
  if (old.inner2 == 0) return top;
  const double thinner = wall - wall_mm(old);
  if (!(thinner > 0.0)) return top;
  const double by = 0.5 * std::min(thinner, kTaper * h);
  return {quanta_from_radius(outer - by), quanta_from_radius(inner + by)};
}

/// The lowest ring of a lip: the rounded rim of a wall, which rises and sinks unchanged. A lip is
/// half as high as the wall below it is thick, and begins above the tools and above the bottom of
/// the bore. The stack's size if there is none, or if a tool stands beside it.
std::size_t lip_of(const ClayStack& stack, const Tool& tool, double hip_y,
                   std::span<const ToolRemoval> removals) noexcept {
  const auto rings = stack.rings();
  const double h = stack.ring_height_mm(), size = static_cast<double>(rings.size());
  double from = 1.0;
  for (const auto& [contact, removed] : removals)
    if (!contact.rings.empty()) from = std::max(from, std::ceil((hip_y + tool.high()) / h));
  const double top_mm = wall_mm(rings.back());
  double thickest_mm = top_mm, first = size - 1.0;
  for (int pass = 0; pass < kLipPasses && first > 0.0; ++pass) {
    first = std::max(size - std::floor(std::min(0.5 * thickest_mm, kHighestLipMm) / h + 0.5), 1.0);
    const double below_mm = wall_mm(rings[static_cast<std::size_t>(first) - 1]);
    if (!(below_mm > thickest_mm)) break;
    thickest_mm = below_mm;
  }
  const double least = std::max(first, from);
  const double half_way = std::ceil(0.5 * (size + first));
  const double half_mm = wall_mm(rings[static_cast<std::size_t>(std::min(half_way, size - 1.0))]);
  const bool rounded = top_mm < kThinRim * thickest_mm && half_mm > kThinRim * thickest_mm &&
                       half_mm < kThinLip * thickest_mm;
  if (!(rounded && least < size)) return rings.size();
  std::size_t lip = static_cast<std::size_t>(least);
  while (lip < rings.size() && rings[lip - 1].inner2 == 0) ++lip;
  return lip;
}

/// The lowest ring of a rim that is thinner than the wall below it, and than two tools leave it,
/// and no higher than a lip. The stack's size if there is none.
std::size_t thin_rim_of(const ClayStack& stack, double gap_mm) noexcept {
  const auto rings = stack.rings();
  const std::size_t none = rings.size();
  if (rings.size() < 2 || rings.back().inner2 == 0) return none;
  const double below_mm = std::min(wall_mm(below_rim(stack, kBelowThinRimMm)), gap_mm);
  if (!(wall_mm(rings.back()) < kThinRim * below_mm)) return none;
  const double highest = kHighestLipMm / stack.ring_height_mm();
  std::size_t first = none - 1;
  while (first > 0 && static_cast<double>(none - first) < highest && rings[first - 1].inner2 > 0 &&
         wall_mm(rings[first - 1]) < kThinLip * below_mm)
    --first;
  return first > 0 && rings[first - 1].inner2 > 0 ? first : none;
}

/// The middle of a wall with another thickness.
Ring as_thick(const Ring& ring, double thickness_mm) noexcept {
  const double middle = 0.5 * (ring.outer_mm() + ring.inner_mm()), half = 0.5 * thickness_mm;
  if (ring.inner2 == 0 || !(half < middle)) return ring;
  const Ring reshaped{quanta_from_radius(middle + half), quanta_from_radius(middle - half)};
  return reshaped.inner2 > 0 && reshaped.volume() > 0 ? reshaped : ring;
}

/// The part of a ring above the rim that a tool of radius f leaves.
Ring left_beside(const Ring& ring, double f, const Contact& contact) noexcept {
  if (!(depth_of(ring, f, contact) > 0.0)) return ring;
  const double d = contact.axis_distance_mm;
  if (contact.side == Side::compressive)
    return {std::min(ring.outer2, quanta_from_radius(std::max(d - f, 0.0))), ring.inner2};
  return {ring.outer2, std::max(ring.inner2, quanta_from_radius(d + f))};
}

/// A ring that leans inward to this outer radius, no more steeply than an undercut yields, and by
/// half of its thickness at most; else no wall.
Ring leaning_ring(const Ring& ring, Quanta outer2, double h) noexcept {
  const double outer = radius_from_quanta(outer2), wall = wall_mm(ring), inner = outer - wall;
  const bool fits = ring.outer_mm() - outer <= std::min(kReliefSlope * h, 0.5 * wall);
  return fits && inner > 0.0 ? Ring{outer2, quanta_from_radius(inner)} : Ring{};
}

/// The part of a ring above the rim that fits beside the tools. Where less than half of it fits, or
/// less than the minimum wall, a narrow rim that closes leans away from a tool outside; any other
/// rim gets no wall.
Ring beside_tools(const Ring& next, const ClayStack& stack, const StepPlan& plan, double hip_y,
                  std::span<const ToolRemoval> removals) noexcept {
  const Tool& tool = plan.tool;
  const double t = (static_cast<double>(stack.size()) + 0.5) * stack.ring_height_mm() - hip_y;
  if (!(t >= tool.low() && t <= tool.high())) return next;
  const double f = tool.radius(t);
  Ring ring = next;
  for (const auto& [contact, removed] : removals) ring = left_beside(ring, f, contact);
  const bool thin = ring != next && wall_mm(ring) < plan.removal.min_wall_mm;
  if (2 * ring.volume() >= next.volume() && !thin) return ring;
  const bool leans = plan.clay.narrow_rim_closes && removals.size() == 1 && pliancy(next) > 0.0 &&
                     ring.inner2 == next.inner2;
  return leans ? leaning_ring(next, ring.outer2, stack.ring_height_mm()) : Ring{};
}

/// A ring of the wall below a thin rim, no thicker than two tools leave it. No wall while the rim
/// would rise into a tool. Empty: the rim is not thin.
std::optional<Growth> below_thin_rim(const StepPlan& plan, const ClayStack& stack,
                                     const ToolState& tool,
                                     std::span<const ToolRemoval> removals) noexcept {
  const std::size_t at = thin_rim_of(stack, tool.gap_mm);
  if (at == stack.size()) return std::nullopt;
  const Ring& below = stack.rings()[at - 1];
  const Ring ring = wall_mm(below) > tool.gap_mm ? as_thick(below, tool.gap_mm) : below;
  for (const auto& [contact, removed] : removals)
    if (!rise_clear(plan.tool, stack, tool.hip_mm.y, contact, ring, at))
      return Growth{Ring{}, stack.size()};
  return Growth{ring, at};
}

/// The mean of two rings that touch, so that a wall that leans stretches.
Ring ring_between(const Ring& below, const Ring& above) noexcept {
  return {below.outer2 + (above.outer2 - below.outer2) / 2,
          below.inner2 + (above.inner2 - below.inner2) / 2};
}

}  // namespace

std::optional<std::size_t> place_of_stretch(const StepPlan& plan, const ClayStack& stack,
                                            const ToolState& tool,
                                            std::span<const ToolRemoval> removals) noexcept {
  if (removals.size() == 1) return place_in_lump(plan, stack, tool, removals);
  const double hip_y = tool.hip_mm.y;
  const bool pinched = removals.size() == 2 && !removals[0].contact.rings.empty() &&
                       !removals[1].contact.rings.empty();
  if (!plan.clay.lifted_wall_stretches || !pinched) return std::nullopt;
  const auto rings = stack.rings();
  const double above = std::ceil((hip_y + plan.tool.high()) / stack.ring_height_mm());
  const double size = static_cast<double>(rings.size());
  if (!(above >= 1.0 && above < size && size - above <= kMostLiftedRings)) return std::nullopt;
  const auto place = static_cast<std::size_t>(above);
  if (rings[place - 1].inner2 == 0 || rings[place].inner2 == 0) return std::nullopt;
  const Ring& rim = rings[lip_of(stack, plan.tool, hip_y, removals) - 1];
  const Quanta rim_volume = std::max(rim.volume(), below_rim(stack, wall_mm(rim)).volume());
  const auto wall = static_cast<double>(rings[place].volume());
  if (!(wall > kWiderWall * static_cast<double>(rim_volume))) return std::nullopt;
  return place;
}

template <Model model>
void grow_rings(Flow& flow, ClayStack& stack, Ledger& ledger, Rim* rim,
                StackWriter& writer) noexcept {
  grow<model>(flow, stack, ledger, writer, rim, [&] {
    return Growth{next_ring(stack.rings().back(), model == Model::paper ? nullptr : rim),
                  stack.size()};
  });
}

void grow_rim(Flow& flow, const StepPlan& plan, const ToolState& tool,
              std::span<const ToolRemoval> removals, ClayStack& stack, Rim* rim,
              StackWriter& writer) noexcept {
  Ledger none;
  const double hip_y = tool.hip_mm.y;
  grow<Model::conserving>(flow, stack, none, writer, rim, [&] {
    const auto rings = stack.rings();
    const auto place = place_of_stretch(plan, stack, tool, removals);
    if (place && *place < rings.size())
      return Growth{ring_between(rings[*place - 1], rings[*place]), *place};
    // The wall below a lip holds more than the top ring. The lip rises into a new ring's place.
    if (rim == nullptr && stack.crown() >= rings.back().volume() &&
        beside_tools(rings.back(), stack, plan, hip_y, removals) == rings.back())
      if (const std::size_t lip = lip_of(stack, plan.tool, hip_y, removals); lip < rings.size())
        return Growth{rings[lip - 1], lip};
    if (rim == nullptr && plan.clay.thin_rim_rises && removals.size() == 2)
      if (const auto growth = below_thin_rim(plan, stack, tool, removals)) return *growth;
    const Ring top = rim != nullptr ? next_ring(rings.back(), rim) : copied_rim(stack);
    return Growth{beside_tools(top, stack, plan, hip_y, removals), rings.size()};
  });
}

RimLimit rim_limit(const ClayStack& stack, const Tool& tool, double hip_y,
                   std::span<const ToolRemoval> removals) noexcept {
  const Ring& ring = stack.rings()[lip_of(stack, tool, hip_y, removals) - 1];
  return {static_cast<double>(ring.volume()) * kMm2PerQuantum, stack.crown() >= ring.volume()};
}

void sink_rim(Flow& flow, const Tool& tool, double hip_y, std::span<const ToolRemoval> removals,
              ClayStack& stack, StackWriter& writer) noexcept {
  const WideQuanta before = stack.crown();
  while (stack.crown() < 0 && stack.size() > 1) {
    const auto rings = stack.rings();
    const std::size_t top = rings.size() - 1, lip = lip_of(stack, tool, hip_y, removals);
    // On a wall that leans the lip follows the wall.
    const std::size_t first = lip > top ? top : lip - 1;
    for (std::size_t i = first; i < top; ++i)
      writer.reshape(i, as_thick(rings[i], wall_mm(rings[i + 1])));
    flow.lip = std::min(flow.lip, first);
    ++flow.sunk;
    writer.sink();
  }
  flow.sunk_volume = stack.crown() - before;
}

template void grow_rings<Model::paper>(Flow&, ClayStack&, Ledger&, Rim*, StackWriter&) noexcept;
template void grow_rings<Model::conserving>(Flow&, ClayStack&, Ledger&, Rim*,
                                            StackWriter&) noexcept;

}  // namespace clay
