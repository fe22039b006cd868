#include "engine/tick/shift.hpp"

#include "engine/clay/packs.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

// A bore keeps half of its radius at least, even if a pose jumps far.
constexpr float kMostOfBore = 0.75f;
// The part of the wall's thickness, above and below the peak, over which one trail passes into the
// other.
constexpr double kBlend = 0.45;
// Bound of the relative error of a radius in single precision.
constexpr float kRounding = 1e-6f;
constexpr float kLargest2 = static_cast<float>(kMaxRadiusMm * kMaxRadiusMm) * (1.0f - kRounding);
constexpr float kSmallest2 = static_cast<float>(kMinRadiusMm * kMinRadiusMm) * (1.0f + kRounding);
constexpr float kMost = static_cast<float>(kMostLaneQuanta * kMm2PerQuantum);  // for conversions

/// Decrease of R^2 and r^2 of some rings [mm^2] where the wall is pushed in by u: no R becomes less
/// than the smallest radius.
template <class F>
CLAYSTACK_INLINE inline F pushed_in(F outer, F inner, F u) noexcept {
  const F spare = outer * outer * (1.0f - kRounding) - kSmallest2;
  return lesser(F(lesser(u, outer) * (2.0f * outer - lesser(u, outer))),
                F(lesser(F(kMostOfBore * inner * inner), F(spare > 0.0f ? spare : F{}))));
}
/// Increase of R^2 and r^2 [mm^2] where the wall is pushed out by u: not beyond the largest radius,
/// and no wall becomes thinner than the minimum.
template <class F>
CLAYSTACK_INLINE inline F pushed_out(F outer, F inner, F u, float per_min_wall) noexcept {
  const F wall = outer - inner - kRounding * outer;
  const F room = 0.5f * ((outer + inner) * (wall * per_min_wall - 1.0f));
  const F by = lesser(u, F(room > 0.0f ? room : F{}));
  const F left = kLargest2 - outer * outer;
  return lesser(F(by * (2.0f * inner + by)), F(left > 0.0f ? left : F{}));
}

// The motion of rings, in three short loops: with one long chain of operations the processor works
// on few rows at once.

/// Less where the wall is not thin. `rises`: (R^2 - r^2) / (R^2 + r^2); times the change of R^2 it
/// is the clay of the hoop strain. Returns whether some wall is so thin that this is rounding.
template <std::size_t n>
CLAYSTACK_INLINE inline bool soften(const float* outers, const float* inners, std::size_t count,
                                    float* by, float* rises) noexcept {
  using F = TwiceFloats<n>;
  F most{};
  for (std::size_t k = 0; k < count; k += 2 * n) {
    const F bore = load_floats<n>(inners + k) / load_floats<n>(outers + k), bore2 = bore * bore;
    store(by + k, F(load_floats<n>(by + k) * pliancy(bore2)));
    store(rises + k, F((1.0f - bore2) / (1.0f + bore2)));
    most = greater(bore2, most);
  }
  return most_of(most) > 1.0f - 8.0f * kRounding;
}
/// A ring that is thicker or wider than the rim raises it by no more height than its own.
template <std::size_t n>
CLAYSTACK_INLINE inline void limit_rise(const float* outers, const float* inners, std::size_t count,
                                        float rim_mm2, float* rises) noexcept {
  using F = TwiceFloats<n>;
  for (std::size_t k = 0; k < count; k += 2 * n) {
    const F outer = load_floats<n>(outers + k), inner = load_floats<n>(inners + k);
    store(rises + k,
          lesser(load_floats<n>(rises + k), F(rim_mm2 / (outer * outer + inner * inner))));
  }
}
/// From mm to the change of R^2 and r^2 [mm^2].
template <std::size_t n>
CLAYSTACK_INLINE inline void square(const float* outers, const float* inners, std::size_t count,
                                    bool outward, float per_min_wall, float* by) noexcept {
  using F = TwiceFloats<n>;
  for (std::size_t k = 0; k < count; k += 2 * n) {
    const F outer = load_floats<n>(outers + k), inner = load_floats<n>(inners + k);
    const F u = load_floats<n>(by + k);
    const F way = outward ? pushed_out(outer, inner, u, per_min_wall) : -pushed_in(outer, inner, u);
    store(by + k, lesser(greater(way, F(F{} - kMost)), F(F{} + kMost)));
  }
}
/// The same outward, where the wall keeps its minimum, or its thickness if that is less: R^2 grows
/// by more, and this clay comes from above. At the largest radius it does not move. Afterwards
/// `rises` is the part of `by` that becomes height.
template <std::size_t n>
CLAYSTACK_INLINE inline void stretch(const float* outers, const float* inners, std::size_t count,
                                     float hoop, float min_wall, float* by, float* rises) noexcept {
  using F = TwiceFloats<n>;
  for (std::size_t k = 0; k < count; k += 2 * n) {
    const F outer = load_floats<n>(outers + k), inner = load_floats<n>(inners + k);
    const F u = load_floats<n>(by + k), outer2 = outer * outer, wall = outer - inner;
    const F q = u * (2.0f * inner + u), given = -hoop * q * load_floats<n>(rises + k);
    const F rounding = kRounding * outer, far = root(F(outer2 + q));
    const F thick = wall > min_wall - rounding ? F(min_wall + rounding) : wall;
    const F lack = thick - far + root(F(inner * inner + q + given));
    const F more = lack > 0.0f && u > 0.0f ? F(lack * (2.0f * far + lack)) : F{};
    const F most = lesser(F(kLargest2 - outer2), F(F{} + kMost));
    const auto fits = greater(F(q + more), F(more - given)) <= most;
    const F moved = fits ? F(q + more) : F{};
    store(by + k, moved);
    store(rises + k, moved > 0.0f ? F((given - more) / moved) : F{});
  }
}

}  // namespace

