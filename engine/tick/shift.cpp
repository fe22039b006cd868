#include "engine/tick/shift.hpp"

#include "engine/clay/four.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

// Rings that one part of a tick may take out under the rim.
constexpr std::size_t kMostSunk = 64;
// A bore keeps half of its radius at least, however far a pose leaps.
constexpr double kMostOfBore = 0.75;

CLAYSTACK_INLINE inline Four smooth(Four t) noexcept { return t * t * (3.0 - 2.0 * t); }

/// Some rings. Loops over them are short: a machine has room for about a hundred operations that
/// wait for another, and a root or a quotient in a long loop fills it.
struct Rows {
  static constexpr std::size_t kMost = 128;  // a multiple of eight
  double outer2[kMost], inner2[kMost];       ///< [quanta]
  double by[kMost];                   ///< how far the ring moves, less where it is not thin [mm]
  double thinness[kMost];             ///< (R^2 - r^2) / (R^2 + r^2): thickness over middle radius
  double outer[kMost], inner[kMost];  ///< [mm]
};

CLAYSTACK_INLINE inline void load_rows(Rows& rows, const Ring* rings, std::size_t count) noexcept {
  for (std::size_t k = 0; k < count; k += kFour) {
    const FourRings four = load_four(rings + k, count - k);
    store(rows.outer2 + k, four_doubles(four.outer2));
    store(rows.inner2 + k, four_doubles(four.inner2));
  }
  if (const std::size_t end = in_fours(count); end % (2 * kFour) != 0)
    store(rows.outer2 + end, all_of(1.0));  // roots are taken by eight
}
CLAYSTACK_INLINE inline void bend_rows(Rows& rows, const double* by, std::size_t count) noexcept {
  for (std::size_t k = 0; k < count; k += kFour) {
    const Four outer2 = load_four(rows.outer2 + k), inner2 = load_four(rows.inner2 + k);
    store(rows.by + k, load_four(by + k) * pliancy(outer2, inner2));
  }
  for (std::size_t k = 0; k < count; k += kFour) {
    const Four outer2 = load_four(rows.outer2 + k), inner2 = load_four(rows.inner2 + k);
    const Four per_both = 1.0 / (outer2 + inner2);
    store(rows.thinness + k, (outer2 - inner2) * per_both);
  }
}

CLAYSTACK_INLINE inline Four pushed_in(const Rows& rows, std::size_t k) noexcept {
  const Four outer = load_four(rows.outer + k), u = lesser(load_four(rows.by + k), outer);
  const Four q = u * (2.0 * outer - u) * kQuantaPerMm2;
  return lesser(lesser(q, kMostOfBore * load_four(rows.inner2 + k)), kMostLaneQuanta);
}
CLAYSTACK_INLINE inline Four pushed_out(const Rows& rows, std::size_t k, double per_min_wall,
                                        double largest2) noexcept {
  const Four outer2 = load_four(rows.outer2 + k), inner2 = load_four(rows.inner2 + k);
  const Four outer = load_four(rows.outer + k), inner = load_four(rows.inner + k);
  const Four room = 0.5 * ((outer2 - inner2) * kMm2PerQuantum * per_min_wall - outer - inner);
  const Four u = lesser(load_four(rows.by + k), greater(room, 0.0));
  const Four q = u * (2.0 * inner + u) * kQuantaPerMm2;
  return lesser(lesser(q, greater(largest2 - outer2, 0.0)), kMostLaneQuanta);
}

/// Four rings' change of R^2 and r^2, q of both and less by the clay that they give up [quanta].
CLAYSTACK_INLINE inline FourQuanta change_rows(const Rows& rows, std::size_t k, Four q, double hoop,
                                               Ring* changes) noexcept {
  const FourQuanta moved = four_quanta(q);
  const FourQuanta raised = four_quanta(hoop * q * load_four(rows.thinness + k));
  store(changes + k, FourRings{moved, moved + raised});
  return raised;
}

}  // namespace

