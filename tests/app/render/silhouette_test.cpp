#include "tests/app/render/drawn.hpp"

#include <algorithm>

namespace clay::test {
namespace {

constexpr double kMarginPx = 1.5;

/// A solid of revolution, offset by `grown` mm on all sides.
struct Shape {
  std::function<double(double)> radius;  ///< at a fraction of the height
  double height_mm;
  double grown_mm;
};

/// Marches along the ray: an independent test of intersection.
bool meets(const Shape& shape, const glm::dvec3& eye, const glm::dvec3& ray, double far_mm) {
  constexpr int kSteps = 4000;
  for (int k = 0; k < kSteps; ++k) {
    const glm::dvec3 at = eye + ray * (far_mm * (k + 0.5) / kSteps);
    if (at.y < -shape.grown_mm || at.y > shape.height_mm + shape.grown_mm) continue;
    const double part = std::clamp(at.y / shape.height_mm, 0.0, 1.0);
    if (std::hypot(at.x, at.z) < shape.radius(part) + shape.grown_mm) return true;
  }
  return false;
}

void expect_silhouette(const std::function<double(double)>& radius, double wall_mm,
                       double elevation_rad) {
  constexpr double kHeight = 120.0;
  const render::Picture picture = picture_of(pot_of(radius, kHeight, wall_mm, 8.0), elevation_rad);
  const render::Image image = drawn(in_yellow(picture));
  const render::Camera& camera = picture.camera;
  const double px_mm = 2.0 * std::tan(0.5 * camera.fov_rad) * camera.distance_mm / kView.height_px;
  const Shape less{radius, kHeight, -kMarginPx * px_mm}, more{radius, kHeight, kMarginPx * px_mm};
  int inside = 0, holes = 0, spills = 0;
  for (int y = 0; y < kView.height_px; y += 2)
    for (int x = 0; x < kView.width_px; x += 2) {
      const glm::dvec3 ray = ray_through(camera, kView, x + 0.5, y + 0.5);
      const bool clay = is_clay(image.at(x, y));
      const bool must = meets(less, render::eye_mm(camera), ray, 2.0 * camera.distance_mm);
      inside += must;
      holes += must && !clay;
      spills += clay && !meets(more, render::eye_mm(camera), ray, 2.0 * camera.distance_mm);
    }
  EXPECT_GT(inside, 3000);
  EXPECT_EQ(holes, 0);
  EXPECT_EQ(spills, 0);
}

double cylinder(double) { return 45.0; }
double silhouette_cone(double part) { return 20.0 + 50.0 * part; }
double ball(double part) {
  return std::sqrt(60.5 * 60.5 - 120.0 * 120.0 * (part - 0.5) * (part - 0.5));
}

TEST(Silhouette, OutlinesASolidCylinder) { expect_silhouette(cylinder, 0.0, 0.4); }
TEST(Silhouette, OutlinesACylinderWithABore) { expect_silhouette(cylinder, 6.0, 0.7); }
TEST(Silhouette, OutlinesAConeThatOpensUpwards) { expect_silhouette(silhouette_cone, 5.0, 0.9); }
TEST(Silhouette, ShowsAClosedFloorFromAbove) { expect_silhouette(cylinder, 5.0, 1.5); }
TEST(Silhouette, OutlinesABall) { expect_silhouette(ball, 0.0, 0.3); }
TEST(Silhouette, ShowsAClosedFootFromBelow) { expect_silhouette(cylinder, 6.0, -0.6); }

TEST(Silhouette, IsIndependentOfTheNumberOfRows) {
  const auto of_rows = [](std::size_t rows) {
    return drawn(in_yellow(picture_of(pot_of(cylinder, 120.0, 5.0, 12.0, rows))));
  };
  EXPECT_EQ(of_rows(20), of_rows(2000));
}

}  // namespace
}  // namespace clay::test