void Shift::reserve(std::size_t rings) { changes_.resize(in_packs_of(rings)); }

void Shift::clear() noexcept {
  count_ = 0;
  raised_total_ = 0;
}

void Shift::begin(const ClayStack& stack, const Band& band, const Shell& shell) noexcept {
  clear();
  const double h = stack.ring_height_mm(), count = static_cast<double>(stack.size());
  const double above = shell.above_mm / std::max(shell.turn, 1e-3);
  const double low = std::clamp(std::floor((band.peak_mm - shell.below_mm) / h), 0.0, count - 1.0);
  const double high = std::clamp(std::ceil((band.peak_mm + above) / h), low + 1.0, count);
  from_ = static_cast<std::size_t>(low);
  // Within the reserved storage: a band and a shell on either side of it.
  count_ = std::min(static_cast<std::size_t>(high) - from_, changes_.size());
}

void Shift::bend(double h, const Band& band, const Shell& shell, std::size_t first,
                 std::size_t count, float* by) noexcept {
  const double amplitude = shell.share * band.give_mm, turn = shell.turn / shell.above_mm;
  const auto single = [](double x) { return static_cast<float>(x); };
  in_packs([=, start = single((static_cast<double>(first) + 0.5) * h - band.peak_mm),
            step = single(h), per_below = single(1.0 / shell.below_mm),
            per_above = single(greater(turn, 0.0)), flare = single(greater(-turn, 0.0)),
            most = single(amplitude)](auto n) CLAYSTACK_INLINE {
    using F = TwiceFloats<n>;
    for (std::size_t k = 0; k < count; k += 2 * n) {
      const F x = start + load_floats<n>(&kFloatLevels[k]) * step, ahead = x > 0.0f ? x : F{};
      const F in = 1.0f - ahead * per_above + (x - ahead) * per_below;
      store(by + k, F(most * (smooth(F(in > 0.0f ? in : F{})) + ahead * flare)));
    }
  });
}

void Shift::trail(double h, const Band& band, const Shell& shell, std::size_t first,
                  std::size_t count, float* by) noexcept {
  const auto single = [](double x) { return static_cast<float>(x); };
  const double per_mm = 0.5 / std::max(kBlend * shell.wall_mm, h);
  const double start = (static_cast<double>(first) + 0.5) * h - band.peak_mm;
  in_packs([=, start = single(0.5 + start * per_mm), step = single(h * per_mm),
            low = single(shell.trail_below),
            more = single(shell.trail_above - shell.trail_below)](auto n) CLAYSTACK_INLINE {
    using F = TwiceFloats<n>;
    for (std::size_t k = 0; k < count; k += 2 * n) {
      const F t = start + load_floats<n>(&kFloatLevels[k]) * step;
      const F within = lesser(greater(t, F{}), F(F{} + 1.0f));
      store(by + k, F(load_floats<n>(by + k) * (low + more * smooth(within))));
    }
  });
}

