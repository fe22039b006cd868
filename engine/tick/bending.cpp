#include "engine/tick/bending.hpp"

#include "engine/tick/shell.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace clay {
namespace {

// The part of the wall's thickness, above and below a ring, over which its motion is averaged.
constexpr double kAbout = 0.1;

/// A touched ring moves at least by the given share of the mean distance by which it and its
/// neighbours give way. `about`: the mean covers this many rings above the middle of the ring, and
/// as many below.
class MeanGive {
 public:
  /// `sums`: room for three times as many numbers as the tool can touch rings, and three more.
  MeanGive(const TouchedRings& rings, double share, double about, std::span<double> sums) noexcept
      : rings_(rings),
        scale_(0.5 * share / about),
        part_(about - 0.5 - std::floor(about - 0.5)),
        whole_(static_cast<std::size_t>(std::min(about - 0.5, static_cast<double>(rings.size())))),
        sums_(sums.data()) {
    sum_up();
  }

  /// Raises the motions `by` [mm] of the rings from `first` on to that minimum.
  void move(std::size_t first, std::span<float> by) const noexcept {
    const std::size_t begin = std::max(first, rings_.from());
    const std::size_t end = std::min(first + by.size(), rings_.to());
    if (begin >= end) return;
    in_lanes([scale = scale_, part = part_, low = sums_ + (begin - rings_.from()),
              high = sums_ + (begin - rings_.from() + 2 * whole_ + 2), to = &by[begin - first],
              count = end - begin]() CLAYSTACK_INLINE {
      for (std::size_t k = 0; k < count; ++k) {
        const double beside = low[k + 1] - low[k] + high[k + 1] - high[k];
        const auto least = static_cast<float>(scale * (high[k] - low[k + 1] + part * beside));
        to[k] = to[k] < least ? least : to[k];
      }
    });
  }

 private:
  /// Running sums of the distances by which the rings give way [mm]: before each ring, and after
  /// the last. Beyond the rings the distance is 0, so that the mean needs no condition at their
  /// ends.
  void sum_up() noexcept {
    double* to = std::fill_n(sums_, whole_ + 1, 0.0);
    double sum = 0.0;
    rings_.each_slice([&](const auto& slice) {
      for (std::size_t row = slice.begin; row < slice.end; ++row) {
        *to++ = sum;
        sum += slice.rows.give[row];
      }
    });
    std::fill_n(to, whole_ + 2, sum);
  }

  const TouchedRings& rings_;
  double scale_, part_;  ///< of the next ring beside the whole ones
  std::size_t whole_;    ///< rings beside this one, to either side
  double* sums_;         ///< from `whole_` + 1 before the first ring to as many behind the last
};

/// A touched ring moves at least by its give beyond the wall that can be squeezed out.
void bend_thin(const TouchedRings& rings, const float* walls, const Shell& shell, double firm_mm,
               double h, std::size_t first, std::span<float> by) noexcept {
  const std::size_t end = std::min(first + by.size(), rings.to());
  for (std::size_t i = std::max(first, rings.from()); i < end; ++i) {
    const double spare = std::max(static_cast<double>(walls[i - first]) - firm_mm, 0.0);
    const double held = shell.hold((static_cast<double>(i) + 0.5) * h);
    by[i - first] = std::max(by[i - first], static_cast<float>(held * (rings.give(i) - spare)));
  }
}

/// The wall that the tool touches behind its peak does not trail: it moves as far as it gives way.
void follow_tool(const MeanGive& gives, const Shell& shell, double h, std::size_t first,
                 std::span<float> by) noexcept {
  std::array<float, Shift::kRows> moved;
  std::ranges::copy(by, moved.begin());
  const std::span rows = std::span(moved).first(by.size());
  gives.move(first, rows);
  hold_foot(shell, h, first, rows);
  for (std::size_t k = 0; k < by.size(); ++k) by[k] = std::max(by[k], rows[k]);
}

/// Speed at which the tool goes into the wall from its side; 0 on its way out.
double speed_into(Side side, const Motion& motion) noexcept {
  const double out = motion.outward_mm_s;
  return std::max(side == Side::compressive ? -out : out, 0.0);
}

}  // namespace

void bend_wall(const StepPlan& plan, const Motion& motion, const ClayStack& stack,
               const Contact& contact, const Band& band, WallRadii& walls, std::span<double> sums,
               const RimLimit& rim, Shift& shift) noexcept {
  const double min_wall = plan.removal.min_wall_mm;
  const bool yields = plan.clay.thin_wall_yields;
  // Nothing can be squeezed out of a wall of at most this thickness; while clay waits above the
  // rim, out of no wall.
  const double firm_mm = rim.waits ? kMaxRadiusMm : min_wall;
  const Shell shell =
      shell_at(stack, walls, band, firm_mm, motion.upward_mm_s, speed_into(contact.side, motion));
  if (!(shell.share > 0.0)) return;
  const double h = stack.ring_height_mm();
  const double about = std::max(kAbout * shell.wall_mm / h, 0.5);
  const MeanGive gives(contact.rings, shell.share, about, sums);
  const Shift::Push push{contact.side == Side::expansive, (plan.clay.rules & kHoop) != 0, min_wall,
                         rim, yields};
  shift.lay(
      stack, walls, band, shell, push,
      [&](std::size_t first, std::span<float> by) {
        gives.move(first, by);
        hold_foot(shell, h, first, by);
      },
      [&](std::size_t first, std::span<float> by) {
        if (plan.clay.pushed_wall_bends) follow_tool(gives, shell, h, first, by);
        if (yields || rim.waits)
          bend_thin(contact.rings, walls.thickness(first), shell, firm_mm, h, first, by);
      });
}

}  // namespace clay
