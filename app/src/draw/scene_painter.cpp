#include "draw/scene_painter.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>
#include <optional>

namespace clay::draw {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kThickness = 0.07;    // of the wheel head, in radii
constexpr double kFloor = 3.0;         // radius of the floor, in those of the wheel head
constexpr double kStraightPx = 0.2;    // levels that chords miss by less are left out
constexpr double kChordPx = 0.2;       // between a sector's chord and its arc
constexpr double kLeastForceN = 0.02;  // below it there is no arrow
constexpr GLuint kBlockBinding = 0;

GLint location(const Program& program, const char* name) {
  return glGetUniformLocation(program.get(), name);
}
void set(const Program& program, const char* name, const glm::mat4& value) {
  glUniformMatrix4fv(location(program, name), 1, GL_FALSE, glm::value_ptr(value));
}
void set(const Program& program, const char* name, const glm::vec4& value) {
  glUniform4fv(location(program, name), 1, glm::value_ptr(value));
}
void set(const Program& program, const char* name, const glm::vec3& value) {
  glUniform3fv(location(program, name), 1, glm::value_ptr(value));
}
void set(const Program& program, const char* name, const glm::vec2& value) {
  glUniform2fv(location(program, name), 1, glm::value_ptr(value));
}
void set(const Program& program, const char* name, float value) {
  glUniform1f(location(program, name), value);
}

Result<Program> frame_program(std::string_view name, const std::string& vertex,
                              const std::string& fragment) {
  return make_program(name, vertex, fragment).map([](Program program) {
    const GLuint block = glGetUniformBlockIndex(program.get(), "Frame");
    if (block != GL_INVALID_INDEX) glUniformBlockBinding(program.get(), block, kBlockBinding);
    glUseProgram(program.get());
    glUniform4fv(location(program, "map_colours"), kMapColours,
                 glm::value_ptr(map_colours().front()));
    return program;
  });
}

/// A turn about y that takes the eye's right, up and horizontal backwards to the wheel's x, y, z.
glm::vec3 beside_camera(const Camera& camera, const glm::dvec3& direction) {
  const double s = std::sin(camera.azimuth_rad), c = std::cos(camera.azimuth_rad);
  return {direction.x * c + direction.z * s, direction.y, direction.z * c - direction.x * s};
}

double opening_of(Cut cut) { return cut == Cut::half ? kPi : cut == Cut::quarter ? kPi / 2 : 0.0; }

/// Takes y to `direction`, the origin to `from`.
glm::mat4 along(const glm::dvec3& from, const glm::dvec3& direction) {
  const glm::dvec3 y = glm::normalize(direction);
  const glm::dvec3 aside = std::abs(y.x) < 0.7 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 0, 1};
  const glm::dvec3 z = glm::normalize(glm::cross(aside, y)), x = glm::cross(y, z);
  return glm::mat4(
      glm::dmat4{glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(from, 1)});
}

std::vector<Body> bodies_of(const PotView& pot, double tolerance_mm) {
  const auto tolerance = static_cast<float>(tolerance_mm);
  const std::size_t split =
      pot.fallen ? std::min(pot.fallen->first_row, pot.rows.size()) : pot.rows.size();
  std::vector<Body> bodies;
  if (split > 0) bodies.push_back({levels_of(pot, 0, split, tolerance), glm::mat4(1.0f)});
  if (split < pot.rows.size())
    bodies.push_back(
        {levels_of(pot, split, pot.rows.size(), tolerance), glm::mat4(pot.fallen->place)});
  return bodies;
}

float size_of(const PotView& pot) {
  float radius = 0.0f;
  for (const Row& row : pot.rows) radius = std::max(radius, row.outer_mm);
  return std::max(radius, static_cast<float>(pot.height_mm));
}

}  // namespace

struct ScenePainter::Frame {
  const Picture& picture;
  const Look& look;
  FrameBlock block;
  std::vector<Body> bodies;
  double wheel_radius;
  glm::vec2 sweep;  ///< azimuths that the cut leaves
  double px_per_mm;

  Frame(const Picture& shown, Viewport viewport)
      : picture(shown),
        look(look_of(shown.theme)),
        wheel_radius(shown.wheel_radius_mm.value_or(wheel_radius_mm(shown.pot))) {
    const Camera& camera = picture.camera;
    const double opening = opening_of(picture.cut);
    const double middle = picture.cut_azimuth_rad.value_or(camera.azimuth_rad);
    sweep = {middle + 0.5 * opening, middle + 2.0 * kPi - 0.5 * opening};
    px_per_mm = 0.5 * viewport.height_px / (std::tan(0.5 * camera.fov_rad) * camera.distance_mm);
    bodies = bodies_of(picture.pot, kStraightPx / px_per_mm);
    fill_block(viewport);
  }

