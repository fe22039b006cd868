// Draws the tool: its contact, its hidden part, and the force on it.

#include "app/render/scene_frame.hpp"
#include "app/render/scene_painter.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace clay::render {
namespace {

constexpr double kLeastForceN = 0.02;  // below this no arrow is drawn
constexpr float kSeenThrough = 0.4f;   // opacity of a tool hidden by clay

/// Maps y to `direction`, the origin to `from`.
glm::mat4 along(const glm::dvec3& from, const glm::dvec3& direction) {
  const glm::dvec3 y = glm::normalize(direction);
  const glm::dvec3 aside = std::abs(y.x) < 0.7 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 0, 1};
  const glm::dvec3 z = glm::normalize(glm::cross(aside, y)), x = glm::cross(y, z);
  return glm::mat4(
      glm::dmat4{glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(from, 1)});
}

}  // namespace

void ScenePainter::paint_tool(const SceneFrame& frame) {
  const ToolView& tool = *frame.picture.tool;
  const std::vector<Stretch> meridian = meridian_of(tool.half_profile_mm);
  float widest = 0.0f;
  for (const glm::vec2& p : tool.half_profile_mm) widest = std::max(widest, p.x);
  const double from_axis = std::hypot(tool.place_mm.x, tool.place_mm.z);
  const glm::dvec3 radial = from_axis > 0.0
                                ? glm::dvec3{tool.place_mm.x, 0.0, tool.place_mm.z} / from_axis
                                : glm::dvec3{1.0, 0.0, 0.0};
  glUseProgram(plain_.get());
  set(plain_, "sweep", glm::vec2{0.0f, static_cast<float>(2.0 * std::numbers::pi)});
  set(plain_, "base", glm::vec4(frame.look.tool, 48.0f));
  const auto paint_at = [&](double shift, double touching) {
    set(plain_, "touch", glm::vec4(glm::vec3(touching * radial), tool.contact ? 1.0f : 0.0f));
    const glm::dvec3 place = tool.place_mm + shift * radial;
    revolve(plain_, meridian, glm::mat4(glm::translate(glm::dmat4(1.0), place)), frame);
  };
  if (!tool.gap_mm) return paint_at(0.0, tool.inside ? 1.0 : -1.0);
  const double reach = 0.5 * *tool.gap_mm + static_cast<double>(widest);
  paint_at(reach, -1.0);
  paint_at(-reach, 1.0);
}

/// Draws the part hidden by clay translucently: in a bore, behind a wall, sunk in. Called when only
/// clay has been drawn.
void ScenePainter::paint_hidden_tool(const SceneFrame& frame) {
  glEnable(GL_BLEND);
  glBlendColor(0.0f, 0.0f, 0.0f, kSeenThrough);
  glBlendFuncSeparate(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA, GL_ZERO, GL_ONE);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_FALSE);
  paint_tool(frame);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  glDisable(GL_BLEND);
}

void ScenePainter::paint_arrow(const SceneFrame& frame) {
  const ToolView& tool = *frame.picture.tool;
  const double force = glm::length(tool.force_n);
  if (!(force > kLeastForceN)) return;
  const glm::dvec3 way = tool.force_n / force;
  double beyond = 0.0;  // the tool's surface, along the force
  const double flat = std::hypot(way.x, way.z);
  for (const glm::vec2& p : tool.half_profile_mm)
    beyond = std::max(beyond, static_cast<double>(p.x) * flat + static_cast<double>(p.y) * way.y);
  const auto length = static_cast<float>(kArrowMmPerN * std::min(force, kArrowLimitN));
  const float head = std::min(8.0f, 0.6f * length), thick = 0.16f * head, wide = 0.42f * head;
  const std::vector<glm::vec2> line{
      {thick, 0.0f}, {thick, length - head}, {wide, length - head}, {0.0f, length}};
  glUseProgram(plain_.get());
  set(plain_, "base", glm::vec4(frame.look.arrow, 30.0f));
  set(plain_, "touch", glm::vec4(0.0f));
  revolve(plain_, meridian_of(line), along(tool.place_mm + beyond * way, way), frame);
}

}  // namespace clay::render
