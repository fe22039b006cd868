#include "engine/tick/shell.hpp"

#include "engine/clay/packs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clay {
namespace {

constexpr double kPunch = 2.570796326794897;  // (2 + pi) / 2: a flat punch on a Tresca half-space
constexpr double kNoFoot = -1e300;
constexpr double kRoot = 0.5;     // of the wall: how far up what is solid holds it
constexpr double kSlowMmS = 5.0;  // slower than that, a motion has no direction

/// The wall at a height, between the middles of two rings. [mm]
struct Wall {
  double outer, inner;
};
Wall wall_at(const ClayStack& stack, double up_mm) noexcept {
  const auto rings = stack.rings();
  const double last = static_cast<double>(rings.size() - 1);
  const double level = std::clamp(up_mm / stack.ring_height_mm() - 0.5, 0.0, last);
  const auto i = static_cast<std::size_t>(level);
  const Ring &low = rings[i], &high = rings[std::min(i + 1, rings.size() - 1)];
  const double part = (level - static_cast<double>(i)) * kMm2PerQuantum;
  const double rest = kMm2PerQuantum - part;
  const auto radius = [&](Quanta below, Quanta above) {
    return std::sqrt(rest * static_cast<double>(below) + part * static_cast<double>(above));
  };
  return {radius(low.outer2, high.outer2), radius(low.inner2, high.inner2)};
}

constexpr std::size_t kRows = 64;
// Parts of a stop are whole numbers, so that their sum does not depend on the order.
constexpr double kStop = 0x1p30, kMostStops = 0x1p20;

/// How much rings hold a wall, in parts of a stop: nothing where they are pliant.
struct Holds {
  alignas(kPackBytes) Quanta rows[kRows];
  Quanta sum;
  bool solid;  ///< one of them, at least
};

/// Of some rings, `per_ring` where they are solid.
void hold(const Ring* rings, std::size_t count, double per_ring, Holds& holds) noexcept {
  in_packs([=, to = &holds](auto n) CLAYSTACK_INLINE {
    Doubles<n> stiffest{};
    Quantas<n> sum{};
    for (std::size_t k = 0; k < count; k += n) {
      const RingPack<n> pack = load_rings<n>(rings + k, count - k);
      const Doubles<n> stiff = 1.0 - pliancy(doubles_of(pack.outer2), doubles_of(pack.inner2));
      const Quantas<n> some = quanta_of(Doubles<n>(per_ring * stiff));
      store(to->rows + k, some);
      stiffest = greater(stiffest, stiff);
      sum += some;
    }
    to->sum = sum_of(sum);
    to->solid = -least_of(Doubles<n>(-stiffest)) == 1.0;
    // The last pack repeats the last ring.
    for (std::size_t k = count; k % n != 0; ++k) to->sum -= to->rows[k];
  });
}

/// The wall from an end of a band on.
struct FreeWall {
  double length_mm;
  double foot_mm = kNoFoot;  ///< top of the first solid ring
};

/// How far the wall is free to bend: to the floor, to a solid part, or farther than `most`. Nothing
/// above the rim holds it.
FreeWall free_wall(const ClayStack& stack, double end_mm, bool up, double most,
                   double stop) noexcept {
  const double h = stack.ring_height_mm();
  const auto rings = stack.rings();
  const double level = std::clamp(end_mm / h, 0.0, static_cast<double>(rings.size()));
  const std::size_t first = std::min(static_cast<std::size_t>(level), rings.size() - 1);
  const std::size_t there = up ? rings.size() - first : first + 1;
  const double within = level - static_cast<double>(first);
  const double piece = up ? 1.0 - within : within;  // of the ring that the end lies in
  const double near = std::ceil(std::max(most / h - piece, 0.0)) + 1.0;
  const std::size_t seen =
      near < static_cast<double>(there) ? static_cast<std::size_t>(near) : there;
  FreeWall wall{up || seen < there ? most
                                   : std::min(most, h * (piece + static_cast<double>(seen - 1)))};
  const double per_ring = std::min(h / stop, kMostStops) * kStop;
  double held = 0.0;
  Holds holds;
  for (std::size_t done = 0; done < seen; done += kRows) {
    const std::size_t some = std::min(kRows, seen - done);
    hold(rings.data() + (up ? first + done : first + 1 - done - some), some, per_ring, holds);
    if (done == 0) {
      Quanta& part = holds.rows[up ? 0 : some - 1];
      const auto whole =
          std::exchange(part, static_cast<Quanta>(static_cast<double>(part) * piece));
      holds.sum += part - whole;
    }
    const bool seeks_foot = holds.solid && wall.foot_mm == kNoFoot;
    if (!seeks_foot && held + static_cast<double>(holds.sum) < kStop) {
      held += static_cast<double>(holds.sum);
      continue;
    }
    for (std::size_t k = 0; k < some; ++k) {
      const auto by = static_cast<double>(holds.rows[up ? k : some - 1 - k]);
      const std::size_t i = done + k;
      if (wall.foot_mm == kNoFoot && !(pliancy(rings[up ? first + i : first - i]) > 0.0))
        wall.foot_mm = static_cast<double>(first - i + 1) * h;
      if (held + by >= kStop) {
        const double rest = (kStop - held) / by * (i == 0 ? piece : 1.0);
        wall.length_mm =
            std::min(most, h * (i == 0 ? rest : piece + static_cast<double>(i - 1) + rest));
        return wall;
      }
      held += by;
    }
  }
  return wall;
}

/// Top of the solid clay that a contact reaches down to; far below where it does not.
double foot_of(const ClayStack& stack, const Band& band) noexcept {
  const auto rings = stack.rings();
  const double h = stack.ring_height_mm();
  auto i = static_cast<std::size_t>(
      std::clamp(band.low_mm / h, 0.0, static_cast<double>(rings.size() - 1)));
  if (pliancy(rings[i]) > 0.0) return kNoFoot;
  while (i < band.ring && !(pliancy(rings[i]) > 0.0)) ++i;
  return static_cast<double>(i) * h;
}

/// How much of the wall behind a tool still moves with it. A tool that goes along the wall lays
/// it down as it passes; the wall behind would have to be bent back again. Of the two mechanisms
/// the one that stretches the wall by half the square of the way's slope costs less for slopes
/// below 2 sqrt(w / R).
double trailing(double along_mm_s, double into_mm_s, double thinness) noexcept {
  const double into2 = into_mm_s * into_mm_s + kSlowMmS * kSlowMmS;
  return into2 / (into2 + 4.0 * thinness * along_mm_s * along_mm_s);
}

}  // namespace

