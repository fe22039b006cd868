#include "app/render/pot_picture.hpp"

#include "app/render/pot_view.hpp"
#ifdef CLAYSTACK_EXPORT
#include "app/render/legend.hpp"
#endif

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace clay::render {
namespace {

constexpr int kTurnMs = 3000;         // one turn of the turntable
constexpr int kShortestFrameMs = 20;  // browsers slow down shorter ones

}  // namespace

Picture picture_of(const Pot& pot, const PictureChoices& choices) {
  Picture picture;
  picture.pot = view_of(pot);
  picture.theme = choices.theme;
  picture.style = choices.style;
  picture.material = choices.material;
  picture.alone = choices.alone;
  picture.cut = choices.section ? Cut::half : Cut::none;
  picture.camera = framed(picture.pot, choices.size.aspect());
  if (choices.azimuth_deg) picture.camera.azimuth_rad = glm::radians(*choices.azimuth_deg);
  if (choices.elevation_deg) picture.camera.elevation_rad = glm::radians(*choices.elevation_deg);
  picture.camera = framed(picture.pot, choices.size.aspect(), picture.camera);
  return picture;
}

Result<Image> drawn(Offscreen& screen, const Picture& picture, Viewport size) {
  return screen.draw(picture, size).map([&](Image image) {
#ifdef CLAYSTACK_EXPORT
    if (picture.wall_map) draw_legend(*picture.wall_map, picture.theme, image);
#endif
    return image;
  });
}

std::size_t drawings_of_turn(int frames) noexcept {
  const auto count = static_cast<std::size_t>(frames);
  return count + palette_frames(count);
}

Result<std::uint64_t> write_turntable(Offscreen& screen, Picture picture,
                                      const PictureChoices& choices, const TurnProgress& progress,
                                      const ByteSink& sink) {
  picture.cut_azimuth_rad = picture.camera.azimuth_rad;  // rotates with the pot
  const double step = 2.0 * std::numbers::pi / choices.frames;
  const double first = picture.camera.azimuth_rad;
  std::size_t done = 0;
  const auto frame_at = [&](std::size_t k) {
    picture.camera.azimuth_rad = first - step * static_cast<double>(k);
    return progress(done++, drawings_of_turn(choices.frames)).and_then([&] {
      return drawn(screen, picture, choices.size);
    });
  };
  return write_gif(static_cast<std::size_t>(choices.frames),
                   std::max(kShortestFrameMs, kTurnMs / choices.frames), frame_at, sink);
}

}  // namespace clay::render
