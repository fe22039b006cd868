#include "engine/tick/yielding.hpp"

#include "engine/clay/packs.hpp"
#include "engine/clay/portable_math.hpp"

#include <array>
#include <cstdint>

namespace clay {
namespace {

/// The approach of a tool to each of some rings.
struct Approach {
  using Row = std::array<double, Yielding::kMost>;
  Row advance;  ///< part of the depth that the tool has gone in the clay [mm]
  Row pace;     ///< wall times depth at which the clay yields as fast as the tool comes [mm^2]
  Row time;     ///< in which the tool is nearer than the knee, times kappa / knee [1/mm]
  Row at_most;  ///< that gives way [mm]
};

/// Factors that all rings have in common. The knee is the yield depth [mm]: deeper clay yields at
/// the full rate. The turn is kappa times the time step.
struct Pace {
  double knee, turn;
  double per_knee = 1.0 / knee, fraction = 1.0 - exp_neg(turn);
  double pace_of = knee / greater(turn, 1e-300);
};

/// `plain`: the tool has been in each ring all the time, and no deeper than the knee when it came.
/// So are most rings, and they need no divisions here.
template <bool plain>
CLAYSTACK_INLINE inline void approach_rings(const Pace& all, const Yielding& rings,
                                            std::size_t count, Approach& to) noexcept {
  const auto [knee, turn, per_knee, fraction, pace_of] = all;
#pragma GCC unroll 1
  for (std::size_t k = 0; k < count; ++k) {
    const double wall = rings.wall[k], depth = rings.depth[k];
    double advance = rings.advance[k], pace = advance * pace_of, q = turn, rest = 1.0;
    double at_most = wall * fraction;
    if constexpr (!plain) {
      // A tool that was not in the clay before reached it during this step.
      const double part = lesser(1.0, depth / greater(advance, depth)) * rings.since[k];
      advance = lesser(advance, depth);
      pace = advance * knee / greater(turn * part, 1e-300);
      q = turn * part;
      at_most *= part * (1.0 + 0.5 * turn * (1.0 - part));

      // Above the knee: the fraction of the time until it is reached, by the logarithmic mean of
      // the wall.
      const double over = greater(depth - advance - knee, 0.0), middle = wall - 0.5 * over;
      const double closing = q * (middle - over * over / (12.0 * middle)) - advance;
      rest = closing > over ? 1.0 - over / closing : over > 0.0 ? 0.0 : 1.0;
    }
    to.advance[k] = advance;
    to.pace[k] = pace;
    to.time[k] = q * rest * per_knee;
    to.at_most[k] = at_most;
  }
}

/// Below the knee: about the depth that stays. Three short loops: with one long chain of operations
/// the processor works on few rows at once. They stay rolled, so that their code is short too.
CLAYSTACK_INLINE inline void relax_rings(const RemovalPlan& plan, const Approach& how,
                                         Yielding& rings, std::size_t count) noexcept {
  const double knee = plan.yield_depth_mm, min_wall = plan.min_wall_mm;
  Approach::Row steady, spread, fall;
#pragma GCC unroll 1
  for (std::size_t k = 0; k < count; ++k) {
    const double behind = greater(rings.target[k] + 0.5 * how.advance[k], min_wall);
    const double square = behind * behind, coming = greater(how.pace[k], -0.25 * square);
    steady[k] = coming * behind / (square + coming);
    spread[k] = behind + 2.0 * steady[k];
  }
#pragma GCC unroll 1
  for (std::size_t k = 0; k < count; ++k) fall[k] = exp_of(how.time[k] * spread[k]);
#pragma GCC unroll 1
  for (std::size_t k = 0; k < count; ++k) {
    const double depth = rings.depth[k];
    const double off = lesser(depth - how.advance[k], knee) - steady[k];
    const double relaxed = steady[k] + off * spread[k] / ((spread[k] + off) * fall[k] - off);
    rings.left[k] = lesser(greater(greater(relaxed, depth - how.at_most[k]), 0.0), depth);
  }
}

template <bool plain>
void yield_all(const RemovalPlan& plan, const Pace& all, Yielding& rings,
               std::size_t some) noexcept {
  in_lanes([&plan, &all, &rings, some]() CLAYSTACK_INLINE {
    const std::size_t count = Yielding::filled_up(some);
    Approach how;
    approach_rings<plain>(all, rings, count, how);
    relax_rings(plan, how, rings, count);
  });
}

/// Marks in `other` the rings that are not plain; 0 marks plain ones. Returns whether there is one
/// that is not.
bool find_others(double knee, const Yielding& rings, std::size_t count,
                 std::int64_t* other) noexcept {
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

/// `each`: every row is computed as if it were alone.
template <bool each>
void yield_rows(const RemovalPlan& plan, double dt_s, Yielding& rings, std::size_t count) noexcept {
  const Pace all{plan.yield_depth_mm, plan.rate_per_s * dt_s};
  rings.fill_up(count);
  alignas(kPackBytes) std::array<std::int64_t, Yielding::kMost> other;
  if (!find_others(plan.yield_depth_mm, rings, count, other.data()))
    return yield_all<true>(plan, all, rings, count);
  std::array<std::size_t, Yielding::kMost> others;
  std::size_t few = 0;
  for (std::size_t k = 0; k < count; ++k)
    if (other[k] != 0) others[few++] = k;
  if (few == count || (!each && 2 * few > count)) return yield_all<false>(plan, all, rings, count);
  yield_all<true>(plan, all, rings, count);
  Yielding block;
  for (std::size_t k = 0; k < few; ++k) block.copy(k, rings, others[k]);
  block.fill_up(few);
  yield_all<false>(plan, all, block, few);
  for (std::size_t k = 0; k < few; ++k) rings.left[others[k]] = block.left[k];
}

}  // namespace

void yield(const RemovalPlan& plan, double dt_s, Yielding& rings, std::size_t count) noexcept {
  yield_rows<false>(plan, dt_s, rings, count);
}
void yield_each(const RemovalPlan& plan, double dt_s, Yielding& rings, std::size_t count) noexcept {
  yield_rows<true>(plan, dt_s, rings, count);
}

}  // namespace clay
