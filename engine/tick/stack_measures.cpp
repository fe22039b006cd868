#include "claystack/engine/tick.hpp"

#include "engine/clay/portable_trig.hpp"
#include "engine/tick/stability.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace clay {
namespace {

/// The least outer count of every run of 16 rings, of 16 such runs, and so on.
class OuterMinima {
 public:
  explicit OuterMinima(std::span<const Ring> rings) : rings_(rings) {
    std::size_t count = rings.size();
    while (count > 1) {
      const std::size_t level = levels_.size(), below = count;
      count = (count + kRun - 1) / kRun;
      auto& minima = levels_.emplace_back(count);
      for (std::size_t run = 0; run < count; ++run) {
        minima[run] = least(level, kRun * run);
        for (std::size_t i = kRun * run + 1; i < std::min(below, kRun * (run + 1)); ++i)
          minima[run] = std::min(minima[run], least(level, i));
      }
    }
  }

  /// look(from, to, least outer count) of runs that cover the rings first..last, down to those of
  /// one ring (from == to) wherever it says true.
  template <class Look>
  void visit(std::size_t first, std::size_t last, Look look) const {
    descend(levels_.size(), 0, first, last, look);
  }

 private:
  static constexpr std::size_t kRun = 16;

  /// Level 0 are the rings themselves.
  [[nodiscard]] Quanta least(std::size_t level, std::size_t run) const {
    return level == 0 ? rings_[run].outer2 : levels_[level - 1][run];
  }
  template <class Look>
  void descend(std::size_t level, std::size_t run, std::size_t first, std::size_t last,
               Look& look) const {
    const std::size_t shift = 4 * level;
    const std::size_t from = run << shift, to = ((run + 1) << shift) - 1;
    if (to < first || from > last || !look(from, to, least(level, run)) || level == 0) return;
    const std::size_t count = level == 1 ? rings_.size() : levels_[level - 2].size();
    for (std::size_t i = kRun * run; i < std::min(count, kRun * (run + 1)); ++i)
      descend(level - 1, i, first, last, look);
  }

  std::span<const Ring> rings_;
  std::vector<std::vector<Quanta>> levels_;
};

class WallSearch {
 public:
  explicit WallSearch(const ClayStack& stack)
      : rings_(stack.rings()), h_(stack.ring_height_mm()), outsides_(rings_) {
    top_ = stack.height_mm();
    least_ = {2.0 * rings_[0].outer_mm(), 0};
  }

  WallMinimum run() {
    for (std::size_t i = 0; i < rings_.size(); ++i) {
      if (rings_[i].inner2 == 0) {
        keep(2.0 * rings_[i].outer_mm(), i);
      } else {
        across(i);
      }
    }
    floors();
    return least_;
  }

 private:
  void keep(double thickness, std::size_t ring) {
    if (thickness < least_.thickness_mm) least_ = {thickness, ring};
  }

  /// From the bore of ring i to the outside of every ring near enough to matter.
  void across(std::size_t i) {
    if (i >= piece_end_) find_piece(i);
    const double inner = rings_[i].inner_mm();
    keep(rings_[i].outer_mm() - inner, i);
    // No farther than the least wall so far; rings that touch share a level, so neighbours have no
    // gap.
    const double reach = least_.thickness_mm / h_ + 1.0;
    const auto far = [&](std::size_t limit) {
      return reach < static_cast<double>(limit) ? static_cast<std::size_t>(reach) + 1 : limit;
    };
    const std::size_t first = i - far(i - piece_begin_);
    const std::size_t last = i + far(piece_end_ - 1 - i);
    outsides_.visit(first, last, [&](std::size_t from, std::size_t to, Quanta least_outer2) {
      const std::size_t apart = from > i ? from - i : i > to ? i - to : 0;
      const double gap = h_ * static_cast<double>(std::max<std::size_t>(apart, 1) - 1);
      const double across = std::max(0.0, radius_from_quanta(least_outer2) - inner);
      const double least = least_.thickness_mm;
      // Most are far: the exact length costs ten times as much.
      if (across * across + gap * gap > kRoundedUp * least * least) return false;
      const double wall = length_of(across, gap);
      if (from == to) keep(wall, i);
      return wall < least;
    });
  }

  /// Only through clay: a ring that does not touch the one before is of another piece.
  void find_piece(std::size_t i) {
    piece_begin_ = piece_end_ = i;
    while (piece_begin_ > 0 && share_clay(rings_[piece_begin_], rings_[piece_begin_ - 1]))
      --piece_begin_;
    do ++piece_end_;
    while (piece_end_ < rings_.size() && share_clay(rings_[piece_end_], rings_[piece_end_ - 1]));
  }

  static bool share_clay(const Ring& a, const Ring& b) {
    return std::max(a.inner2, b.inner2) < std::min(a.outer2, b.outer2);
  }

  /// Runs of rings without a bore, between bores and the open air: floors, lids, solid pots.
  void floors() {
    std::size_t first = 0;
    while (first < rings_.size()) {
      if (rings_[first].inner2 > 0) {
        ++first;
        continue;
      }
      std::size_t end = first;
      while (end < rings_.size() && rings_[end].inner2 == 0) ++end;
      const double bottom = h_ * static_cast<double>(first);
      const double top = end == rings_.size() ? top_ : h_ * static_cast<double>(end);
      keep(top - bottom, first);
      first = end;
    }
  }

  static constexpr double kRoundedUp = 1.0 + 1e-12;

  std::span<const Ring> rings_;
  double h_;
  double top_ = 0.0;
  OuterMinima outsides_;
  std::size_t piece_begin_ = 0, piece_end_ = 0;  ///< of the ring that was looked at last
  WallMinimum least_;
};

}  // namespace

WallMinimum min_wall(const ClayStack& stack) { return WallSearch(stack).run(); }

double largest_radius_mm(const ClayStack& stack) noexcept {
  Quanta largest2 = 0;
  for (const Ring& ring : stack.rings()) largest2 = std::max(largest2, ring.outer2);
  return radius_from_quanta(largest2);
}

std::vector<double> stresses_kpa(const ClayStack& stack, double density_g_cm3) {
  const StabilityPlan plan{0.0, kpa_per_ratio(density_g_cm3, stack.ring_height_mm())};
  const auto rings = stack.rings();
  std::vector<double> stresses(rings.size());
  WideQuanta above = stack.crown();
  for (std::size_t i = rings.size(); i-- > 0; above += rings[i].volume())
    stresses[i] = stress_kpa(plan, above, rings[i].volume());
  return stresses;
}

double capacity_mm3(const ClayStack& stack) noexcept {
  const auto rings = stack.rings();
  std::size_t floor = rings.size();
  WideQuanta held = 0;
  while (floor > 0 && rings[floor - 1].inner2 > 0) held += rings[--floor].inner2;
  if (floor == 0 || floor == rings.size()) return 0.0;
  const double in_crown =
      std::numbers::pi * mm2_from_quanta(rings.back().inner2) * stack.crown_height_mm();
  return static_cast<double>(held) * stack.mm3_per_quantum() + in_crown;
}

}  // namespace clay
