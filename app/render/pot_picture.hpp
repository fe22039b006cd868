#pragma once
// Pictures and turntables of a pot for files: shared by `claystack render` and the window, so that
// the same choices give the same bytes.

#include "app/render/image_file.hpp"
#include "app/render/offscreen.hpp"
#include "app/render/picture.hpp"
#include "claystack/engine/clay.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

namespace clay::render {

inline constexpr int kMostFrames = 720;

struct PictureChoices {
  Viewport size;
  int frames = 36;  ///< of a turntable, 1 to kMostFrames
  bool section = false;
  bool alone = false;  ///< without wheel and background, which are transparent (not in a turntable)
  Theme theme = Theme::light;
  Style style = Style::geometry;
  Material material = kLeatherHard;
  std::optional<double> azimuth_deg, elevation_deg;  ///< empty: as for `framed`
  friend bool operator==(const PictureChoices&, const PictureChoices&) = default;
};

/// The whole pot, without a map of its walls.
[[nodiscard]] Picture picture_of(const Pot& pot, const PictureChoices& choices);

/// With the legend of the wall map, if there is one. Errors as for Offscreen::draw.
Result<Image> drawn(Offscreen& screen, const Picture& picture, Viewport size);

/// The number of pictures that a turntable of this many frames draws: some twice, for its colours.
[[nodiscard]] std::size_t drawings_of_turn(int frames) noexcept;
/// Called before each of `of` drawings; an error ends the turntable.
using TurnProgress = std::function<Result<void>(std::size_t done, std::size_t of)>;
/// One turn of the pot as a GIF: in about three seconds, or 20 ms a frame if that is longer.
/// Returns the number of bytes. Errors as for write_gif, and those of `progress`.
Result<std::uint64_t> write_turntable(Offscreen& screen, Picture picture,
                                      const PictureChoices& choices, const TurnProgress& progress,
                                      const ByteSink& sink);

}  // namespace clay::render
