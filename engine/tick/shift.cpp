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

double lesser(double a, double b) noexcept { return a < b ? a : b; }
double greater(double a, double b) noexcept { return a > b ? a : b; }
double smooth(double t) noexcept { return t * t * (3.0 - 2.0 * t); }

struct Moved {
  double outer2[32], inner2[32], by[32], moved[32], raised[32];
};

CLAYSTACK_INLINE inline void push_in(Moved& rows, std::size_t count, double hoop) noexcept {
  for (std::size_t k = 0; k < count; ++k) {
    const double outer2 = rows.outer2[k], inner2 = rows.inner2[k];
    const double outer = std::sqrt(outer2 * kMm2PerQuantum);
    const double by = lesser(rows.by[k] * pliancy(outer2, inner2), outer);
    const double q = lesser(by * (2.0 * outer - by) * kQuantaPerMm2, kMostOfBore * inner2);
    rows.moved[k] = -q;
    rows.raised[k] = hoop * q * (outer2 - inner2) / (outer2 + inner2);
  }
}

CLAYSTACK_INLINE inline void push_out(Moved& rows, std::size_t count, double hoop,
                                      double per_min_wall, double largest2) noexcept {
  for (std::size_t k = 0; k < count; ++k) {
    const double outer2 = rows.outer2[k], inner2 = rows.inner2[k];
    const double outer = std::sqrt(outer2 * kMm2PerQuantum);
    const double inner = std::sqrt(inner2 * kMm2PerQuantum);
    const double room = 0.5 * ((outer2 - inner2) * kMm2PerQuantum * per_min_wall - outer - inner);
    const double by = lesser(rows.by[k] * pliancy(outer2, inner2), greater(room, 0.0));
    const double q =
        lesser(by * (2.0 * inner + by) * kQuantaPerMm2, greater(largest2 - outer2, 0.0));
    rows.moved[k] = q;
    rows.raised[k] = -hoop * q * (outer2 - inner2) / (outer2 + inner2);
  }
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

void Shift::bend(double h, const Band& band, const Shell& shell, double amplitude,
                 std::size_t first, std::size_t count, Rows& rows) noexcept {
  const double per_below = 1.0 / shell.below_mm;
  const double per_above = greater(shell.turn, 0.0) / shell.above_mm;
  const double flare = greater(-shell.turn, 0.0) / shell.above_mm;
  const double low = amplitude * shell.trail_below, high = amplitude * shell.trail_above;
  const double start = (static_cast<double>(first) + 0.5) * h - band.peak_mm;
  in_lanes([&]() CLAYSTACK_INLINE {
    for (std::size_t k = 0; k < count; ++k) {
      const double x = start + static_cast<double>(static_cast<int>(k)) * h;
      const double down = greater(1.0 + lesser(x, 0.0) * per_below, 0.0);
      const double up = greater(1.0 - greater(x, 0.0) * per_above, 0.0);
      const double side = x < 0.0 ? low : high;
      rows.by[k] = side * (smooth(down) * smooth(up) + greater(x, 0.0) * flare);
    }
  });
}

void Shift::move(const ClayStack& stack, const Push& push, std::size_t first, std::size_t count,
                 const Rows& rows) noexcept {
  static const double largest2 = static_cast<double>(quanta_from_radius(kMaxRadiusMm));
  Moved moved;
  const auto rings = stack.rings().subspan(first, count);
  for (std::size_t k = 0; k < count; ++k) {
    moved.outer2[k] = static_cast<double>(rings[k].outer2);
    moved.inner2[k] = static_cast<double>(rings[k].inner2);
    moved.by[k] = rows.by[k];
  }
  const double hoop = push.hoop ? 0.5 : 0.0, per_min_wall = 1.0 / push.min_wall_mm;
  in_lanes([&]() CLAYSTACK_INLINE {
    if (push.outward)
      push_out(moved, count, hoop, per_min_wall, largest2);
    else
      push_in(moved, count, hoop);
  });
  const std::size_t at = first - from_;
  for (std::size_t k = 0; k < count; ++k) {
    moved_[at + k] = static_cast<Quanta>(moved.moved[k]);
    raised_[at + k] = static_cast<Quanta>(moved.raised[k]);
    raised_total_ += raised_[at + k];
  }
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
