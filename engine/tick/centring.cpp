#include "engine/tick/centring.hpp"

#include "engine/clay/packs.hpp"
#include "engine/tick/beside_tool.hpp"
#include "engine/tick/shell.hpp"

#include <algorithm>

namespace clay {
namespace {

constexpr std::size_t kRows = 32;

/// The depth of each tool in each ring; negative where the tool is clear of the ring.
struct Depths {
  alignas(kPackBytes) double radii[kRows];  ///< of the tool; below 0 beyond its ends
  alignas(kPackBytes) double of[2][kRows];
  alignas(kPackBytes) double openings[kRows];  ///< R / r

  void measure(const Ring* rings, std::size_t count, double outer_distance,
               double inner_distance) noexcept {
    in_packs([=, to = this](auto n) CLAYSTACK_INLINE {
      using D = Doubles<n>;
      for (std::size_t k = 0; k < count; k += n) {
        const RingPack<n> pack = load_rings<n>(rings + k, count - k);
        const D outer = root(doubles_of(pack.outer2) * kMm2PerQuantum);
        const D inner = root(doubles_of(pack.inner2) * kMm2PerQuantum);
        const D f = load_doubles<n>(to->radii + k);
        store(to->of[0] + k, outer + f - outer_distance);
        store(to->of[1] + k, inner_distance + f - inner);
        store(to->openings + k, inner > 0.0 ? outer / inner : all_of<D>(1.0));
      }
    });
  }
  void keep_touched(const TouchedRings& rings, std::size_t side, std::size_t first,
                    std::size_t count) noexcept {
    const std::size_t end = std::min(first + count, rings.to());
    for (std::size_t i = std::max(first, rings.from()); i < end; ++i)
      if (const double depth = rings.depth(i); depth > 0.0) of[side][i - first] = depth;
  }
};

/// Finds the ring that one tool would push farthest towards the other, and the band around it.
bool find_push(const ClayStack& stack, std::span<const ToolRemoval> removals, const PushOver& over,
               Band& band, bool& outward) noexcept {
  band.give_mm = 0.0;
  Peak peak;
  for (const bool from_outside : {true, false}) {
    const TouchedRings& rings = removals[from_outside ? 0 : 1].contact.rings;
    Peak side;
    double most = 0.0;
    for (std::size_t i = rings.from(); i < rings.to(); ++i) {
      const double give = rings.give(i);
      if (!(give > 0.0) || stack.rings()[i].inner2 == 0) continue;
      const double push = std::min(give, from_outside ? over.inward_mm(i) : over.outward_mm(i));
      if (!(push > 0.0)) continue;
      most = std::max(most, push);
      side.add(static_cast<double>(i) + 0.5, push);
    }
    if (!(most > band.give_mm)) continue;
    band.give_mm = most;
    outward = !from_outside;
    peak = side;
  }
  if (peak.weight > 0.0) peak.settle(stack.ring_height_mm(), band);
  return peak.weight > 0.0;
}

/// From the lower end of the contacts to the upper one.
Band both(const std::array<Band, 2>& bands, std::span<const ToolRemoval> removals) noexcept {
  Band band;
  band.low_mm = 1e300;
  for (std::size_t side = 0; side < 2; ++side) {
    if (removals[side].contact.rings.empty()) continue;
    band.low_mm = std::min(band.low_mm, bands[side].low_mm);
    band.high_mm = std::max(band.high_mm, bands[side].high_mm);
  }
  return band;
}

}  // namespace

void PushOver::reserve(std::size_t rings) {
  inward_.resize(in_packs_of(rings));
  outward_.resize(in_packs_of(rings));
}

void PushOver::measure(const Tool& tool, const ClayStack& stack, double hip_y,
                       std::span<const ToolRemoval> removals) noexcept {
  const Contact& contact = removals[0].contact;
  from_ = contact.bottom;
  count_ = std::min(contact.top + 1 - contact.bottom, inward_.size());
  for (std::size_t done = 0; done < count_; done += kRows)
    measure(tool, stack, hip_y, removals, from_ + done, std::min(kRows, count_ - done));
}

/// A wall that is pushed in by u keeps its clay, so its inner surface moves by u R / r.
void PushOver::measure(const Tool& tool, const ClayStack& stack, double hip_y,
                       std::span<const ToolRemoval> removals, std::size_t first,
                       std::size_t count) noexcept {
  Depths depths;
  radii_beside(tool, stack.ring_height_mm(), hip_y, first, count, depths.radii);
  depths.measure(stack.rings().data() + first, count, removals[0].contact.axis_distance_mm,
                 removals[1].contact.axis_distance_mm);
  for (std::size_t side = 0; side < 2; ++side)
    depths.keep_touched(removals[side].contact.rings, side, first, count);
  in_packs([=, d = &depths, in = &inward_[first - from_],
            out = &outward_[first - from_]](auto n) CLAYSTACK_INLINE {
    using D = Doubles<n>;
    for (std::size_t k = 0; k < count; k += n) {
      const D outer = load_doubles<n>(d->of[0] + k), inner = load_doubles<n>(d->of[1] + k);
      const D opening = load_doubles<n>(d->openings + k);
      const D inward = (outer - opening * inner) / (1.0 + opening * opening);
      const auto beyond = load_doubles<n>(d->radii + k) < 0.0;
      const D all = all_of<D>(1e300);
      store(in + k, beyond ? all : greater(inward, 0.0));
      store(out + k, beyond ? all : greater(0.5 * (inner - outer), 0.0));
    }
  });
}

void centre(const StepPlan& plan, const ClayStack& stack, const ToolState& tool,
            const std::array<Band, 2>& bands, std::span<ToolRemoval> removals, WallRadii& walls,
            const RimLimit& rim, PushOver& over, Shift& shift) noexcept {
  over.measure(plan.tool, stack, tool.hip_mm.y, removals);
  Band band = both(bands, removals);
  bool outward = false;
  if (!find_push(stack, removals, over, band, outward)) return;
  const double min_wall = plan.removal.min_wall_mm;
  // Two tools hold the wall, so their motion does not bend it: both speeds are 0.
  const Shell shell = shell_at(stack, walls, band, min_wall, 0.0, 0.0);
  if (!(shell.share > 0.0)) return;
  const bool hoop = (plan.clay.rules & kHoop) != 0;
  shift.lay(
      stack, walls, band, shell, {outward, hoop, min_wall, rim, plan.clay.thin_wall_yields},
      [&](std::size_t first, std::span<float> by) {
        const std::size_t end = std::min(first + by.size(), over.to());
        for (std::size_t i = std::max(first, over.from()); i < end; ++i)
          by[i - first] = static_cast<float>(
              std::min<double>(by[i - first], outward ? over.outward_mm(i) : over.inward_mm(i)));
        hold_foot(shell, stack.ring_height_mm(), first, by);
      },
      [](std::size_t, std::span<float>) {});
  if (outward && plan.clay.thin_wall_yields) shift.keep_thickness(stack, over.from(), over.to());
  for (std::size_t side = 0; side < 2; ++side) {
    TouchedRings& rings = removals[side].contact.rings;
    for (std::size_t i = rings.from(); i < rings.to(); ++i) {
      double& depth = rings.depth(i);
      if (!(depth > 0.0)) continue;
      const Ring &was = stack.rings()[i], is = shift.after(i, was);
      depth += side == 0 ? is.outer_mm() - was.outer_mm() : was.inner_mm() - is.inner_mm();
      depth = std::max(depth, 0.0);
    }
  }
}

}  // namespace clay
