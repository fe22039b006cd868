#pragma once
// The stages of a frame: clay, section, tool, wheel, floor, background; nearest first, so that
// hidden parts are not shaded.

#include "app/render/gl_objects.hpp"
#include "app/render/look.hpp"
#include "app/render/picture.hpp"
#include "app/render/revolver.hpp"
#include "app/render/shadow.hpp"

#include <vector>

namespace clay::render {

struct SceneFrame;

class ScenePainter {
 public:
  static Result<ScenePainter> create();
  /// Draws these rows into the bound framebuffer, whose lowest row is `lowest_row` of the picture.
  void paint(const Picture& picture, Viewport viewport, PixelRows rows, int lowest_row);

 private:
  void paint_background();
  static void set_material(const Program& program, const Material& material);
  void paint_clay(const SceneFrame& frame);
  void paint_section(const SceneFrame& frame);
  void paint_tool(const SceneFrame& frame);
  void paint_hidden_tool(const SceneFrame& frame);
  void paint_arrow(const SceneFrame& frame);
  void paint_wheel(const SceneFrame& frame);
  void send(const FrameBlock& block);
  void send(const ShadowMap& map);
  void revolve(const Program& program, const std::vector<Stretch>& meridian, const glm::mat4& place,
               const SceneFrame& frame);

  Program background_, clay_, coated_, plain_, wheel_, ground_, slice_;
  Buffer block_;
  VertexArray nothing_;  ///< for the background, whose vertices are computed from their indices
  Texture shadow_;
  Revolver revolver_;
  SliceFan slices_;
};

}  // namespace clay::render
