#include "engine/tick/stability.hpp"

#include "engine/clay/stress.hpp"
#include "engine/tick/joints.hpp"

#include <algorithm>

namespace clay {
namespace {

// Farther than this the sums are faster than a walk.
constexpr std::size_t kLeap = 256;
// Most rings that may have changed, besides those of the last flow, before the sums are updated.
constexpr std::size_t kMostStale = 512;

/// Whether a ring is worth exact arithmetic. Sums in double are within 1e-9 of the exact ones.
class Threshold {
 public:
  explicit Threshold(const StabilityPlan& plan) noexcept
      : scale_(plan.kpa_per_ratio), limit_(plan.max_stress_kpa * (1.0 - 1e-9)) {}
  [[nodiscard]] bool near(double above, Quanta ring) const noexcept {
    return scale_ * above >= limit_ * static_cast<double>(ring);
  }

 private:
  double scale_, limit_;
};

void note_worse(const StabilityPlan& plan, WideQuanta above, std::span<const Ring> rings,
                std::size_t i, std::optional<Failure>& worst) noexcept {
  const double stress = stress_kpa(plan.kpa_per_ratio, above, rings[i].volume());
  if (stress > plan.max_stress_kpa && (!worst || stress > worst->stress_kpa))
    worst = Failure{i, stress};
}

/// Rings from..to downward; `above` is the load on ring `from`. Usually the thinnest of them would
/// carry the load and all of them; then all pass. Otherwise four pass at a time if the thinnest of
/// these would carry all four: four volumes still fit in 64 bits.
void find_weakest(const StabilityPlan& plan, std::span<const Ring> rings, WideQuanta above,
                  std::size_t from, std::size_t to, std::optional<Failure>& worst) noexcept {
  const Threshold threshold(plan);
  const RingBlock all = block_of(rings.subspan(to, from + 1 - to));
  if (!threshold.near(static_cast<double>(above + all.volume), all.least)) return;
  double about = static_cast<double>(above);
  std::size_t end = from + 1;
  const auto pass = [&](std::size_t count, Quanta sum, Quanta least) {
    about += static_cast<double>(sum);
    if (threshold.near(about, least)) {
      WideQuanta weight = above;
      for (std::size_t i = end; i-- > end - count; weight += rings[i].volume())
        if (threshold.near(about, rings[i].volume())) note_worse(plan, weight, rings, i, worst);
    }
    above += sum;
    end -= count;
  };
  while (end >= to + 4) {
    const Ring* const four = &rings[end - 4];
    const Quanta a = four[0].volume(), b = four[1].volume(), c = four[2].volume(),
                 d = four[3].volume();
    pass(4, a + b + c + d, std::min(std::min(a, b), std::min(c, d)));
  }
  while (end > to) pass(1, rings[end - 1].volume(), rings[end - 1].volume());
}

}  // namespace

StabilityWatch::StabilityWatch(const ClayStack& stack) : cursor_(stack.size() - 1), sums_(stack) {}

void StabilityWatch::note_change(std::span<const Ring> rings, std::size_t first,
                                 std::size_t last) noexcept {
  if (stale_first_ < stale_end_) {
    const std::size_t from = std::min(first, stale_first_), end = std::max(last + 1, stale_end_);
    if (end - from <= last - first + kMostStale) {
      stale_first_ = from;
      stale_end_ = end;
      return;
    }
    bring_up_to_date(rings);
  }
  stale_first_ = first;
  stale_end_ = last + 1;
}

void StabilityWatch::bring_up_to_date(std::span<const Ring> rings) noexcept {
  if (stale_first_ < stale_end_) sums_.refresh(rings, stale_first_, stale_end_ - 1);
  stale_end_ = stale_first_;
}

void StabilityWatch::move_to(const ClayStack& stack, std::size_t highest) noexcept {
  const auto rings = stack.rings();
  volume_ = stack.volume();
  crown_ = stack.crown();
  if (std::max(cursor_, highest) - std::min(cursor_, highest) > kLeap) {
    bring_up_to_date(rings);
    above_cursor_ = sums_.above(rings, highest);
    cursor_ = highest;
    return;
  }
  for (; cursor_ > highest; --cursor_) above_cursor_ += rings[cursor_].volume();
  for (; cursor_ < highest; ++cursor_) above_cursor_ -= rings[cursor_ + 1].volume();
}

std::optional<Failure> StabilityWatch::check(const StabilityPlan& plan, const ClayStack& stack,
                                             const Flow& flow) noexcept {
  const auto rings = stack.rings();
  const std::size_t old_size = rings.size() - flow.grown + flow.sunk;
  const bool at_top = cursor_ + 1 == old_size;
  if (flow.lip < SIZE_MAX) note_lip(rings, flow, at_top);
  note_change(rings, std::min(flow.lowest, cursor_), cursor_);
  // Between the flow and the top, or below the flow, the weight has risen too.
  const bool came_on_top = !at_top && (flow.grown > 0 || stack.crown() != crown_);
  std::optional<Failure> worst;
  if (came_on_top || stack.volume() > volume_)
    worst = search(plan, stack);
  else
    find_weakest(plan, rings, above_cursor_ + stack.crown(), cursor_,
                 std::min({flow.lowest, flow.lip, cursor_}), worst);
  if (plan.gaps_fail) note_parted(plan, stack, flow, worst);
  return worst;
}

/// A ring that does not touch the one above it fails at any stress.
void StabilityWatch::note_parted(const StabilityPlan& plan, const ClayStack& stack,
                                 const Flow& flow, std::optional<Failure>& worst) noexcept {
  const bool lip = flow.lip < SIZE_MAX;
  if (!flow.weak && !lip) return;
  const auto rings = stack.rings();
  const std::size_t top = rings.size() - 1;
  const std::size_t low = lip && flow.weak ? std::min(flow.lowest, flow.lip)
                          : lip            ? flow.lip
                                           : flow.lowest;
  const std::size_t first = std::min(low - std::min<std::size_t>(low, 1), top);
  const auto gap = lowest_gap(rings, first, lip ? top : std::min(flow.highest + 1, top));
  if (!gap || (worst && worst->ring <= *gap)) return;
  WideQuanta above = stack.crown();
  for (std::size_t i = top; i > *gap; --i) above += rings[i].volume();
  worst = Failure{*gap, stress_kpa(plan.kpa_per_ratio, above, rings[*gap].volume())};
}

/// Rings were added or removed, and those above them moved.
void StabilityWatch::note_lip(std::span<const Ring> rings, const Flow& flow, bool at_top) noexcept {
  const std::size_t top = rings.size() - 1;
  above_cursor_ += flow.grown_volume - flow.sunk_volume;
  if (at_top || flow.lip <= cursor_) {
    cursor_ = top;
    above_cursor_ = 0;
  }
  stale_end_ = std::min(stale_end_, rings.size());
  if (stale_first_ >= stale_end_) stale_first_ = stale_end_;
  sums_.refresh(rings, std::min(flow.lip, top), top);
}

std::optional<Failure> StabilityWatch::search(const StabilityPlan& plan,
                                              const ClayStack& stack) noexcept {
  bring_up_to_date(stack.rings());
  const Threshold threshold(plan);
  std::optional<Failure> worst;
  sums_.search(
      stack.size(), stack.crown(),
      [&](WideQuanta below, Quanta least) {
        return threshold.near(static_cast<double>(below), least);
      },
      [&](std::size_t first, std::size_t last, WideQuanta above) {
        find_weakest(plan, stack.rings(), above, last, first, worst);
      });
  return worst;
}

std::optional<Failure> StabilityWatch::check_all(const StabilityPlan& plan,
                                                 const ClayStack& stack) noexcept {
  std::optional<Failure> worst;
  find_weakest(plan, stack.rings(), stack.crown(), stack.size() - 1, 0, worst);
  return worst;
}

}  // namespace clay
