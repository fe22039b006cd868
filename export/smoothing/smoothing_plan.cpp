#include "export/smoothing/smoothing_plan.hpp"

#include "core/cancel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace clay::solid::inline smoothing {
namespace {

constexpr double kNotKept = std::numeric_limits<double>::infinity();

constexpr char kMaxRefinement = 4;
constexpr double kRefinementRatio = 0.125;

/// Of the length of the fairing. Faired over l, a step d bends by d (2 pi / l)^2 / (3 sqrt 3) at
/// most, so below this part of l its radius is over 2 l: no corner that a tool could have made. A
/// cut there would stop the fairing, and a tooth of the noise would remain.
constexpr double kLeastCorner = 1.0 / 16.0;

}  // namespace

void KeptStretches::add(std::size_t interface, double figure) {
  if (least_.empty()) least_.assign(piece_.size() + 1, kNotKept);
  least_[interface] = std::min(least_[interface], figure);
}

std::vector<char> KeptStretches::rings() const {
  std::vector<char> flags(piece_.size(), 0);
  for (std::size_t k = 1; k < least_.size(); ++k)
    if (least_[k] != kNotKept) flags[k - 1] = flags[std::min(k, piece_.size() - 1)] = 1;
  return flags;
}

void KeptStretches::report(KeptFor reason, const std::vector<double>& walls_mm,
                           std::vector<KeptSteps>& reports) const {
  for (std::size_t k = 0; k < least_.size(); ++k) {
    if (least_[k] == kNotKept) continue;
    const std::size_t first = k;
    double figure = least_[k];
    while (k + 1 < least_.size() && least_[k + 1] != kNotKept)
      figure = std::min(figure, least_[++k]);
    KeptSteps kept{piece_.level[first], piece_.level[k], reason, std::abs(figure), 0.0};
    if (!walls_mm.empty()) {
      const auto begin = walls_mm.begin();
      kept.kept_mm = *std::min_element(begin + static_cast<std::ptrdiff_t>(first - 1),
                                       begin + static_cast<std::ptrdiff_t>(k + 1));
    }
    reports.push_back(kept);
  }
}

SmoothingPlan::SmoothingPlan(const PieceWalls& piece, double length_mm, double tolerance_mm)
    : piece_(piece),
      length_mm_(length_mm),
      cuts_(corners_of(piece, std::max(kLeastCorner * length_mm, tolerance_mm))),
      marks_(length_mm > 0.0 ? corners_of(piece, tolerance_mm) : Cuts{}),
      chords_(length_mm > 0.0 ? piece.size() : 0, 0),
      refinement_(piece.size(), 0),
      next_(piece.size() + 1),
      thinned_(piece),
      jumps_(piece) {
  std::iota(next_.begin(), next_.end(), std::size_t{0});
}

std::vector<double> SmoothingPlan::tolerances(double share_mm) const {
  std::vector<double> result;
  result.reserve(refinement_.size());
  for (const char times : refinement_)
    result.push_back(times == 0                ? share_mm
                     : times == kMaxRefinement ? 0.0
                                               : share_mm * std::pow(kRefinementRatio, times));
  return result;
}

RingRange SmoothingPlan::rings_around(const ThinRing& thin) const {
  const std::size_t reach = reach_of(thin.wall_mm);
  return {thin.ring - std::min(thin.ring, reach), std::min(piece_.size() - 1, thin.ring + reach)};
}

std::vector<double> SmoothingPlan::lengths() const {
  std::vector<double> result;
  result.reserve(chords_.size());
  for (std::size_t i = 0; i < chords_.size(); ++i)
    result.push_back(chords_[i] != 0 ? 0.0 : std::ldexp(length_mm_, -refinement_[i]));
  return result;
}

/// In rings.
std::size_t SmoothingPlan::reach_of(double wall_mm) const {
  const double rings = wall_mm / piece_.ring_height_mm + 2.0;
  return rings < static_cast<double>(piece_.size()) ? static_cast<std::size_t>(rings)
                                                    : piece_.size();
}

bool SmoothingPlan::refine(const std::vector<ThinRing>& thin) {
  bool more = false;
  std::size_t done = 0;
  for (const ThinRing& ring : thin) {
    const auto [first, last] = rings_around(ring);
    for (std::size_t i = std::max(done, first); i <= last; ++i)
      if (refinement_[i] < kMaxRefinement) ++refinement_[i], more = true;
    done = std::max(done, last + 1);
  }
  return more;
}

bool SmoothingPlan::refine_everywhere() {
  bool more = false;
  for (char& times : refinement_)
    if (times < kMaxRefinement) ++times, more = true;
  return more;
}

