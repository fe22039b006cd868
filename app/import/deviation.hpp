#pragma once
// Distance between two half sections.

#include "app/import/half_section.hpp"

#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clay::importing {

/// The largest distance from a point of one outline to the nearest of the other, in either
/// direction, and its place. Outlines do not include the axis.
struct Deviation {
  double mm = 0.0;         ///< attained; no distance is larger by more than kDeviationStepMm
  double radius_mm = 0.0;  ///< from the axis
  double height_mm = 0.0;  ///< above the foot
};

inline constexpr double kDeviationStepMm = 1e-3;

/// A piece of an outline: (distance from the axis, height) [mm].
struct Segment {
  glm::dvec2 from{0.0}, to{0.0};
};

/// The outline of the clay, without the axis.
[[nodiscard]] std::vector<Segment> outline_of(std::span<const Slab> slabs);

[[nodiscard]] Deviation deviation_between(const std::vector<Segment>& a,
                                          const std::vector<Segment>& b);
[[nodiscard]] Deviation deviation_between(std::span<const Slab> a, std::span<const Slab> b);

/// The nearest multiple of `step`, without the sign of a negative zero, for people.
[[nodiscard]] double rounded_to(double value, double step);

/// "largest deviation from the mesh: 0.012 mm, ...", for people.
[[nodiscard]] std::string text_of(const Deviation& deviation, std::string_view from);

/// The distance of each point from the outline; infinite from an empty one.
[[nodiscard]] std::vector<double> distances_from(const std::vector<Segment>& outline,
                                                 std::span<const glm::dvec2> points);

}  // namespace clay::importing
