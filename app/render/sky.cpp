#include "app/render/sky.hpp"

#include "app/render/section.hpp"

#include <algorithm>
#include <cmath>

namespace clay::render {
namespace {

constexpr std::size_t kRings = 96;
constexpr float kLeastRise = 1e-4f;  // of the height: points at the same level hide nothing
constexpr float kFootShade = 0.45f;  // fraction of the ground's light that the lowest clay hides
constexpr float kFar = 1e9f;

}  // namespace

Sky::Sky(const std::vector<Level>& levels) {
  const std::size_t stride = std::max<std::size_t>(1, levels.size() / kRings);
  for (std::size_t i = 0; i < levels.size(); i += stride)
    rings_.push_back({levels[i].y, levels[i].outer, levels[i].inner});
  if (!levels.empty())
    rings_.push_back({levels.back().y, levels.back().outer, levels.back().inner});
}

float Sky::outside(glm::vec2 at) const {
  const float foot = rings_.front().y, height = rings_.back().y - foot;
  // Run over rise of the nearest overhang: the cotangent of the horizon's elevation.
  float overhang = 0.0f;
  for (const Ring& ring : rings_) {
    const float rise = ring.y - at.y, run = ring.outer - at.x;
    if (rise > kLeastRise * height && run > 0.0f) overhang = std::max(overhang, run / rise);
  }
  const float open = 1.0f / std::sqrt(1.0f + overhang * overhang);
  const float reach = 0.35f * rings_.front().outer + 1e-6f;
  const float near_ground = std::exp(-(at.y - foot) / reach);
  return open * (1.0f - kFootShade * near_ground);
}

SeenSky Sky::inside(glm::vec2 at) const {
  const float height = rings_.back().y - rings_.front().y;
  float near = kFar, far = kFar;  // run over rise, both measured outward from the point
  SeenSky seen;
  seen.neck = {kFar, at.y};
  for (const Ring& ring : rings_) {
    const float rise = ring.y - at.y;
    if (rise <= kLeastRise * height) continue;
    near = std::min(near, (ring.inner - at.x) / rise);
    far = std::min(far, (ring.inner + at.x) / rise);
    if (ring.inner < seen.neck.x) seen.neck = {ring.inner, ring.y};
  }
  if (near >= kFar) return {1.0f, {0.0f, 0.0f}};  // the rim itself
  if (seen.neck.x <= 0.0f) return {0.0f, {0.0f, 0.0f}};
  // The sky visible from the point lies between the directions (near, 1) and (-far, 1).
  const float left = near / std::sqrt(1.0f + near * near);
  const float right = -far / std::sqrt(1.0f + far * far);
  seen.open = std::clamp(0.5f * (left - right), 0.0f, 1.0f);
  return seen;
}

}  // namespace clay::render