bool SmoothingPlan::use_chords(const std::vector<ThinRing>& thin) {
  if (chords_.empty()) return false;
  bool more = false;
  std::size_t done = 0;
  for (const auto& [ring, wall_mm] : thin) {
    const std::size_t reach = reach_of(wall_mm) + chord_reach_;
    const std::size_t end = std::min(piece_.size(), ring + reach + 1);
    for (std::size_t i = std::max(done, ring - std::min(ring, reach)); i < end; ++i)
      if (chords_[i] == 0) chords_[i] = 1, keep_marks_beside(i), more = true;
    done = std::max(done, end);
  }
  chord_reach_ = 2 * chord_reach_ + 1;
  return more;
}

bool SmoothingPlan::use_chords_everywhere() {
  const bool more = std::ranges::count(chords_, 0) > 0;
  std::ranges::fill(chords_, 1);
  for (std::size_t i = 0; i < chords_.size(); ++i) keep_marks_beside(i);
  return more;
}

/// Keeps the corners beside a ring with chords, so that the chords are the same as without fairing.
void SmoothingPlan::keep_marks_beside(std::size_t ring) {
  for (const std::size_t k : {ring, ring + 1}) {
    if (k == 0 || k == piece_.size() || chords_[k - 1] == 0 || chords_[k] == 0) continue;
    if (marks_.outer[k] != 0) cuts_.outer[k] = 1;
    if (marks_.bore[k] != 0) cuts_.bore[k] = 1;
  }
}

bool SmoothingPlan::open(const WallRings& wall, const CutFlags& cut, std::size_t k) const {
  return cut[k] == 0 && std::abs(wall.radius[k] - wall.radius[k - 1]) >= piece_.least_step_mm;
}

bool SmoothingPlan::open(std::size_t k) const {
  return open(piece_.outer, cuts_.outer, k) || open(piece_.bore, cuts_.bore, k);
}

/// The first open interface from k on, or the top. Compresses the path for the next search.
std::size_t SmoothingPlan::next_open(std::size_t k) {
  std::size_t end = k;
  while (end < piece_.size() && (next_[end] != end || !open(end))) {
    if (next_[end] == end) ++next_[end];
    end = next_[end];
  }
  while (k != end) {
    const std::size_t next = next_[k];
    next_[k] = end;
    k = next;
  }
  return end;
}

void SmoothingPlan::cut(std::size_t k) {
  if (open(piece_.outer, cuts_.outer, k)) cuts_.outer[k] = 1;
  if (open(piece_.bore, cuts_.bore, k)) cuts_.bore[k] = 1;
}

bool SmoothingPlan::keep_steps(const ThinRing& thin) {
  step_of_loop();
  const std::size_t largest = reach_of(thin.wall_mm);
  for (std::size_t reach = 0;; reach = std::min(2 * reach + 1, largest)) {
    const std::size_t first = std::max<std::size_t>(1, thin.ring - std::min(thin.ring, reach));
    const std::size_t last = std::min(piece_.size() - 1, thin.ring + 1 + reach);
    bool more = false;
    for (std::size_t k = next_open(first); k <= last; k = next_open(k)) {
      cut(k);
      thinned_.add(k, thin.wall_mm);
      more = true;
    }
    if (more || reach == largest) return more;
  }
}

bool SmoothingPlan::keep_steps(const std::vector<ThinRing>& thin) {
  bool more = false;
  for (const ThinRing& ring : thin)
    if (keep_steps(ring)) more = true;
  return more;
}

void SmoothingPlan::report(std::vector<ShortenedFairing>& reports) const {
  const std::vector<double> now = lengths();
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i] == length_mm_) continue;
    const std::size_t first = i;
    double least = now[i];
    while (i + 1 < now.size() && now[i + 1] != length_mm_) least = std::min(least, now[++i]);
    reports.push_back({piece_.level[first], piece_.level[i + 1], least});
  }
}

/// The volume that the chords between two middles lose against the steps, over pi: a step of R
/// costs h/6 of its square, and a step of the bore gains that.
double SmoothingPlan::chord_loss(std::size_t k) const {
  const auto step2 = [k](const WallRings& wall, const CutFlags& cut) {
    const double step = cut[k] == 0 ? wall.radius[k] - wall.radius[k - 1] : 0.0;
    return step * step;
  };
  return piece_.ring_height_mm / 6.0 *
         (step2(piece_.outer, cuts_.outer) - step2(piece_.bore, cuts_.bore));
}

bool SmoothingPlan::keep_jumps(double excess_over_pi, double moved_mm) {
  std::vector<std::pair<double, std::size_t>> jumps;
  for (std::size_t k = next_open(1); k < piece_.size(); k = next_open(k + 1))
    if (const double loss = std::copysign(1.0, excess_over_pi) * chord_loss(k); loss > 0.0)
      jumps.emplace_back(loss, k);
  std::sort(jumps.rbegin(), jumps.rend());
  double left = std::abs(excess_over_pi);
  for (const auto& [loss, k] : jumps) {
    if (left <= 0.0) break;
    cut(k);
    jumps_.add(k, -moved_mm);
    left -= loss;
  }
  return !jumps.empty();
}

}  // namespace clay::solid::inline smoothing
