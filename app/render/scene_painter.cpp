#include "app/render/scene_painter.hpp"

#include "app/render/scene_frame.hpp"
#include "app/render/wall_swatch.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>

namespace clay::render {
namespace {

constexpr double kFloor = 3.0;  // radius of the floor, in radii of the wheel head
constexpr GLuint kBlockBinding = 0;
constexpr float kFacingMirror = 0.04f;  // reflectance of clay, water and glass at normal incidence

Result<Program> frame_program(std::string_view name, const std::string& vertex,
                              const std::string& fragment) {
  return make_program(name, vertex, fragment).map([](Program program) {
    const GLuint block = glGetUniformBlockIndex(program.get(), "Frame");
    if (block != GL_INVALID_INDEX) glUniformBlockBinding(program.get(), block, kBlockBinding);
    glUseProgram(program.get());
    glUniform4fv(location(program, "map_colours"), kMapColours,
                 glm::value_ptr(map_colours().front()));
    set(program, "thin_wall", linear_of(kThinWall));
    set(program, "thin_wall_stripe", linear_of(kThinWallStripe));
    return program;
  });
}

}  // namespace

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
      {&ScenePainter::coated_, "coated clay", revolve_vertex(), coated_clay_fragment()},
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

void ScenePainter::paint(const Picture& picture, Viewport viewport, PixelRows rows,
                         int lowest_row) {
  const SceneFrame frame(picture, viewport);
  FrameBlock block = frame.block;
  block.viewport.w = static_cast<float>(lowest_row);
  if (!picture.alone && frame.from_above()) {
    const ShadowMap shadow = shadow_of(frame.bodies, glm::vec3(frame.block.to_lamp), frame.sweep);
    block.viewport.z = shadow.half_side_mm;
    send(shadow);
  }
  send(block);
  glViewport(0, -lowest_row, viewport.width_px, viewport.height_px);
  glDisable(GL_BLEND);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, rows.first - lowest_row, viewport.width_px, rows.count);
  glDisable(GL_STENCIL_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  glClear(picture.alone ? GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT : GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glFrontFace(GL_CCW);
  paint_clay(frame);
  if (picture.cut != Cut::none) paint_section(frame);
  if (picture.tool) {
    paint_hidden_tool(frame);
    paint_tool(frame);
    paint_arrow(frame);
  }
  if (!picture.alone && frame.from_above()) paint_wheel(frame);
  if (!picture.alone) paint_background();
  glDisable(GL_SCISSOR_TEST);
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
  filter_linearly();
}

/// At the far plane, so it covers only empty pixels.
void ScenePainter::paint_background() {
  glUseProgram(background_.get());
  glBindVertexArray(nothing_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void ScenePainter::revolve(const Program& program, const std::vector<Stretch>& meridian,
                           const glm::mat4& place, const SceneFrame& frame) {
  float radius = 0.0f;
  for (const Stretch& stretch : meridian) radius = std::max(radius, stretch.to.x);
  set(program, "place", place);
  revolver_.draw(meridian, frame.sectors_for(static_cast<double>(radius)));
}

void ScenePainter::set_material(const Program& program, const Material& material) {
  const auto colour = [](const Reflectance& c, float fourth) {
    return glm::vec4(c[0], c[1], c[2], fourth);
  };
  set(program, "base", colour(material.base, material.speckle));
  // Blinn's exponent for a roughness (glTF's alpha = roughness squared), with a lobe of equal
  // energy.
  const float alpha = material.roughness * material.roughness;
  const float exponent = 2.0f / (alpha * alpha);
  set(program, "lobe", glm::vec2{exponent, kFacingMirror * (exponent + 2.0f) / 8.0f});
  if (material.coat <= 0.0f) return;
  set(program, "coat", glm::vec2{material.coat, material.coat_roughness});
  set(program, "thin", colour(material.thin, material.glaze ? 1.0f : 0.0f));
  set(program, "bare", glm::vec3(colour(material.bare, 0.0f)));
}

void ScenePainter::paint_clay(const SceneFrame& frame) {
  const Material& material = frame.picture.material;
  const Program& program = material.coat > 0.0f ? coated_ : clay_;
  glUseProgram(program.get());
  set_material(program, material);
  set(program, "sweep", frame.sweep);
  set(program, "turn", static_cast<float>(frame.picture.wheel_turn_rad));
  const bool hands = frame.picture.style == Style::clay;
  set(program, "hands", hands ? 1.0f : 0.0f);
  set(program, "cut", frame.picture.cut == Cut::none ? 0.0f : 1.0f);
  for (const Body& body : frame.bodies) {
    set(program, "rim", glm::vec2{body.levels.back().inner, body.levels.back().y});
    revolve(program, meridian_of(body.levels, hands), body.place, frame);
  }
}

void ScenePainter::paint_section(const SceneFrame& frame) {
  glUseProgram(slice_.get());
  glDisable(GL_CULL_FACE);
  set(slice_, "section", glm::vec4(section_colour(frame.picture.material), 1.0f));
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

void ScenePainter::paint_wheel(const SceneFrame& frame) {
  const auto radius = static_cast<float>(frame.wheel_radius);
  const float thick = frame.block.wheel.z, bevel = 0.12f * thick;
  const glm::vec2 whole{0.0f, static_cast<float>(2.0 * std::numbers::pi)};
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

}  // namespace clay::render