void Shift::move(const ClayStack& stack, const WallRadii& walls, const Push& push,
                 std::size_t first, std::size_t count, float* by) noexcept {
  Quanta sum = 0;  // of 128 rings: fits
  bool hair_thin = false;
  alignas(kPackBytes) float rises[kRows];
  in_packs([=, outers = walls.outer(first), inners = walls.inner(first), rises = &rises[0],
            changes = &changes_[first - from_], hoop = push.hoop ? 0.5f : 0.0f,
            per_min_wall = static_cast<float>(1.0 / push.min_wall_mm),
            min_wall = static_cast<float>(push.min_wall_mm),
            rim_mm2 = push.rim.waits ? 0.0f : static_cast<float>(push.rim.ring_mm2),
            limited = push.rim.limits(), outward = push.outward,
            stretches = push.outward && push.stretch, total = &sum,
            thin = &hair_thin](auto n) CLAYSTACK_INLINE {
    *thin = soften<n>(outers, inners, count, by, rises);
    if (limited) limit_rise<n>(outers, inners, count, rim_mm2, rises);
    if (stretches)
      stretch<n>(outers, inners, count, hoop, min_wall, by, rises);
    else
      square<n>(outers, inners, count, outward, per_min_wall, by);
    const float height = stretches ? 1.0f : -hoop;
    Quantas<n> raised{};
    for (std::size_t k = 0; k < count; k += 2 * n) {
      const auto q = load_floats<n>(by + k);
      // Clay that is pushed up.
      const auto given = halves<n>(TwiceFloats<n>(height * q * load_floats<n>(rises + k)));
      const auto moved = halves<n>(q);
      for (std::size_t half = 0; half < 2; ++half) {
        const Quantas<n> by_q = quanta_of(Doubles<n>(moved[half] * kQuantaPerMm2));
        const Quantas<n> more = quanta_of(Doubles<n>(given[half] * kQuantaPerMm2));
        raised += more;
        store(changes + k + half * n, RingPack<n>{by_q, by_q + more});
      }
    }
    *total = sum_of(raised);
  });
  raised_total_ += sum;
  if (hair_thin) keep_quanta(stack.rings(), first, count);
}

/// Every ring keeps a quantum in spite of rounding.
void Shift::keep_quanta(std::span<const Ring> rings, std::size_t first,
                        std::size_t count) noexcept {
  for (std::size_t i = first; i < first + count; ++i) {
    Ring& change = changes_[i - from_];
    const Quanta too_much = change.inner2 - change.outer2 - (rings[i].volume() - 1);
    if (too_much <= 0) continue;
    change.inner2 -= too_much;
    raised_total_ -= too_much;
  }
}

/// The stretch rounds up to single precision, which would push a wall between two tools into the
/// outer one.
void Shift::keep_thickness(const ClayStack& stack, std::size_t first, std::size_t end) noexcept {
  for (std::size_t i = std::max(first, from_); i < std::min(end, to()); ++i) {
    const Ring &was = stack.rings()[i], is = after(i, was);
    const double wall = wall_mm(was);
    if (!(wall_mm(is) > wall)) continue;
    const Quanta less = is.outer2 - quanta_from_radius(is.inner_mm() + wall);
    if (less <= 0) continue;
    changes_[i - from_].outer2 -= less;
    raised_total_ += less;
  }
}

/// A wall that sinks needs its clay above it. Without that it does not sink: it thins, or, if it
/// would have to stretch, stays in place.
void Shift::settle(const ClayStack& stack, bool stretch) noexcept {
  if (raised_total_ >= 0) return;
  WideQuanta found = stack.crown();
  const auto rings = stack.rings();
  for (std::size_t k = 1; k <= kMostSunk && found + raised_total_ < 0 && k < rings.size(); ++k)
    found += after(rings.size() - k, rings[rings.size() - k]).volume();
  if (found + raised_total_ >= 0) return;
  if (stretch) return clear();
  for (Ring& change : std::span(changes_).first(count_)) change.inner2 = change.outer2;
  raised_total_ = 0;
}

}  // namespace clay