Shell shell_at(const ClayStack& stack, const Band& band, double min_wall_mm, double upward_mm_s,
               double into_mm_s) noexcept {
  Shell shell;
  const Wall wall = wall_at(stack, band.peak_mm);
  const double pliant = pliancy(wall.outer * wall.outer, wall.inner * wall.inner);
  if (!(pliant > 0.0 && band.give_mm > 0.0)) return shell;
  const double h = stack.ring_height_mm(), R = wall.outer, w = R - wall.inner;
  const double length = std::min(std::sqrt(R * w), kLongestShellMm);
  const double c = std::max(band.height_mm(), h),
               rim = std::max(stack.height_mm() - band.high_mm, 0.0);
  const double hinge_mm = 0.25 * w;
  const FreeWall down = free_wall(stack, band.low_mm, false, length, hinge_mm);
  const double below = down.length_mm, foot = foot_of(stack, band);
  shell.foot_mm = foot > kNoFoot ? foot : down.foot_mm;
  shell.root_mm = std::max(kRoot * w, h);
  const double above = free_wall(stack, band.high_mm, true, length, hinge_mm).length_mm;

  const double thinness = w / R;
  const double behind = trailing(upward_mm_s, into_mm_s, thinness);
  shell.trail_below = upward_mm_s > 0.0 ? behind : 1.0;
  shell.trail_above = upward_mm_s < 0.0 ? behind : 1.0;

  double hoop = c + shell.trail_below * 0.5 * below;
  double hinge = shell.trail_below * 2.0 / std::max(below, hinge_mm);
  if (rim < length && above >= length) {
    shell.turn = std::clamp(2.0 * rim * rim / (R * w) - 1.0, -1.0, 1.0);
    hoop += shell.trail_above * rim * (1.0 - 0.5 * shell.turn * rim / length);
    hinge += shell.trail_above * (1.0 + shell.turn) / length;
  } else {
    hoop += shell.trail_above * 0.5 * above;
    hinge += shell.trail_above * 2.0 / std::max(above, hinge_mm);
  }
  shell.below_mm = 0.5 * c + below;
  shell.above_mm = 0.5 * c + above;
  const double shift_load = thinness * hoop + 0.25 * w * w * hinge, punch_load = kPunch * c;
  const double ratio = shift_load / punch_load, ratio2 = ratio * ratio;
  const double thinned = band.give_mm * (ratio2 * ratio2 / (1.0 + ratio2 * ratio2));
  // What the minimum wall does not allow to be squeezed out, bends.
  shell.share = pliant * (1.0 - std::min(thinned, std::max(w - min_wall_mm, 0.0)) / band.give_mm);
  return shell;
}

}  // namespace clay
