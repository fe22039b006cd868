#include "claystack/export/profile_smoothing.hpp"

#include "stack_section.hpp"
#include "swept_volume.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clay::solid {
namespace {

using Radius = double (Ring::*)() const noexcept;

double distance_to_line(const ProfilePoint& p, const ProfilePoint& a, const ProfilePoint& b) {
  const double rho = b.rho - a.rho, y = b.y - a.y;
  return std::abs(rho * (p.y - a.y) - y * (p.rho - a.rho)) / std::hypot(rho, y);
}

/// Keeps both ends and every point without which the line would stray beyond the tolerance.
Polygon simplified(const Polygon& wall, double tolerance_mm) {
  std::vector<bool> kept(wall.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, wall.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    double farthest = tolerance_mm;
    std::size_t split = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double away = distance_to_line(wall[i], wall[first], wall[last]);
      if (away > farthest) farthest = away, split = i;
    }
    if (split == first) continue;
    kept[split] = true;
    open.emplace_back(first, split);
    open.emplace_back(split, last);
  }
  Polygon result;
  for (std::size_t i = 0; i < wall.size(); ++i)
    if (kept[i]) result.push_back(wall[i]);
  return result;
}

/// One wall over a run of rings: straight to the middle of the first ring, from middle to middle,
/// and straight to the end.
Polygon fair_wall(const ClayStack& stack, RingRange run, Radius radius_of, double tolerance_mm) {
  const auto radius = [&](std::size_t i) { return (stack.rings()[i].*radius_of)(); };
  Polygon wall{{radius(run.first), level_mm(stack, run.first)}};
  for (std::size_t i = run.first; i <= run.last; ++i)
    wall.push_back({radius(i), level_mm(stack, i) + 0.5 * stack.ring_height_mm()});
  wall.push_back({radius(run.last), level_mm(stack, run.last + 1)});
  return simplified(wall, tolerance_mm);
}

/// Bore by bore, and along the axis between them.
Polygon fair_bore(const ClayStack& stack, RingRange piece, double tolerance_mm) {
  Polygon bore;
  std::size_t first = piece.first;
  while (first <= piece.last) {
    const bool open = stack.rings()[first].inner2 > 0;
    std::size_t last = first;
    while (last < piece.last && (stack.rings()[last + 1].inner2 > 0) == open) ++last;
    const Polygon part =
        open ? fair_wall(stack, {first, last}, &Ring::inner_mm, tolerance_mm)
             : Polygon{{0.0, level_mm(stack, first)}, {0.0, level_mm(stack, last + 1)}};
    bore.insert(bore.end(), part.begin(), part.end());
    first = last + 1;
  }
  return bore;
}

double counted_volume(const ClayStack& stack, RingRange piece) {
  WideQuanta quanta = piece.last + 1 == stack.size() ? stack.crown() : 0;
  for (std::size_t i = piece.first; i <= piece.last; ++i) quanta += stack.rings()[i].volume();
  return static_cast<double>(quanta) * stack.mm3_per_quantum();
}

Polygon fair_section(const ClayStack& stack, RingRange piece, double tolerance_mm) {
  Polygon section = fair_wall(stack, piece, &Ring::outer_mm, tolerance_mm);
  const Polygon bore = fair_bore(stack, piece, tolerance_mm);
  const double wanted = counted_volume(stack, piece) + swept_volume(bore, false);
  const double scale = std::sqrt(wanted / swept_volume(section, false));
  for (ProfilePoint& p : section) p.rho *= scale;
  section.insert(section.end(), bore.rbegin(), bore.rend());
  return section;
}

}  // namespace

Result<StackProfile> smooth_profile_of(const ClayStack& stack, double tolerance_mm) {
  auto result = profile_of(stack);
  if (!result) return result;
  for (std::size_t k = 0; k < result->shapes.size(); ++k) {
    const PieceShape& shape = result->shapes[k];
    result->profile.pieces[k] =
        fair_section(stack, {shape.first_ring, shape.last_ring}, 0.5 * tolerance_mm);
  }
  return result;
}

}  // namespace clay::solid
