#include "app/render/thumbnail.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace clay::test {
namespace {

constexpr int kSide = 200;
constexpr render::Viewport kSquare{kSide, kSide};

/// 100 mm high and wide; a wall of 5 mm above a floor of 10 mm.
render::PotView cylinder() {
  render::PotView pot;
  pot.height_mm = 100.0;
  for (int row = 0; row < 100; ++row) pot.rows.push_back({50.0F, row < 10 ? 0.0F : 45.0F});
  return pot;
}

bool ground(const render::Image& image, double x, double y) {
  const std::uint8_t* corner = image.at(0, 0);
  const std::uint8_t* pixel = image.at(static_cast<int>(x), static_cast<int>(y));
  return pixel[0] == corner[0] && pixel[1] == corner[1] && pixel[2] == corner[2];
}

TEST(Thumbnail, HasTheOutlineOfThePot) {
  const render::PotView pot = cylinder();
  const render::Image image = render::thumbnail(pot, kSide);
  const render::Camera camera = render::framed(pot, 1.0);
  const glm::dvec3 across = render::profile_direction(camera);
  for (const double height : {20.0, 50.0, 80.0})
    for (const double side : {-1.0, 1.0}) {
      const auto at = [&](double rho) {
        return *render::pixel_of(camera, kSquare, rho * side * across + glm::dvec3(0, height, 0));
      };
      EXPECT_FALSE(ground(image, at(48.5).x, at(48.5).y)) << height;
      EXPECT_TRUE(ground(image, at(53.0).x, at(53.0).y)) << height;
    }
  EXPECT_EQ(image, render::thumbnail(pot, kSide));
}

TEST(Thumbnail, ShowsTheBoreDarkerThanTheRim) {
  const render::PotView pot = cylinder();
  const render::Image image = render::thumbnail(pot, kSide);
  const render::Camera camera = render::framed(pot, 1.0);
  const glm::dvec3 across = render::profile_direction(camera);
  const auto red = [&](double rho) {
    const auto at = *render::pixel_of(camera, kSquare, rho * across + glm::dvec3(0, 100.0, 0));
    return int{image.at(static_cast<int>(at.x), static_cast<int>(at.y))[0]};
  };
  EXPECT_GT(red(47.5), red(20.0) + 30);
  EXPECT_GT(red(-47.5), red(-20.0) + 30);
}

TEST(Thumbnail, ShowsAFallenPartAtItsPlace) {
  render::PotView pot = cylinder();
  pot.fallen = render::FallenView{50, glm::translate(glm::dmat4(1.0), glm::dvec3(0, -50, 130))};
  const render::Image image = render::thumbnail(pot, kSide);
  const render::Camera camera = render::framed(pot, 1.0);
  const auto at = [&](const glm::dvec3& place) {
    const auto px = *render::pixel_of(camera, kSquare, place);
    return ground(image, px.x, px.y);
  };
  EXPECT_FALSE(at({0, 25, 180}));
  EXPECT_FALSE(at({0, 25, 0}));
  EXPECT_TRUE(at({0, 90, -40}));
}

}  // namespace
}  // namespace clay::test
