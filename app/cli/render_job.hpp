#pragma once
// The stages of `claystack render`: read the clay, measure its walls, draw, write.

#include "app/cli/console.hpp"
#include "app/render/pot_picture.hpp"
#ifdef CLAYSTACK_EXPORT
#include "app/cli/wall_options.hpp"
#endif

#include "claystack/engine/clay.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace clay::cli {

struct RenderCommand {
  std::string pot;        ///< or a scene: its lump is drawn
  std::string out;        ///< .png; empty: none
  std::string turntable;  ///< .gif; empty: none
  render::PictureChoices choices;
  std::optional<render::Viewport> size_asked;  ///< of picture and turntable
  render::Viewport turntable_size{640, 360};   ///< if no size is asked for
  std::optional<int> frames_asked;             ///< of the turntable; overrides those of `choices`
  bool wall_map = false, time = false;
#ifdef CLAYSTACK_EXPORT
  WallOptions walls;
#endif
};

/// Medians over some frames.
struct FrameTime {
  double ms = 0.0, anti_aliased_ms = 0.0;
};

/// The result, for people and scripts.
struct Rendered {
  std::uint64_t png_bytes = 0, gif_bytes = 0;
  std::string renderer;
  std::optional<FrameTime> frame;
  std::optional<render::WallMap> map;
  std::optional<double> thinnest_mm;
};

Result<Rendered> render(const RenderCommand& command, const Console& console);

}  // namespace clay::cli