  void fill_block(Viewport viewport) {
    const Camera& camera = picture.camera;
    block.view_projection =
        glm::mat4(projection_matrix(camera, viewport.aspect()) * view_matrix(camera));
    block.eye = glm::vec4(glm::vec3(eye_mm(camera)), 1.0f);
    const auto turn = static_cast<float>(picture.wheel_turn_rad);
    block.to_lamp = glm::vec4(beside_camera(camera, lamp_direction()), std::cos(turn));
    block.to_rim_lamp = glm::vec4(beside_camera(camera, rim_lamp_direction()), std::sin(turn));
    block.lamp = glm::vec4(look.lamp, 0.0f);
    block.sky = glm::vec4(look.sky, 0.0f);
    block.bounce = glm::vec4(look.bounce, 0.0f);
    block.rim = glm::vec4(look.rim, 0.0f);
    block.low = glm::vec4(look.low, 0.0f);
    block.high = glm::vec4(look.high, 0.0f);
    block.viewport = {viewport.width_px, viewport.height_px, 1.0f, 0.0f};
    if (picture.wall_map && !picture.pot.wall_mm.empty())
      block.wall_map = {picture.wall_map->limit_mm, picture.wall_map->top_mm, 1.0f, 0.0f};
    block.wheel = {picture.wheel_turn_rad, wheel_radius, kThickness * wheel_radius,
                   size_of(picture.pot)};
  }

  [[nodiscard]] int sectors_for(double radius_mm) const {
    const double radius_px = std::max(1.0, radius_mm * px_per_mm);
    const double wanted = kPi / std::acos(1.0 - std::min(1.0, kChordPx / radius_px));
    return std::clamp(16 * static_cast<int>(std::ceil(wanted / 16.0)), 48, 320);
  }
  [[nodiscard]] bool from_above() const { return block.eye.y > 0.0f; }
};

Result<ScenePainter> ScenePainter::create() {
  ScenePainter made;
  struct Wanted {
    Program ScenePainter::*program;
    const char* name;
    std::string vertex, fragment;
  };
  const Wanted all[] = {
      {&ScenePainter::background_, "background", background_vertex(), background_fragment()},
      {&ScenePainter::clay_, "clay", revolve_vertex(), clay_fragment()},
      {&ScenePainter::plain_, "plain", revolve_vertex(), plain_fragment()},
      {&ScenePainter::wheel_, "wheel", revolve_vertex(), wheel_fragment()},
      {&ScenePainter::ground_, "ground", revolve_vertex(), ground_fragment()},
      {&ScenePainter::slice_, "slice", slice_vertex(), slice_fragment()}};
  for (const Wanted& wanted : all) {
    auto program = frame_program(wanted.name, wanted.vertex, wanted.fragment);
    if (!program) return tl::make_unexpected(program.error());
    made.*wanted.program = std::move(*program);
  }
  made.block_ = make_buffer();
  made.nothing_ = make_vertex_array();
  made.shadow_ = make_texture();
  made.revolver_ = Revolver::create();
  made.slices_ = SliceFan::create();
  return made;
}

void ScenePainter::paint(const Picture& picture, Viewport viewport) {
  Frame frame(picture, viewport);
  const ShadowMap shadow = shadow_of(frame.bodies, glm::vec3(frame.block.to_lamp));
  frame.block.viewport.z = shadow.half_side_mm;
  send(shadow);
  send(frame.block);
  glViewport(0, 0, viewport.width_px, viewport.height_px);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_STENCIL_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glFrontFace(GL_CCW);
  paint_clay(frame);
  if (picture.cut != Cut::none) paint_section(frame);
  if (picture.tool) {
    paint_tool(frame);
    paint_arrow(frame);
  }
  if (frame.from_above()) paint_wheel(frame);
  paint_background();
  glBindVertexArray(0);
  glUseProgram(0);
}

void ScenePainter::send(const FrameBlock& block) {
  glBindBuffer(GL_UNIFORM_BUFFER, block_.get());
  glBufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, kBlockBinding, block_.get());
}

