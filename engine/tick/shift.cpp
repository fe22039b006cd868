#include "engine/tick/shift.hpp"

#include "engine/clay/packs.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

// Rings that one part of a tick may take out under the rim.
constexpr std::size_t kMostSunk = 64;
// A bore keeps half of its radius at least, however far a pose leaps.
constexpr double kMostOfBore = 0.75;

template <class Number>
CLAYSTACK_INLINE inline Number smooth(Number t) noexcept {
  return t * t * (3.0 - 2.0 * t);
}

/// Some rings. Loops over them are short: a machine has room for about a hundred operations that
/// wait for another, and a root or a quotient in a long loop fills it.
struct Rows {
  static constexpr std::size_t kMost = 128;                 // a multiple of eight
  alignas(kPackBytes) double outer2[kMost], inner2[kMost];  ///< [quanta]
  double thinness[kMost];             ///< (R^2 - r^2) / (R^2 + r^2): thickness over middle radius
  double outer[kMost], inner[kMost];  ///< [mm]
};

/// Rings that are not thin move less than `by`.
template <std::size_t n>
CLAYSTACK_INLINE inline void load_rows(Rows& rows, const Ring* rings, double* by,
                                       std::size_t count) noexcept {
  Quantas<n> spare{};  // negative if one of them is
  for (std::size_t k = 0; k < count; k += n) {
    const RingPack<n> pack = load_rings<n>(rings + k, count - k);
    const auto outer2 = doubles_of(pack.outer2), inner2 = doubles_of(pack.inner2);
    store(rows.outer2 + k, outer2);
    store(rows.inner2 + k, inner2);
    spare |= spare_bore(pack.outer2, pack.inner2);
    const Doubles<n> per_both = 1.0 / (outer2 + inner2);
    store(rows.thinness + k, (outer2 - inner2) * per_both);
  }
  if (any(spare < 0))
    for (std::size_t k = 0; k < count; k += n)
      store(by + k, load_doubles<n>(by + k) * pliancy(load_doubles<n>(rows.outer2 + k),
                                                      load_doubles<n>(rows.inner2 + k)));
  const std::size_t end = (count + n - 1) / n * n;
  if (end % (2 * n) != 0) store(rows.outer2 + end, all_of<Doubles<n>>(1.0));  // for roots of 2 n
}

template <std::size_t n>
CLAYSTACK_INLINE inline Doubles<n> pushed_in(const Rows& rows, const double* by,
                                             std::size_t k) noexcept {
  const auto outer = load_doubles<n>(rows.outer + k);
  const auto u = lesser(load_doubles<n>(by + k), outer);
  const Doubles<n> q = u * (2.0 * outer - u) * kQuantaPerMm2;
  const Doubles<n> most = kMostOfBore * load_doubles<n>(rows.inner2 + k);
  return lesser(lesser(q, most), kMostLaneQuanta);
}
template <std::size_t n>
CLAYSTACK_INLINE inline Doubles<n> pushed_out(const Rows& rows, const double* by, std::size_t k,
                                              double per_min_wall, double largest2) noexcept {
  const auto outer2 = load_doubles<n>(rows.outer2 + k), inner2 = load_doubles<n>(rows.inner2 + k);
  const auto outer = load_doubles<n>(rows.outer + k), inner = load_doubles<n>(rows.inner + k);
  const Doubles<n> room = 0.5 * ((outer2 - inner2) * kMm2PerQuantum * per_min_wall - outer - inner);
  const auto u = lesser(load_doubles<n>(by + k), greater(room, 0.0));
  const Doubles<n> q = u * (2.0 * inner + u) * kQuantaPerMm2, left = largest2 - outer2;
  return lesser(lesser(q, greater(left, 0.0)), kMostLaneQuanta);
}

/// A pack's change of R^2 and r^2, q of both and less by the clay that they give up [quanta].
template <std::size_t n>
CLAYSTACK_INLINE inline Quantas<n> change_rows(const Rows& rows, std::size_t k, Doubles<n> q,
                                               double hoop, Ring* changes) noexcept {
  const Quantas<n> moved = quanta_of(q);
  const Doubles<n> part = hoop * q * load_doubles<n>(rows.thinness + k);
  const Quantas<n> raised = quanta_of(part);
  store(changes + k, RingPack<n>{moved, moved + raised});
  return raised;
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
  in_packs([=, peak = band.peak_mm](auto n) CLAYSTACK_INLINE {
    for (std::size_t k = 0; k < count; k += n) {
      const std::size_t from = k / kBent * kBent;
      const double start = (static_cast<double>(first + from) + 0.5) * h - peak;
      const Doubles<n> x = start + load_doubles<n>(&kLevels[k - from]) * h;
      const Doubles<n> down = x * per_below, up = -x * per_above, in = 1.0 + lesser(down, up);
      const Doubles<n> side = x < 0.0 ? all_of<Doubles<n>>(low) : all_of<Doubles<n>>(high);
      store(by + k, side * (smooth(greater(in, 0.0)) + greater(x, 0.0) * flare));
    }
  });
}

void Shift::move(const ClayStack& stack, const Push& push, std::size_t first, std::size_t count,
                 double* by) noexcept {
  static const double largest2 = static_cast<double>(quanta_from_radius(kMaxRadiusMm));
  Rows rows;
  Quanta sum = 0;  // of 128 rings: fits
  in_packs([=, r = &rows, rings = stack.rings().data() + first, changes = &changes_[first - from_],
            hoop = push.hoop ? 0.5 : 0.0, per_min_wall = 1.0 / push.min_wall_mm,
            outward = push.outward, most = largest2, total = &sum](auto n) CLAYSTACK_INLINE {
    load_rows<n>(*r, rings, by, count);
    Quantas<n> raised{};
    const auto add = [&](std::size_t k, Quantas<n> more) CLAYSTACK_INLINE {
      if (k + n > count)
        for (std::size_t row = count - k; row < n; ++row) more[row] = 0;
      raised += more;
    };
    if (outward) {
      for (std::size_t k = 0; k < count; k += n) {
        store(r->outer + k, root(load_doubles<n>(r->outer2 + k) * kMm2PerQuantum));
        store(r->inner + k, root(load_doubles<n>(r->inner2 + k) * kMm2PerQuantum));
      }
      for (std::size_t k = 0; k < count; k += n)
        add(k, change_rows<n>(*r, k, pushed_out<n>(*r, by, k, per_min_wall, most), -hoop, changes));
    } else {
      for (std::size_t k = 0; k < count; k += 2 * n) {
        const Doubles<n> low = load_doubles<n>(r->outer2 + k) * kMm2PerQuantum;
        const Doubles<n> high = load_doubles<n>(r->outer2 + k + n) * kMm2PerQuantum;
        const TwiceFloats<n> outer = root(floats(low, high));
        store(r->outer + k, doubles<n>(low_half<n>(outer)));
        store(r->outer + k + n, doubles<n>(high_half<n>(outer)));
      }
      for (std::size_t k = 0; k < count; k += n)
        add(k, change_rows<n>(*r, k, -pushed_in<n>(*r, by, k), -hoop, changes));
    }
    *total = sum_of(raised);
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
