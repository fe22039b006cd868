#include "app/render/pot_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

namespace clay::render {
namespace {

constexpr int kArcs = 48;          // segments of a half-profile, equal in angle
constexpr int kPerSampleStep = 6;  // between the samples of a sampled profile

Row row_of(const Ring& ring) {
  return {static_cast<float>(ring.outer_mm()), static_cast<float>(ring.inner_mm())};
}

/// Radii at a height, interpolated between the middles of neighbouring rings; a bore ends at the
/// end of its ring.
Row row_at(const ClayStack& stack, double y) {
  const auto rings = stack.rings();
  const auto last = static_cast<double>(rings.size() - 1);
  const double at = std::clamp(y / stack.ring_height_mm() - 0.5, 0.0, last);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, rings.size() - 1);
  const double part = at - static_cast<double>(below);
  if ((rings[below].inner2 == 0) != (rings[above].inner2 == 0))
    return row_of(rings[part < 0.5 ? below : above]);
  const Row low = row_of(rings[below]), high = row_of(rings[above]);
  return {std::lerp(low.outer_mm, high.outer_mm, static_cast<float>(part)),
          std::lerp(low.inner_mm, high.inner_mm, static_cast<float>(part))};
}

void add_arc(const Tool& tool, double from, double to, int steps, std::vector<glm::vec2>& profile) {
  for (int k = profile.empty() ? 0 : 1; k <= steps; ++k) {
    const double t = std::lerp(from, to, static_cast<double>(k) / steps);
    profile.emplace_back(static_cast<float>(tool.radius(t)), static_cast<float>(t));
  }
}

/// From pole to pole, equal in angle, because equal steps in t would give corners.
std::vector<glm::vec2> ellipse_arc(const EllipseProfile& ellipse) {
  std::vector<glm::vec2> profile;
  for (int k = 0; k <= kArcs; ++k) {
    const double angle = std::numbers::pi * k / kArcs;
    const double radius = k == 0 || k == kArcs ? 0.0 : ellipse.b * std::sin(angle);
    profile.emplace_back(static_cast<float>(radius),
                         static_cast<float>(-ellipse.a * std::cos(angle)));
  }
  return profile;
}

}  // namespace

PotView view_of(const ClayStack& stack) {
  PotView view;
  if (stack.size() == 0) return view;
  view.height_mm = stack.height_mm();
  if (stack.crown() == 0 && stack.size() <= kMaxRows) {
    for (const Ring& ring : stack.rings()) view.rows.push_back(row_of(ring));
    return view;
  }
  const std::size_t count = std::min(stack.size() + 1, kMaxRows);
  const double height = view.height_mm / static_cast<double>(count);
  for (std::size_t row = 0; row < count; ++row)
    view.rows.push_back(row_at(stack, height * (static_cast<double>(row) + 0.5)));
  return view;
}

PotView view_of(const Pot& pot) {
  PotView view = view_of(pot.stack);
  if (pot.collapse) view.fallen = fallen_view(*pot.collapse, view, pot.stack);
  return view;
}

PotView turned(PotView view) {
  std::ranges::reverse(view.rows);
  std::ranges::reverse(view.wall_mm);
  return view;
}

FallenView fallen_view(const Collapse& collapse, const PotView& view, const ClayStack& stack) {
  const double split = stack.ring_height_mm() * static_cast<double>(collapse.failed_ring + 1);
  const auto count = static_cast<double>(view.rows.size());
  const double row = std::clamp(std::round(count * split / view.height_mm), 0.0, count);
  const FallenPlace place(collapse);
  const glm::dvec3 origin = place({0.0, 0.0, 0.0});
  return {static_cast<std::size_t>(row),
          {glm::dvec4(place({1.0, 0.0, 0.0}) - origin, 0.0),
           glm::dvec4(place({0.0, 1.0, 0.0}) - origin, 0.0),
           glm::dvec4(place({0.0, 0.0, 1.0}) - origin, 0.0), glm::dvec4(origin, 1.0)}};
}

FallenView fallen_view(const Collapse& collapse, const FallFrame& frame, const PotView& view,
                       const ClayStack& stack) {
  Collapse moment = collapse;
  moment.angle_rad = frame.angle_rad;
  moment.shift_mm = frame.shift_mm;
  return fallen_view(moment, view, stack);
}

std::vector<glm::vec2> half_profile_of(const Tool& tool) {
  if (const auto* ellipse = std::get_if<EllipseProfile>(&tool.profile()))
    return ellipse_arc(*ellipse);
  std::vector<glm::vec2> profile;
  if (const auto* sampled = std::get_if<SampledProfile>(&tool.profile()))
    for (std::size_t i = 1; i < sampled->t.size(); ++i)
      add_arc(tool, sampled->t[i - 1], sampled->t[i], kPerSampleStep, profile);
  else
    add_arc(tool, tool.low(), tool.high(), 1, profile);
  return profile;
}

}  // namespace clay::render
