#include "engine/tick/yielding.hpp"

#include "engine/clay/packs.hpp"

#include <array>
#include <cstdint>

namespace clay {
namespace {

/// `plain`: the tool has been in each ring all the time, and no deeper than the knee when it came.
/// So are most rings, and they need half of the divisions.
template <bool plain>
CLAYSTACK_INLINE inline void yield_rings(const RemovalPlan& plan, double turn, Yielding& rings,
                                         std::size_t count) noexcept {
  const double knee = plan.yield_depth_mm, min_wall = plan.min_wall_mm, per_knee = 1.0 / knee;
  const double fraction = 1.0 - exp_neg(turn), pace_of = knee / greater(turn, 1e-300);
  for (std::size_t k = 0; k < count; ++k) {
    const double wall = rings.wall[k], depth = rings.depth[k], target = rings.target[k];
    double advance = rings.advance[k], pace = advance * pace_of, q = turn, rest = 1.0;
    double at_most = wall * fraction;
    if constexpr (!plain) {
      // A tool that was not in the clay before came to it on the way.
      const double part = lesser(1.0, depth / greater(advance, depth)) * rings.since[k];
      advance = lesser(advance, depth);
      pace = advance * knee / greater(turn * part, 1e-300);
      q = turn * part;
      at_most *= part * (1.0 + 0.5 * turn * (1.0 - part));

      // Above the knee: how much of the time passes until it is reached, by the logarithmic mean
      // of the wall.
      const double over = greater(depth - advance - knee, 0.0), middle = wall - 0.5 * over;
      const double closing = q * (middle - over * over / (12.0 * middle)) - advance;
      rest = closing > over ? 1.0 - over / closing : over > 0.0 ? 0.0 : 1.0;
    }

    // Below it: about the depth that stays.
    const double behind = greater(target + 0.5 * advance, min_wall);
    const double square = behind * behind, coming = greater(pace, -0.25 * square);
    const double steady = coming * behind / (square + coming);
    const double spread = behind + 2.0 * steady;
    const double fall = exp_of(q * rest * per_knee * spread);
    const double off = lesser(depth - advance, knee) - steady;
    const double relaxed = steady + off * spread / ((spread + off) * fall - off);

    rings.left[k] = lesser(greater(greater(relaxed, depth - at_most), 0.0), depth);
  }
}

template <bool plain>
void yield_all(const RemovalPlan& plan, double turn, Yielding& rings, std::size_t count) noexcept {
  in_lanes([&]() CLAYSTACK_INLINE { yield_rings<plain>(plan, turn, rings, count); });
}

/// Writes to `other` which rings are not plain: 0 for those that are. Whether there is one.
bool find_others(double knee, Yielding& rings, std::size_t count, std::int64_t* other) noexcept {
  for (std::size_t k = count; k < in_packs_of(count); ++k) {
    rings.depth[k] = rings.advance[k] = 0.0;
    rings.since[k] = 1.0;
  }
  bool found = false;
  in_packs([=, r = &rings, to = &found](auto n) CLAYSTACK_INLINE {
    using D = Doubles<n>;
    Quantas<n> some{};
    for (std::size_t k = 0; k < count; k += n) {
      const D start = load_doubles<n>(&r->depth[k]) - load_doubles<n>(&r->advance[k]);
      const auto plain = (start >= 0.0) & (start <= knee) & (load_doubles<n>(&r->since[k]) == 1.0);
      store(other + k, Quantas<n>(~plain));
      some |= ~plain;
    }
    *to = any(some);
  });
  return found;
}

}  // namespace

void yield(const RemovalPlan& plan, double dt_s, Yielding& rings, std::size_t count) noexcept {
  const double turn = plan.rate_per_s * dt_s;
  alignas(kPackBytes) std::array<std::int64_t, Yielding::kMost> other;
  if (!find_others(plan.yield_depth_mm, rings, count, other.data()))
    return yield_all<true>(plan, turn, rings, count);
  std::array<std::size_t, Yielding::kMost> others;
  std::size_t few = 0;
  for (std::size_t k = 0; k < count; ++k)
    if (other[k] != 0) others[few++] = k;
  if (2 * few > count) return yield_all<false>(plan, turn, rings, count);
  yield_all<true>(plan, turn, rings, count);
  Yielding block;
  for (std::size_t k = 0; k < few; ++k) block.copy(k, rings, others[k]);
  yield_all<false>(plan, turn, block, few);
  for (std::size_t k = 0; k < few; ++k) rings.left[others[k]] = block.left[k];
}

}  // namespace clay
