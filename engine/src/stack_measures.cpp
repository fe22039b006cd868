#include "claystack/engine/stack_measures.hpp"

#include "portable_trig.hpp"
#include "stability.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clay {
namespace {

class WallSearch {
 public:
  explicit WallSearch(const ClayStack& stack) : rings_(stack.rings()), h_(stack.ring_height_mm()) {
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
    const double inner = rings_[i].inner_mm();
    const auto try_ring = [&](std::size_t j, double gap) {
      keep(length_of(std::max(0.0, rings_[j].outer_mm() - inner), gap), i);
    };
    try_ring(i, 0.0);
    bool down = true, up = true;
    // Rings that touch share a level, so neighbours have no gap.
    for (std::size_t step = 1;; ++step) {
      const double gap = h_ * static_cast<double>(step - 1);
      if (gap >= least_.thickness_mm) return;
      // Only through clay: a ring that does not touch the last one is another piece.
      down = down && step <= i && share_clay(rings_[i - step], rings_[i - step + 1]);
      up = up && i + step < rings_.size() && share_clay(rings_[i + step], rings_[i + step - 1]);
      if (down) try_ring(i - step, gap);
      if (up) try_ring(i + step, gap);
      if (!down && !up) return;
    }
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

  std::span<const Ring> rings_;
  double h_;
  double top_ = 0.0;
  WallMinimum least_;
};

}  // namespace

WallMinimum min_wall(const ClayStack& stack) noexcept { return WallSearch(stack).run(); }

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
