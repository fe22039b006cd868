#pragma once
// The expected results of drawings, by independent formulae.

#include "app/import/half_section.hpp"

#include <glm/vec2.hpp>
#include <numbers>
#include <string>
#include <vector>

namespace clay::importing {

/// The volume swept by a closed polygon right of the axis, from Pappus's theorem: 2 pi times the
/// first moment of its area.
inline double swept_mm3(const std::vector<glm::dvec2>& polygon) {
  double moment = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    moment += (a.x * b.y - b.x * a.y) * (a.x + b.x) / 6.0;
  }
  return 2.0 * std::numbers::pi * (moment < 0.0 ? -moment : moment);
}

inline Result<HalfSection> section_of(const std::string& bytes, const std::string& name,
                                      const HalfSectionSettings& settings = {}) {
  return read_drawing(bytes, name).and_then([&](Drawing&& drawing) {
    return half_section(std::move(drawing), settings, name);
  });
}

/// The error message; empty if the input was not refused.
template <class T>
std::string refusal_of(const Result<T>& result) {
  return result ? std::string() : result.error().message;
}

}  // namespace clay::importing
