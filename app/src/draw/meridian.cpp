#include "draw/section.hpp"
#include "draw/sky.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace clay::draw {
namespace {

constexpr float kCreaseCosine = 0.64f;  // faces that meet at more than 50 degrees have an edge
constexpr float kLip = 0.25f;           // of the radius: narrower rims are shaded as if rounded

struct Joint {
  glm::vec2 at{0.0f};
  float wall = 0.0f, open = 1.0f;
  glm::vec2 neck{0.0f};
};

glm::vec2 outward(const Joint& from, const Joint& to) {
  const glm::vec2 way = to.at - from.at;
  return glm::normalize(glm::vec2{way.y, -way.x});
}

void add_stretch(const Joint& from, const Joint& to, std::vector<Stretch>& meridian) {
  if (from.at == to.at) return;
  const glm::vec2 normal = outward(from, to);
  meridian.push_back({from.at,
                      to.at,
                      normal,
                      normal,
                      {from.open, to.open},
                      {from.wall, to.wall},
                      from.neck.x > 0.0f ? from.neck : to.neck});
}

void smooth_joint(Stretch& before, Stretch& after, bool rounded) {
  if (before.to != after.from) return;
  const glm::vec2 a = before.to_normal, b = after.from_normal;
  if (!rounded && glm::dot(a, b) < kCreaseCosine) return;
  // The longer face says more about the way that the wall runs there.
  const float weight_a = rounded ? 1.0f : glm::distance(before.from, before.to);
  const float weight_b = rounded ? 1.0f : glm::distance(after.from, after.to);
  const glm::vec2 sum = weight_a * a + weight_b * b;
  const float length = glm::length(sum);
  if (length > 0.0f) before.to_normal = after.from_normal = sum / length;
}

Joint outer_joint(const Level& level, const Sky& sky) {
  const glm::vec2 at{level.outer, level.y};
  return {at, level.wall.outer_mm, sky.outside(at), {}};
}

Joint inner_joint(const Level& level, const Sky& sky) {
  const glm::vec2 at{level.inner, level.y};
  const SeenSky seen = sky.inside(at);
  return {at, level.wall.inner_mm, seen.open, seen.neck};
}

}  // namespace

std::vector<Stretch> meridian_of(const std::vector<Level>& levels) {
  std::vector<Stretch> meridian;
  if (levels.size() < 2) return meridian;
  const Sky sky(levels);
  const Level& foot = levels.front();
  const Level& top = levels.back();
  add_stretch({{foot.inner, foot.y}, foot.wall.outer_mm, 0.0f, {}}, outer_joint(foot, sky),
              meridian);
  for (std::size_t i = 1; i < levels.size(); ++i)
    add_stretch(outer_joint(levels[i - 1], sky), outer_joint(levels[i], sky), meridian);
  const std::size_t rim = meridian.size();
  add_stretch(outer_joint(top, sky), {{top.inner, top.y}, top.wall.outer_mm, 1.0f, {}}, meridian);
  for (std::size_t i = levels.size(); i-- > 1;) {
    const Level& above = levels[i];
    const Level& below = levels[i - 1];
    if (above.inner > 0.0f || below.inner > 0.0f)
      add_stretch(inner_joint(above, sky), inner_joint(below, sky), meridian);
  }
  const bool lip = top.inner > 0.0f && top.outer - top.inner < kLip * top.outer;
  for (std::size_t i = 1; i < meridian.size(); ++i)
    smooth_joint(meridian[i - 1], meridian[i], lip && (i == rim || i == rim + 1));
  return meridian;
}

std::vector<Stretch> meridian_of(const std::vector<glm::vec2>& line) {
  std::vector<Stretch> meridian;
  if (line.empty()) return meridian;
  const auto add = [&](glm::vec2 from, glm::vec2 to) {
    add_stretch({from, 0.0f, 1.0f, {}}, {to, 0.0f, 1.0f, {}}, meridian);
  };
  add({0.0f, line.front().y}, line.front());
  for (std::size_t i = 1; i < line.size(); ++i) add(line[i - 1], line[i]);
  add(line.back(), {0.0f, line.back().y});
  for (std::size_t i = 1; i < meridian.size(); ++i)
    smooth_joint(meridian[i - 1], meridian[i], false);
  return meridian;
}

}  // namespace clay::draw
