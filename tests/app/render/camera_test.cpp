#include "app/render/camera.hpp"

#include "tests/app/render/drawn.hpp"

#include <rapidcheck/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace clay::test {
namespace {

using render::Camera;

double between(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1'000'001) * 1e-6;
}

Camera any_camera() {
  return {between(-7, 7),    between(-1.5, 1.5),
          between(50, 2000), {between(-50, 50), between(-20, 150), between(-50, 50)},
          between(0.1, 1.5), between(0.0, 0.6)};
}

RC_GTEST_PROP(Camera, PickingInvertsTheProjection, ()) {
  const Camera camera = any_camera();
  const double rho = between(-120, 120), y = between(0, 200);
  const glm::dvec3 at = rho * render::profile_direction(camera) + glm::dvec3{0, y, 0};
  const auto pixel = render::pixel_of(camera, kView, at);
  RC_PRE(pixel.has_value());
  // Near the zenith the plane is seen edge-on, and doubles cannot resolve heights.
  RC_PRE(std::abs(camera.elevation_rad) < 1.3);
  const auto back = render::profile_point(camera, kView, *pixel);
  RC_ASSERT(back.has_value());
  RC_ASSERT(std::abs(back->x - rho) < 1e-6);
  RC_ASSERT(std::abs(back->y - y) < 1e-6);
}

RC_GTEST_PROP(Camera, MatricesProjectToTheSamePixel, ()) {
  const Camera camera = any_camera();
  const glm::dvec3 at{between(-100, 100), between(0, 200), between(-100, 100)};
  const auto pixel = render::pixel_of(camera, kView, at);
  RC_PRE(pixel.has_value());
  const glm::dvec4 clip = render::projection_matrix(camera, kView.aspect()) *
                          render::view_matrix(camera) * glm::dvec4(at, 1.0);
  const double scale = 1e-9 * (1.0 + glm::length(*pixel));
  RC_ASSERT(std::abs((clip.x / clip.w + 1.0) * 240.0 - pixel->x) < scale);
  RC_ASSERT(std::abs((1.0 - clip.y / clip.w) * 180.0 - pixel->y) < scale);
}

TEST(Camera, FramesANarrowFlangeWhereverItIs) {
  const auto with_flange = [](std::size_t row) {
    render::PotView pot;
    pot.height_mm = 100.0;
    pot.rows.assign(1000, {20.0f, 15.0f});
    pot.rows[row].outer_mm = 80.0f;
    return pot;
  };
  const double none = render::wheel_radius_mm(with_flange(0));
  const double near = render::framed(with_flange(500), 1.5).distance_mm;
  for (const std::size_t row : {501u, 506u, 509u, 514u}) {
    const render::PotView pot = with_flange(row);
    EXPECT_EQ(render::wheel_radius_mm(pot), none) << row;
    EXPECT_NEAR(render::framed(pot, 1.5).distance_mm, near, 0.03 * near) << row;
  }
}

TEST(Camera, LooksAtItsTargetFromItsEye) {
  const Camera camera{0.3, 0.5, 400.0, {5.0, 60.0, -3.0}, 0.5};
  EXPECT_NEAR(glm::distance(render::eye_mm(camera), camera.target_mm), 400.0, 1e-9);
  const glm::dmat4 expected =
      glm::lookAt(render::eye_mm(camera), camera.target_mm, glm::dvec3{0, 1, 0});
  for (int i = 0; i < 4; ++i)
    EXPECT_LT(glm::length(expected[i] - render::view_matrix(camera)[i]), 1e-9);
  const auto middle = render::pixel_of(camera, kView, camera.target_mm);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->x, 240.0, 1e-9);
  EXPECT_NEAR(middle->y, 180.0, 1e-9);
}

TEST(Camera, PicksNothingBehindTheCamera) {
  const Camera up{0.0, -1.2, 400.0, {0.0, 50.0, 0.0}, 1.0};
  const Camera past{0.0, 0.0, 10.0, {0.0, 50.0, 300.0}, 0.5};  // the axis is behind the target
  EXPECT_TRUE(render::profile_point(past, kView, {240, 180}));
  const Camera away{0.0, 0.0, 10.0, {0.0, 50.0, -300.0}, 0.5};  // faces away from the axis
  EXPECT_FALSE(render::profile_point(away, kView, {240, 180}));
  EXPECT_FALSE(render::pixel_of(up, kView, render::eye_mm(up) * 2.0 - up.target_mm));
}

