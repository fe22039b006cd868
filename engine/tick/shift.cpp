#include "engine/tick/shift.hpp"

#include "engine/tick/lanes.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

// Rings that one part of a tick may take out under the rim.
constexpr std::size_t kMostSunk = 64;
// A bore keeps half of its radius at least, however far a pose leaps.
constexpr double kMostOfBore = 0.75;

double smooth(double t) noexcept { return t * t * (3.0 - 2.0 * t); }

/// One ring's change of R^2 and the clay that it gives up [quanta].
struct Move {
  double moved, raised;
};

/// In the plane of the ring: how far `by` moves it, less where its hoops are not thin, and
/// (R^2 - r^2) / (R^2 + r^2), the thickness over the middle radius.
struct Bent {
  double by, thinness;
};
CLAYSTACK_INLINE inline Bent bend_ring(double outer2, double inner2, double by) noexcept {
  const double both = outer2 + inner2;
  const double per_both = 1.0 / both;
  const double fade = pliancy(outer2, inner2);
  return {by * fade, (outer2 - inner2) * per_both};
}

CLAYSTACK_INLINE inline Move push_in(double outer2, double inner2, double by,
                                     double hoop) noexcept {
  const Bent bent = bend_ring(outer2, inner2, by);
  const double outer = rough_root(outer2 * kMm2PerQuantum), u = lesser(bent.by, outer);
  const double q = lesser(u * (2.0 * outer - u) * kQuantaPerMm2, kMostOfBore * inner2);
  const double most = lesser(q, kMostLaneQuanta);
  return {-most, hoop * most * bent.thinness};
}

CLAYSTACK_INLINE inline Move push_out(double outer2, double inner2, double by, double hoop,
                                      double per_min_wall, double largest2) noexcept {
  const Bent bent = bend_ring(outer2, inner2, by);
  const double outer = std::sqrt(outer2 * kMm2PerQuantum);
  const double inner = std::sqrt(inner2 * kMm2PerQuantum);
  const double room = 0.5 * ((outer2 - inner2) * kMm2PerQuantum * per_min_wall - outer - inner);
  const double u = lesser(bent.by, greater(room, 0.0));
  const double q = lesser(u * (2.0 * inner + u) * kQuantaPerMm2, greater(largest2 - outer2, 0.0));
  const double most = lesser(q, kMostLaneQuanta);
  return {most, -hoop * most * bent.thinness};
}

}  // namespace

void Shift::reserve(std::size_t rings) {
  moved_.reserve(rings);
  raised_.reserve(rings);
}

void Shift::clear() noexcept {
  moved_.clear();
  raised_.clear();
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
  const std::size_t rings = std::min(static_cast<std::size_t>(high) - from_, moved_.capacity());
  moved_.resize(rings);
  raised_.resize(rings);
}

void Shift::bend(double h, const Band& band, const Shell& shell, std::size_t first,
                 std::span<double> by) noexcept {
  const double amplitude = shell.share * band.give_mm;
  const double per_below = 1.0 / shell.below_mm;
  const double per_above = greater(shell.turn, 0.0) / shell.above_mm;
  const double flare = greater(-shell.turn, 0.0) / shell.above_mm;
  const double low = amplitude * shell.trail_below, high = amplitude * shell.trail_above;
  const double start = (static_cast<double>(first) + 0.5) * h - band.peak_mm;
  double* const rows = by.data();
  const int count = static_cast<int>(by.size());
  in_lanes([=]() CLAYSTACK_INLINE {
    for (int k = 0; k < count; ++k) {
      const double x = start + static_cast<double>(k) * h;
      const double t = greater(1.0 + lesser(x * per_below, -x * per_above), 0.0);
      rows[k] = (x < 0.0 ? low : high) * (smooth(t) + greater(x, 0.0) * flare);
    }
  });
}

void Shift::move(const ClayStack& stack, const Push& push, std::size_t first,
                 std::span<const double> by) noexcept {
  static const double largest2 = static_cast<double>(quanta_from_radius(kMaxRadiusMm));
  const double hoop = push.hoop ? 0.5 : 0.0, per_min_wall = 1.0 / push.min_wall_mm;
  const std::size_t count = by.size();
  // Copies, which what is written cannot alias.
  in_lanes([=, most = largest2, rings_at = stack.rings().data() + first, by_at = by.data(),
            moved_at = &moved_[first - from_],
            raised_at = &raised_[first - from_]]() CLAYSTACK_INLINE {
    const Ring* __restrict const rings = rings_at;
    const double* __restrict const rows = by_at;
    Quanta* __restrict const moved = moved_at;
    Quanta* __restrict const raised = raised_at;
    const double strain = hoop, per_wall = per_min_wall, largest = most;
    const std::size_t end = count;
    if (push.outward)
      for (std::size_t k = 0; k < end; ++k) {
        const Move m = push_out(lane_double(rings[k].outer2), lane_double(rings[k].inner2), rows[k],
                                strain, per_wall, largest);
        moved[k] = lane_quanta(m.moved);
        raised[k] = lane_quanta(m.raised);
      }
    else
      for (std::size_t k = 0; k < end; ++k) {
        const Move m =
            push_in(lane_double(rings[k].outer2), lane_double(rings[k].inner2), rows[k], strain);
        moved[k] = lane_quanta(m.moved);
        raised[k] = lane_quanta(m.raised);
      }
  });
  Quanta sum = 0;  // of 32 rings: fits
  for (std::size_t k = 0; k < count; ++k) sum += raised_[first - from_ + k];
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
  std::fill(raised_.begin(), raised_.end(), Quanta{0});
  raised_total_ = 0;
}

}  // namespace clay
