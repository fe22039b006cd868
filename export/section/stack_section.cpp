#include "export/section/stack_section.hpp"

#include "core/cancel.hpp"

#include <algorithm>
#include <cmath>

namespace clay::solid::inline section {
namespace {

using Radius = double (Ring::*)() const noexcept;

/// Neighbouring rings of equal radius, whose wall is straight.
struct Run {
  double radius = 0.0;
  double bottom = 0.0;
  double top = 0.0;
};

std::vector<Run> runs_of(const ClayStack& stack, RingRange piece, Radius radius_of) {
  std::vector<Run> runs;
  for (std::size_t i = piece.first; i <= piece.last; ++i) {
    step_of_loop();
    const double radius = (stack.rings()[i].*radius_of)(), top = level_mm(stack, i + 1);
    if (!runs.empty() && runs.back().radius == radius)
      runs.back().top = top;
    else
      runs.push_back({radius, level_mm(stack, i), top});
  }
  return runs;
}

/// The radius at which, to first order, one run gains the clay that the other loses.
double levelled_radius(const Run& lower, const Run& upper) {
  const double below = lower.top - lower.bottom, above = upper.top - upper.bottom;
  return std::sqrt((below * lower.radius * lower.radius + above * upper.radius * upper.radius) /
                   (below + above));
}

Polygon wall_of(const ClayStack& stack, RingRange piece, Radius radius_of, double min_step_mm) {
  const std::vector<Run> runs = runs_of(stack, piece, radius_of);
  Polygon wall{{runs.front().radius, runs.front().bottom}};
  for (std::size_t i = 1; i < runs.size(); ++i) {
    const Run &lower = runs[i - 1], &upper = runs[i];
    // A step onto the axis stays: otherwise the wall would meet the axis in a point.
    if (std::abs(upper.radius - lower.radius) < min_step_mm &&
        std::min(lower.radius, upper.radius) > 0.0) {
      wall.push_back({levelled_radius(lower, upper), lower.top});
    } else {
      wall.push_back({lower.radius, lower.top});
      wall.push_back({upper.radius, lower.top});
    }
  }
  wall.push_back({runs.back().radius, runs.back().top});
  return wall;
}

bool on_axis(const Polygon& polygon, std::size_t edge) {
  const std::size_t count = polygon.size();
  return polygon[edge % count].rho == 0.0 && polygon[(edge + 1) % count].rho == 0.0;
}

}  // namespace

// Decided on the counted squares: radii one quantum apart may round to the same double.
Contact contact_of(const Ring& lower, const Ring& upper) noexcept {
  const Quanta inner2 = std::max(lower.inner2, upper.inner2);
  const Quanta outer2 = std::min(lower.outer2, upper.outer2);
  if (inner2 < outer2) return Contact::annulus;
  return inner2 == outer2 ? Contact::circle : Contact::none;
}

double level_mm(const ClayStack& stack, std::size_t ring) noexcept {
  return ring < stack.size() ? static_cast<double>(ring) * stack.ring_height_mm()
                             : stack.height_mm();
}

std::vector<RingRange> pieces_of(const ClayStack& stack, RingRange rings) {
  std::vector<RingRange> pieces{{rings.first, rings.first}};
  for (std::size_t i = rings.first + 1; i <= rings.last; ++i) {
    if (contact_of(stack.rings()[i - 1], stack.rings()[i]) == Contact::annulus)
      pieces.back().last = i;
    else
      pieces.push_back({i, i});
  }
  return pieces;
}

Polygon outer_wall_of(const ClayStack& stack, RingRange piece) {
  return wall_of(stack, piece, &Ring::outer_mm, 0.0);
}

Polygon section_of(const ClayStack& stack, RingRange piece, double min_step_mm) {
  Polygon section = wall_of(stack, piece, &Ring::outer_mm, min_step_mm);
  const Polygon bore = wall_of(stack, piece, &Ring::inner_mm, min_step_mm);
  section.insert(section.end(), bore.rbegin(), bore.rend());
  return section;
}

/// The crown has the radii of the last ring.
Polygon crown_section_of(const ClayStack& stack) {
  const Ring& ring = stack.rings().back();
  const double outer = ring.outer_mm(), inner = ring.inner_mm();
  const double bottom = static_cast<double>(stack.size()) * stack.ring_height_mm();
  const double top = bottom + stack.crown_height_mm();
  return {{outer, bottom}, {outer, top}, {inner, top}, {inner, bottom}};
}

std::vector<Chain> chains_of(const Polygon& polygon) {
  const std::size_t count = polygon.size();
  std::vector<Chain> chains;
  for (std::size_t i = 0; i < count; ++i) {
    if (on_axis(polygon, i) || !on_axis(polygon, i + count - 1)) continue;
    Chain chain{i, 1, false};
    while (!on_axis(polygon, i + chain.edges)) ++chain.edges;
    chains.push_back(chain);
  }
  if (chains.empty()) chains.push_back({0, count, true});
  return chains;
}

}  // namespace clay::solid::inline section
