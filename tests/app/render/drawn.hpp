#pragma once
// Pots of known shape, pictures of them, and the contents of pixels.

#include "app/render/offscreen.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <functional>

namespace clay::test {

inline constexpr render::Viewport kView{480, 360};

/// Rows of a wall from `outer(0)` to `outer(1)`, with a bore above the floor.
inline render::PotView pot_of(const std::function<double(double)>& outer, double height_mm,
                              double wall_mm = 0.0, double floor_mm = 0.0, std::size_t rows = 200) {
  render::PotView pot;
  pot.height_mm = height_mm;
  for (std::size_t i = 0; i < rows; ++i) {
    const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(rows);
    const double radius = outer(part);
    const bool bored = wall_mm > 0.0 && part * height_mm > floor_mm;
    pot.rows.push_back(
        {static_cast<float>(radius), bored ? static_cast<float>(radius - wall_mm) : 0.0f});
  }
  return pot;
}

inline render::Picture picture_of(render::PotView pot, double elevation_rad = 0.4) {
  render::Picture picture;
  picture.pot = std::move(pot);
  picture.camera.azimuth_rad = 0.7;
  picture.camera.elevation_rad = elevation_rad;
  picture.camera = render::framed(picture.pot, kView.aspect(), picture.camera);
  return picture;
}

inline render::Image drawn(const render::Picture& picture, render::Viewport view = kView) {
  static auto screen = render::Offscreen::create();
  if (!screen) throw std::runtime_error(screen.error().message);
  return screen->draw(picture, view).value();
}

/// Clay at the top of the wall map's range: yellow in any light, unlike everything else.
inline render::Picture in_yellow(render::Picture picture) {
  picture.pot.wall_mm.assign(picture.pot.rows.size(), {10.0f, 10.0f});
  picture.wall_map = render::WallMap{0.0, 10.0};
  return picture;
}
inline bool is_clay(const std::uint8_t* rgba) { return rgba[0] > 60 && rgba[0] > 2 * rgba[2]; }

inline bool is_near(const std::uint8_t* rgba, int red, int green, int blue, int by) {
  return std::abs(rgba[0] - red) <= by && std::abs(rgba[1] - green) <= by &&
         std::abs(rgba[2] - blue) <= by;
}

/// Direction of the ray through a point of the picture [px]; independent of `profile_point`.
inline glm::dvec3 ray_through(const render::Camera& camera, render::Viewport view, double x,
                              double y) {
  const glm::dmat4 back =
      glm::inverse(render::projection_matrix(camera, view.aspect()) * render::view_matrix(camera));
  const glm::dvec4 far =
      back * glm::dvec4(2.0 * x / view.width_px - 1.0, 1.0 - 2.0 * y / view.height_px, 1.0, 1.0);
  return glm::normalize(glm::dvec3(far) / far.w - render::eye_mm(camera));
}

}  // namespace clay::test
