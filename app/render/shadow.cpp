#include "app/render/shadow.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

namespace clay::render {
namespace {

constexpr std::size_t kDiscs = 28;   // discs that approximate a body
constexpr float kLampWidth = 0.16f;  // tangent of the lamp's angular size
constexpr float kAmbientDepth = 0.62f;

/// A disc of clay in a body's coordinates.
struct Disc {
  float y, radius;
  glm::vec3 centre;       ///< in the wheel's coordinates
  float strength, reach;  ///< of the hidden sky: share at the edge, and range beyond it
};

struct Caster {
  std::vector<Disc> discs;
  glm::mat4 back;  ///< from the wheel's coordinates to the body's
};

Caster caster_of(const Body& body) {
  Caster caster{{}, glm::inverse(body.place)};
  const auto& levels = body.levels;
  const float tilt = std::sqrt(std::max(0.0f, 1.0f - body.place[1].y * body.place[1].y));
  const std::size_t count = std::min(kDiscs, levels.size());
  for (std::size_t k = 0; k < count; ++k) {
    const Level& level = levels[k * (levels.size() - 1) / std::max<std::size_t>(1, count - 1)];
    const glm::vec3 centre(body.place * glm::vec4(0.0f, level.y, 0.0f, 1.0f));
    const float low = std::max(0.0f, centre.y - level.outer * tilt);
    caster.discs.push_back({level.y, level.outer, centre,
                            kAmbientDepth / (1.0f + 2.0f * low / (level.outer + 1e-6f)),
                            0.30f * level.outer + low + 1e-6f});
  }
  return caster;
}

/// The wedge of a body that is cut away, by the inward normals of both faces of the cut.
struct Wedge {
  glm::vec2 first{0.0f}, last{0.0f};  ///< (x, z)
  bool empty = true;
};

Wedge wedge_beside(glm::vec2 sweep) {
  constexpr float kTurn = 6.2831853f, kRight = 0.25f * kTurn, kLeast = 1e-3f;
  const auto towards = [](float azimuth) {
    return glm::vec2(std::sin(azimuth), std::cos(azimuth));
  };
  if (sweep.y - sweep.x > kTurn - kLeast) return {};
  return {towards(sweep.x - kRight), towards(sweep.y + kRight), false};
}

/// Depth of a place in the wedge; negative: outside.
float depth_in(const Wedge& wedge, float x, float z) {
  const glm::vec2 at(x, z);
  return std::min(glm::dot(at, wedge.first), glm::dot(at, wedge.last));
}

float smooth(float t) {
  t = std::clamp(t, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

/// The fraction of the lamp that is hidden from a point of the ground.
float lamp_hidden(const Caster& caster, const glm::vec3& point, const glm::vec3& to_lamp,
                  const Wedge& wedge, float texel) {
  const glm::vec3 from(caster.back * glm::vec4(point, 1.0f));
  const glm::vec3 way(caster.back * glm::vec4(to_lamp, 0.0f));
  if (std::abs(way.y) < 1e-4f) return 0.0f;
  float hidden = 0.0f;
  for (const Disc& disc : caster.discs) {
    const float along = (disc.y - from.y) / way.y;
    if (along < 0.0f) continue;
    const float x = from.x + along * way.x, z = from.z + along * way.z;
    const float width = 1.5f * texel + kLampWidth * along;
    const float reach = disc.radius + width, squared = x * x + z * z;
    if (squared >= reach * reach) continue;
    const float off = std::sqrt(squared) - disc.radius;
    float covered = smooth(0.5f - 0.5f * off / width);
    if (!wedge.empty) covered *= smooth(0.5f - 0.5f * depth_in(wedge, x, z) / width);
    hidden = std::max(hidden, covered);
    if (hidden >= 1.0f) break;
  }
  return hidden;
}

float sky_hidden(const Caster& caster, const glm::vec3& point, const Wedge& wedge) {
  const glm::vec3 own(caster.back * glm::vec4(point, 1.0f));
  const float cut = wedge.empty ? 0.0f : std::max(0.0f, depth_in(wedge, own.x, own.z));
  float hidden = 0.0f;
  for (const Disc& disc : caster.discs) {
    const float x = point.x - disc.centre.x, z = point.z - disc.centre.z;
    const float off = std::max(cut, std::sqrt(x * x + z * z) - disc.radius);
    // exp(-t) is below 1 / (1 + t): most discs need no exponential.
    if (disc.strength * disc.reach <= hidden * (disc.reach + off)) continue;
    hidden = std::max(hidden, disc.strength * std::exp(-off / disc.reach));
  }
  return hidden;
}

std::uint8_t byte_of(float part) {
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(part, 0.0f, 1.0f)));
}

}  // namespace

ShadowMap shadow_of(std::span<const Body> bodies, const glm::vec3& to_lamp, glm::vec2 sweep) {
  ShadowMap map;
  const Wedge wedge = wedge_beside(sweep);
  std::vector<Caster> casters;
  float reach = 1e-3f;
  for (const Body& body : bodies) {
    casters.push_back(caster_of(body));
    for (const Disc& disc : casters.back().discs)
      reach = std::max(reach, glm::length(disc.centre) + disc.radius);
  }
  map.half_side_mm = 2.0f * reach;
  const float texel = 2.0f * map.half_side_mm / static_cast<float>(ShadowMap::kSide);
  for (std::size_t i = 0; i < map.light.size(); ++i) {
    const glm::vec3 point{
        (static_cast<float>(i % ShadowMap::kSide) + 0.5f) * texel - map.half_side_mm, 0.0f,
        (static_cast<float>(i / ShadowMap::kSide) + 0.5f) * texel - map.half_side_mm};
    float lamp = 1.0f, sky = 1.0f;
    for (const Caster& caster : casters) {
      lamp = std::min(lamp, 1.0f - lamp_hidden(caster, point, to_lamp, wedge, texel));
      sky *= 1.0f - sky_hidden(caster, point, wedge);
    }
    map.light[i] = {byte_of(lamp), byte_of(sky)};
  }
  return map;
}

}  // namespace clay::render
