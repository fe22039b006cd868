#include "engine/tick/shell.hpp"

#include "engine/clay/packs.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

constexpr double kPunch = 2.570796326794897;  // (2 + pi) / 2: a flat punch on a Tresca half-space
constexpr double kNoFoot = -1e300;
constexpr double kRoot = 0.5;  // of the wall: height up to which solid clay holds it

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

constexpr std::size_t kRows = 32;

/// The stiffness of rings, from 0 (pliant) to 1 (solid): the sum and the maximum.
struct Stiffness {
  float sum, most;
};
Stiffness stiffness_of(const float* outer, const float* inner, std::size_t count) noexcept {
  Stiffness stiffness{};
  in_packs([=, to = &stiffness](auto n) CLAYSTACK_INLINE {
    using F = TwiceFloats<n>;
    const auto of_pack = [=](std::size_t k) CLAYSTACK_INLINE {
      const F bore = load_floats<n>(inner + k) / load_floats<n>(outer + k);
      return F(1.0f - pliancy(F(bore * bore)));
    };
    F sum{}, most{};
    std::size_t k = 0;
    for (; k + 2 * n <= count; k += 2 * n) {
      const F stiff = of_pack(k);
      sum += stiff;
      most = greater(most, stiff);
    }
    if (k < count) {
      const auto left = static_cast<float>(static_cast<int>(count - k));
      const F stiff = load_floats<n>(&kFloatLevels[0]) < left ? of_pack(k) : F{};
      sum += stiff;
      most = greater(most, stiff);
    }
    *to = {sum_of(sum), most_of(most)};
  });
  return stiffness;
}

/// Whether all rings are pliant, without a quotient: r > 0.395 R is r^2 > 0.15625 R^2, with a
/// margin for rounding. Most rings of a thrown wall are.
bool all_pliant(const float* outer, const float* inner, std::size_t count) noexcept {
  bool pliant = false;
  in_packs([=, to = &pliant](auto n) CLAYSTACK_INLINE {
    using F = TwiceFloats<n>;
    constexpr float kThinBore = 0.3953f;
    const auto margin = [=](std::size_t k) CLAYSTACK_INLINE {
      return F(load_floats<n>(inner + k) - kThinBore * load_floats<n>(outer + k));
    };
    F least = margin(0);
    std::size_t k = 2 * n;
    for (; k + 2 * n <= count; k += 2 * n) least = lesser(least, margin(k));
    if (count > 2 * n) least = lesser(least, margin(count - 2 * n));
    *to = least_of(least) > 0.0f;
  });
  return pliant;
}

/// The contribution of each of these rings, at most `kRows`, to a stop: nothing where it is pliant.
void stops_of(const Ring* rings, std::size_t count, double per_stop, double* stops) noexcept {
  in_packs([=](auto n) CLAYSTACK_INLINE {
    for (std::size_t k = 0; k < count; k += n) {
      const RingPack<n> pack = load_rings<n>(rings + k, count - k);
      const Doubles<n> bore2 = doubles_of(pack.inner2) / doubles_of(pack.outer2);
      store(stops + k, Doubles<n>(per_stop * (1.0 - pliancy(bore2))));
    }
  });
}

/// Whether nothing holds the wall within `most`, decided without a look at each of its rings: ring
/// `first` and those above or below it, of which `there` are in the stack. May return false where
/// nothing holds it, but not for most walls. `free_length` sees two rings less.
bool surely_free(const ClayStack& stack, WallRadii& walls, std::size_t first, std::size_t there,
                 bool up, double most, double per_stop, bool needs_foot) noexcept {
  const double h = stack.ring_height_mm();
  const auto wanted = static_cast<std::size_t>(most / h) + 3;
  const std::size_t seen = std::min(wanted, there);
  if (!up && seen < wanted) return false;  // the wheel holds it
  const std::size_t from = up ? first : first + 1 - seen;
  walls.cover(stack, from, from + seen);
  if (all_pliant(walls.outer(from), walls.inner(from), seen)) return true;
  const Stiffness stiffness = stiffness_of(walls.outer(from), walls.inner(from), seen);
  if (needs_foot && stiffness.most >= 1.0f) return false;
  // Far enough from a stop for sums of any order.
  return static_cast<double>(stiffness.sum) * h * per_stop < 0.99;
}

