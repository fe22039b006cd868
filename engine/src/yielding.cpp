#include "yielding.hpp"

#include "portable_math.hpp"

#include <algorithm>

namespace clay {
namespace {

// No std::min, whose references keep a loop from being done two at a time.
double lesser(double a, double b) noexcept { return a < b ? a : b; }
double greater(double a, double b) noexcept { return a > b ? a : b; }

}  // namespace

void yield(const RemovalPlan& plan, double dt_s, Yielding& rings, std::size_t count) noexcept {
  const double turn = plan.rate_per_s * dt_s, knee = plan.yield_depth_mm;
  const double fraction = one_minus_exp_neg(turn);
  for (std::size_t k = 0; k < count; ++k) {
    const double wall = rings.wall[k], depth = rings.depth[k], target = rings.target[k];
    // A tool that was not in the clay before came to it on the way.
    const double in_clay = lesser(1.0, depth / greater(rings.advance[k], depth));
    const double advance = lesser(rings.advance[k], depth), part = in_clay * rings.since[k];
    const double q = turn * part, start = depth - advance;
    const double at_most = wall * fraction * part * (1.0 + 0.5 * turn * (1.0 - part));

    // Above the knee: how much of the time passes until it is reached, by the logarithmic mean of
    // the wall.
    const double over = greater(start - knee, 0.0), middle = wall - 0.5 * over;
    const double closing = q * (middle - over * over / (12.0 * middle)) - advance;
    const double rest = closing > over ? 1.0 - over / closing : over > 0.0 ? 0.0 : 1.0;

    // Below it: about the depth that stays.
    const double behind = greater(target + 0.5 * advance, plan.min_wall_mm);
    const double pace = advance * knee / greater(q, 1e-300);
    const double first = greater(pace / behind, -0.25 * behind);
    const double steady = greater(pace / (behind + first), -0.25 * behind);
    const double spread = behind + 2.0 * steady;
    const double left = exp_neg(q * rest * spread / knee);
    const double off = lesser(start, knee) - steady;
    const double relaxed = steady + off * left / (1.0 + off / spread * (1.0 - left));

    rings.left[k] = lesser(greater(greater(relaxed, depth - at_most), 0.0), depth);
  }
}

}  // namespace clay
