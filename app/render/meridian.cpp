#include "app/render/section.hpp"
#include "app/render/sky.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace clay::render {
namespace {

constexpr float kCreaseCosine = 0.64f;  // faces that meet at more than 50 degrees form an edge
constexpr float kLip = 0.25f;           // of the radius: narrower rims are shaded as rounded

struct Joint {
  glm::vec2 at{0.0f};
  glm::vec2 normal{0.0f};  ///< of the wall there; 0: of the stretch that ends there
  float wall = 0.0f, open = 1.0f;
  glm::vec2 neck{0.0f};
};

glm::vec2 outward(const Joint& from, const Joint& to) {
  const glm::vec2 way = to.at - from.at;
  return glm::normalize(glm::vec2{way.y, -way.x});
}

/// `half_row`: the outermost half of the lowest or of the highest row. It is upright only because
/// nothing lies beyond it, so it takes the inclination of the wall at any angle: on a rounded lip,
/// an edge there would be a dark line.
void add_stretch(const Joint& from, const Joint& to, std::vector<Stretch>& meridian,
                 bool half_row = false) {
  if (from.at == to.at) return;
  const glm::vec2 face = outward(from, to);
  const auto normal_at = [&](const Joint& joint) {
    return half_row || glm::dot(joint.normal, face) > kCreaseCosine ? joint.normal : face;
  };
  meridian.push_back({from.at,
                      to.at,
                      normal_at(from),
                      normal_at(to),
                      {from.open, to.open},
                      {from.wall, to.wall},
                      from.neck.x > 0.0f ? from.neck : to.neck});
}

/// Faces that meet in a joint share the mean of their normals, unless they form an edge.
void smooth_joint(Stretch& before, Stretch& after, bool rounded) {
  const glm::vec2 a = before.to_normal, b = after.from_normal;
  if (before.to != after.from || (!rounded && glm::dot(a, b) < kCreaseCosine)) return;
  before.to_normal = after.from_normal = glm::normalize(a + b);
}

Joint outer_joint(const Level& level, const Sky& sky) {
  const glm::vec2 at{level.outer, level.y};
  const glm::vec2 normal{std::cos(level.outer_lean), -std::sin(level.outer_lean)};
  return {at, normal, level.wall.outer_mm, sky.outside(at), {}};
}

Joint inner_joint(const Level& level, const Sky& sky) {
  const glm::vec2 at{level.inner, level.y};
  const SeenSky seen = sky.inside(at);
  const glm::vec2 normal{-std::cos(level.inner_lean), std::sin(level.inner_lean)};
  return {at, normal, level.wall.inner_mm, seen.open, seen.neck};
}

}  // namespace

std::vector<Stretch> meridian_of(const std::vector<Level>& levels, bool round_lip) {
  std::vector<Stretch> meridian;
  if (levels.size() < 2) return meridian;
  const Sky sky(levels);
  const Level& foot = levels.front();
  const Level& top = levels.back();
  add_stretch({{foot.inner, foot.y}, {}, foot.wall.outer_mm, 0.0f, {}}, outer_joint(foot, sky),
              meridian);
  const auto half_row = [&](std::size_t i) { return i == 1 || i + 1 == levels.size(); };
  for (std::size_t i = 1; i < levels.size(); ++i)
    add_stretch(outer_joint(levels[i - 1], sky), outer_joint(levels[i], sky), meridian,
                half_row(i));
  const std::size_t rim = meridian.size();
  add_stretch(outer_joint(top, sky), {{top.inner, top.y}, {}, top.wall.outer_mm, 1.0f, {}},
              meridian);
  for (std::size_t i = levels.size(); i-- > 1;) {
    const Level& above = levels[i];
    const Level& below = levels[i - 1];
    if (above.inner > 0.0f || below.inner > 0.0f)
      add_stretch(inner_joint(above, sky), inner_joint(below, sky), meridian, half_row(i));
  }
  const bool lip = round_lip && top.inner > 0.0f && top.outer - top.inner < kLip * top.outer;
  for (std::size_t i = 1; i < meridian.size(); ++i)
    smooth_joint(meridian[i - 1], meridian[i], lip && (i == rim || i == rim + 1));
  return meridian;
}

std::vector<Stretch> meridian_of(const std::vector<glm::vec2>& line) {
  std::vector<Stretch> meridian;
  if (line.empty()) return meridian;
  const auto add = [&](glm::vec2 from, glm::vec2 to) {
    add_stretch({from, {}, 0.0f, 1.0f, {}}, {to, {}, 0.0f, 1.0f, {}}, meridian);
  };
  add({0.0f, line.front().y}, line.front());
  for (std::size_t i = 1; i < line.size(); ++i) add(line[i - 1], line[i]);
  add(line.back(), {0.0f, line.back().y});
  for (std::size_t i = 1; i < meridian.size(); ++i)
    smooth_joint(meridian[i - 1], meridian[i], false);
  return meridian;
}

}  // namespace clay::render