/// Free length of the wall from an end of the band [mm]: to the floor, to a solid part, or at least
/// `most`. `foot_mm`: the top of the first solid ring below, if there is one.
double free_length(const ClayStack& stack, WallRadii& walls, double end_mm, bool up, double most,
                   double stop, double* foot_mm = nullptr) noexcept {
  const double h = stack.ring_height_mm(), per_stop = 1.0 / stop;
  const auto rings = stack.rings();
  const double level = std::clamp(end_mm / h, 0.0, static_cast<double>(rings.size()));
  const std::size_t first = std::min(static_cast<std::size_t>(level), rings.size() - 1);
  const std::size_t there = up ? rings.size() - first : first + 1;
  if (surely_free(stack, walls, first, there, up, most, per_stop, foot_mm != nullptr)) return most;
  const double within = level - static_cast<double>(first);
  double piece = h * (up ? 1.0 - within : within);  // of the ring that the end lies in
  alignas(kPackBytes) double stops[kRows];
  double length = 0.0, stopped = 0.0;
  for (std::size_t done = 0; length < most; done += kRows) {
    if (done >= there) return up ? most : length;  // no clay above the rim holds the wall
    const std::size_t some = std::min(kRows, there - done);
    const Ring* const from = rings.data() + (up ? first + done : first + 1 - done - some);
    stops_of(from, some, h * per_stop, stops);
    if (done == 0) stops[up ? 0 : some - 1] = piece * per_stop * (1.0 - pliancy(rings[first]));
    for (std::size_t k = 0; k < some && length < most; ++k) {
      const std::size_t ring = up ? first + done + k : first - done - k;
      if (foot_mm != nullptr && !(pliancy(rings[ring]) > 0.0)) {
        *foot_mm = static_cast<double>(ring + 1) * h;
        foot_mm = nullptr;
      }
      const double by = stops[up ? k : some - 1 - k];
      if (stopped + by >= 1.0) return std::min(most, length + piece * (1.0 - stopped) / by);
      stopped += by;
      length += piece;
      piece = h;
    }
  }
  return most;
}

/// Top of the solid clay, if the contact reaches down to it; otherwise kNoFoot, far below.
double foot_of(const ClayStack& stack, const Band& band) noexcept {
  const auto rings = stack.rings();
  const double h = stack.ring_height_mm();
  auto i = static_cast<std::size_t>(
      std::clamp(band.low_mm / h, 0.0, static_cast<double>(rings.size() - 1)));
  if (pliancy(rings[i]) > 0.0) return kNoFoot;
  while (i < band.ring && !(pliancy(rings[i]) > 0.0)) ++i;
  return static_cast<double>(i) * h;
}

/// The part by which the wall behind a tool still moves with it. A tool that moves along the wall
/// leaves it in place; the wall behind would have to be bent back. Of the two mechanisms the one
/// that stretches the wall by half the square of the path's slope costs less for slopes below 2
/// sqrt(w / R).
double trailing(double along_mm_s, double into_mm_s, double thinness) noexcept {
  const double into2 = into_mm_s * into_mm_s + kSlowMmS * kSlowMmS;
  return into2 / (into2 + 4.0 * thinness * along_mm_s * along_mm_s);
}

}  // namespace

void hold_foot(const Shell& shell, double h, std::size_t first, std::span<float> by) noexcept {
  const double start = (static_cast<double>(first) + 0.5) * h;
  const double held_to = shell.foot_mm + 2.0 * shell.root_mm;  // `hold` is 1 well below that
  for (std::size_t k = 0; k < by.size(); ++k) {
    const double up = start + static_cast<double>(k) * h;
    if (up > held_to) return;
    by[k] *= static_cast<float>(shell.hold(up));
  }
}

Shell shell_at(const ClayStack& stack, WallRadii& walls, const Band& band, double min_wall_mm,
               double upward_mm_s, double into_mm_s) noexcept {
  Shell shell;
  const Wall wall = wall_at(stack, band.peak_mm);
  const double bore = wall.inner / wall.outer, pliant = pliancy(bore * bore);
  if (!(pliant > 0.0 && band.give_mm > 0.0)) return shell;
  const double h = stack.ring_height_mm(), R = wall.outer, w = R - wall.inner;
  const double length = std::min(std::sqrt(R * w), kLongestShellMm);
  const double c = std::max(band.height_mm(), h),
               rim = std::max(stack.height_mm() - band.high_mm, 0.0);
  const double hinge_mm = 0.25 * w;
  double foot = foot_of(stack, band);
  const double below = free_length(stack, walls, band.low_mm, false, length, hinge_mm,
                                   foot > kNoFoot ? nullptr : &foot);
  shell.foot_mm = foot;
  shell.root_mm = std::max(kRoot * w, h);
  const double above = free_length(stack, walls, band.high_mm, true, length, hinge_mm);

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
  shell.wall_mm = w;
  shell.below_mm = 0.5 * c + below;
  shell.above_mm = 0.5 * c + above;
  const double shift_load = thinness * hoop + 0.25 * w * w * hinge, punch_load = kPunch * c;
  const double ratio = shift_load / punch_load, ratio2 = ratio * ratio;
  const double thinned = band.give_mm * (ratio2 * ratio2 / (1.0 + ratio2 * ratio2));
  // Clay that cannot be squeezed out, because of the minimum wall, bends.
  shell.share = pliant * (1.0 - std::min(thinned, std::max(w - min_wall_mm, 0.0)) / band.give_mm);
  return shell;
}

}  // namespace clay