TEST(Camera, DraggingMovesThePointUnderTheMouse) {
  const Camera camera{0.3, 0.5, 400.0, {0.0, 60.0, 0.0}, 0.5};
  const Camera moved = render::panned(camera, {30.0, -20.0}, kView);
  const auto now = render::pixel_of(moved, kView, camera.target_mm);
  ASSERT_TRUE(now);
  EXPECT_NEAR(now->x, 270.0, 1e-6);
  EXPECT_NEAR(now->y, 160.0, 1e-6);
  // Points in front move with the mouse when the pot is rotated.
  const glm::dvec3 front =
      camera.target_mm + 50.0 * glm::normalize(render::eye_mm(camera) - camera.target_mm);
  const auto turned = render::pixel_of(render::orbited(camera, {20.0, 10.0}, kView), kView, front);
  ASSERT_TRUE(turned);
  EXPECT_GT(turned->x, 240.0);
  EXPECT_GT(turned->y, 180.0);
}

TEST(Camera, ZoomAndOrbitRespectTheirLimits) {
  Camera camera;
  const render::Extent pot{60.0, 150.0};
  const auto zoomed = [&](const Camera& from, double by) { return render::zoomed(from, by, pot); };
  EXPECT_LT(zoomed(camera, 1).distance_mm, camera.distance_mm);
  EXPECT_NEAR(zoomed(zoomed(camera, 3), -3).distance_mm, camera.distance_mm, 1e-9);
  EXPECT_DOUBLE_EQ(zoomed(camera, -1e6).distance_mm, 20.0 * pot.height_mm);
  for (const double azimuth : {0.0, 2.0})
    for (const double elevation : {-0.4, 0.0, 0.3, 1.2, render::kSteepest})
      for (const glm::dvec3& target : {glm::dvec3(0, 75, 0), glm::dvec3(50, 140, 10)}) {
        const Camera near =
            zoomed({.azimuth_rad = azimuth, .elevation_rad = elevation, .target_mm = target}, 1e6);
        const glm::dvec3 eye = render::eye_mm(near);
        const bool beside = std::hypot(eye.x, eye.z) > pot.radius_mm + 4.9;
        EXPECT_TRUE(beside || eye.y > pot.height_mm + 4.9 || eye.y < -4.9)
            << eye.x << ' ' << eye.y << ' ' << eye.z;
        EXPECT_LT(near.distance_mm, 200.0) << "the pot fills the picture";
      }
  camera.target_mm = {90.0, 75.0, 0.0};  // beside the pot
  EXPECT_DOUBLE_EQ(zoomed(camera, 1e6).distance_mm, 10.0);
  camera.distance_mm = 2e4;  // beyond the limit: the pot was larger
  EXPECT_DOUBLE_EQ(zoomed(camera, -1).distance_mm, 2e4);
  EXPECT_LT(zoomed(camera, 1).distance_mm, 2e4);
  EXPECT_DOUBLE_EQ(render::orbited(camera, {0, 1e6}, kView).elevation_rad, render::kSteepest);
  EXPECT_DOUBLE_EQ(render::orbited(camera, {0, -1e6}, kView).elevation_rad, -render::kSteepest);
}

TEST(Camera, FramingShowsThePotAndFillsThePicture) {
  for (const double height : {0.01, 20.0, 150.0, 4000.0})
    for (const double aspect : {0.5, 1.0, 16.0 / 9.0}) {
      const auto pot = pot_of([&](double part) { return 0.3 * height + 10.0 * part; }, height);
      const render::Viewport view{static_cast<int>(900 * aspect), 900};
      const Camera camera = render::framed(pot, view.aspect());
      double left = 1e9, right = -1e9, upper = 1e9, lower = -1e9;
      for (int k = 0; k < 360; ++k)
        for (const double y : {0.0, height}) {
          const double radius = 0.3 * height + (y > 0.0 ? 10.0 : 0.0), a = k * 0.0174533;
          const auto at =
              render::pixel_of(camera, view, {radius * std::sin(a), y, radius * std::cos(a)});
          ASSERT_TRUE(at);
          left = std::min(left, at->x);
          right = std::max(right, at->x);
          upper = std::min(upper, at->y);
          lower = std::max(lower, at->y);
        }
      EXPECT_GT(std::min(left, upper), 0.0);
      EXPECT_LT(right, view.width_px);
      EXPECT_LT(lower, view.height_px);
      EXPECT_GT(std::max((right - left) / view.width_px, (lower - upper) / view.height_px), 0.6);
    }
}

}  // namespace
}  // namespace clay::test