void Shift::reserve(std::size_t rings) { changes_.resize(in_fours(rings)); }

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
  // Within what was reserved: a band and a shell on either side of it.
  count_ = std::min(static_cast<std::size_t>(high) - from_, changes_.size());
}

void Shift::bend(double h, const Band& band, const Shell& shell, std::size_t first,
                 std::size_t count, double* by) noexcept {
  const double amplitude = shell.share * band.give_mm;
  const double per_below = 1.0 / shell.below_mm;
  const double per_above = greater(shell.turn, 0.0) / shell.above_mm;
  const double flare = greater(-shell.turn, 0.0) / shell.above_mm;
  const double low = amplitude * shell.trail_below, high = amplitude * shell.trail_above;
  const double start = (static_cast<double>(first) + 0.5) * h - band.peak_mm;
  in_lanes([=]() CLAYSTACK_INLINE {
    for (std::size_t k = 0; k < count; k += kFour) {
      const Four x = start + load_four(&kLevels[k]) * h;
      const Four t = greater(1.0 + lesser(x * per_below, -x * per_above), 0.0);
      const Four side = x < 0.0 ? all_of(low) : all_of(high);
      store(by + k, side * (smooth(t) + greater(x, 0.0) * flare));
    }
  });
}

void Shift::move(const ClayStack& stack, const Push& push, std::size_t first, std::size_t count,
                 const double* by) noexcept {
  static const double largest2 = static_cast<double>(quanta_from_radius(kMaxRadiusMm));
  Rows rows;
  Quanta sum = 0;  // of 128 rings: fits
  in_lanes([=, r = &rows, rings = stack.rings().data() + first, changes = &changes_[first - from_],
            hoop = push.hoop ? 0.5 : 0.0, per_min_wall = 1.0 / push.min_wall_mm,
            outward = push.outward, most = largest2, total = &sum]() CLAYSTACK_INLINE {
    load_rows(*r, rings, count);
    bend_rows(*r, by, count);
    FourQuanta raised{};
    const auto add = [&](std::size_t k, FourQuanta more) CLAYSTACK_INLINE {
      raised += row_numbers(k) < static_cast<Quanta>(count) ? more : FourQuanta{};
    };
    if (outward) {
      for (std::size_t k = 0; k < count; k += kFour) {
        store(r->outer + k, root(load_four(r->outer2 + k) * kMm2PerQuantum));
        store(r->inner + k, root(load_four(r->inner2 + k) * kMm2PerQuantum));
      }
      for (std::size_t k = 0; k < count; k += kFour)
        add(k, change_rows(*r, k, pushed_out(*r, k, per_min_wall, most), -hoop, changes));
    } else {
      for (std::size_t k = 0; k < count; k += 2 * kFour) {
        const EightFloats outer =
            root(eight_floats(load_four(r->outer2 + k) * kMm2PerQuantum,
                              load_four(r->outer2 + k + kFour) * kMm2PerQuantum));
        store(r->outer + k, four_doubles(low_half(outer)));
        store(r->outer + k + kFour, four_doubles(high_half(outer)));
      }
      for (std::size_t k = 0; k < count; k += kFour)
        add(k, change_rows(*r, k, -pushed_in(*r, k), -hoop, changes));
    }
    *total = raised[0] + raised[1] + raised[2] + raised[3];
  });
  raised_total_ += sum;
}

/// A wall that sinks must find its clay above it.
void Shift::settle(const ClayStack& stack) noexcept {
  if (raised_total_ >= 0) return;
  WideQuanta found = stack.crown();
  const auto rings = stack.rings();
  for (std::size_t k = 1; k <= kMostSunk && found + raised_total_ < 0 && k < rings.size(); ++k)
    found += after(rings.size() - k, rings[rings.size() - k]).volume();
  if (found + raised_total_ >= 0) return;
  for (Ring& change : std::span(changes_).first(count_)) change.inner2 = change.outer2;
  raised_total_ = 0;
}

}  // namespace clay