void ScenePainter::send(const ShadowMap& map) {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, shadow_.get());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  constexpr auto kSide = static_cast<GLsizei>(ShadowMap::kSide);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RG8, kSide, kSide, 0, GL_RG, GL_UNSIGNED_BYTE,
               map.light.data());
  for (const GLenum filter : {GLenum{GL_TEXTURE_MIN_FILTER}, GLenum{GL_TEXTURE_MAG_FILTER}})
    glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  for (const GLenum wrap : {GLenum{GL_TEXTURE_WRAP_S}, GLenum{GL_TEXTURE_WRAP_T}})
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
}

/// At the far plane, so only where nothing else is.
void ScenePainter::paint_background() {
  glUseProgram(background_.get());
  glBindVertexArray(nothing_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void ScenePainter::revolve(const Program& program, const std::vector<Stretch>& meridian,
                           const glm::mat4& place, const Frame& frame) {
  float radius = 0.0f;
  for (const Stretch& stretch : meridian) radius = std::max(radius, stretch.to.x);
  set(program, "place", place);
  revolver_.draw(meridian, frame.sectors_for(static_cast<double>(radius)));
}

void ScenePainter::paint_clay(const Frame& frame) {
  glUseProgram(clay_.get());
  set(clay_, "sweep", frame.sweep);
  set(clay_, "turn", static_cast<float>(frame.picture.wheel_turn_rad));
  set(clay_, "cut", frame.picture.cut == Cut::none ? 0.0f : 1.0f);
  for (const Body& body : frame.bodies) {
    set(clay_, "rim", glm::vec2{body.levels.back().inner, body.levels.back().y});
    revolve(clay_, meridian_of(body.levels), body.place, frame);
  }
}

void ScenePainter::paint_section(const Frame& frame) {
  glUseProgram(slice_.get());
  glDisable(GL_CULL_FACE);
  set(slice_, "section", glm::vec4(frame.look.section, 1.0f));
  for (const Body& body : frame.bodies) {
    set(slice_, "place", body.place);
    slices_.load(slices_of(body.levels));
    for (const float azimuth : {frame.sweep.x, frame.sweep.y}) {
      set(slice_, "azimuth", azimuth);
      slices_.draw();
    }
  }
  glEnable(GL_CULL_FACE);
}

void ScenePainter::paint_tool(const Frame& frame) {
  const ToolView& tool = *frame.picture.tool;
  const std::vector<Stretch> meridian = meridian_of(tool.half_profile_mm);
  float widest = 0.0f;
  for (const glm::vec2& p : tool.half_profile_mm) widest = std::max(widest, p.x);
  const double from_axis = std::hypot(tool.place_mm.x, tool.place_mm.z);
  const glm::dvec3 radial = from_axis > 0.0
                                ? glm::dvec3{tool.place_mm.x, 0.0, tool.place_mm.z} / from_axis
                                : glm::dvec3{1.0, 0.0, 0.0};
  glUseProgram(plain_.get());
  set(plain_, "sweep", glm::vec2{0.0f, static_cast<float>(2.0 * kPi)});
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

void ScenePainter::paint_arrow(const Frame& frame) {
  const ToolView& tool = *frame.picture.tool;
  const double force = glm::length(tool.force_n);
  if (!(force > kLeastForceN)) return;
  const glm::dvec3 way = tool.force_n / force;
  double beyond = 0.0;  // of the tool's surface, along the force
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

void ScenePainter::paint_wheel(const Frame& frame) {
  const auto radius = static_cast<float>(frame.wheel_radius);
  const float thick = frame.block.wheel.z, bevel = 0.12f * thick;
  const glm::vec2 whole{0.0f, static_cast<float>(2.0 * kPi)};
  glUseProgram(wheel_.get());
  set(wheel_, "sweep", whole);
  set(wheel_, "metal", frame.look.metal);
  const std::vector<glm::vec2> line{
      {radius, -thick}, {radius, -bevel}, {radius - bevel, 0.0f}, {radius - 2.0f * bevel, 0.0f}};
  revolve(wheel_, meridian_of(line), glm::mat4(1.0f), frame);
  glUseProgram(ground_.get());
  set(ground_, "sweep", whole);
  const std::vector<glm::vec2> floor{{static_cast<float>(kFloor) * radius, -thick}};
  revolve(ground_, meridian_of(floor), glm::mat4(1.0f), frame);
}

}  // namespace clay::draw
