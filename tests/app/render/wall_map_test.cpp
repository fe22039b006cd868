#include "app/render/legend.hpp"
#include "app/render/wall_rows.hpp"
#include "tests/app/render/drawn.hpp"

#include <cmath>
#include <limits>

namespace clay::test {
namespace {

/// Bands of known thickness, from the foot up, on a cylinder of 100 mm.
render::Picture banded(const std::vector<float>& walls, double limit_mm) {
  render::PotView pot = pot_of([](double) { return 45.0; }, 100.0, 15.0, 10.0);
  for (std::size_t i = 0; i < pot.rows.size(); ++i) {
    const float wall = walls[i * walls.size() / pot.rows.size()];
    pot.wall_mm.push_back({wall, wall});
  }
  render::Picture picture = picture_of(pot, 0.1);
  picture.wall_map = render::WallMap{limit_mm, 10.0};
  return picture;
}

const std::uint8_t* at(const render::Image& image, const render::Camera& camera,
                       const glm::dvec3& place) {
  const auto px = render::pixel_of(camera, kView, place).value();
  return image.at(static_cast<int>(px.x), static_cast<int>(px.y));
}

/// On a cut face that opens to the camera.
const std::uint8_t* at(const render::Image& image, const render::Camera& camera, double rho,
                       double y) {
  return at(image, camera, rho * render::profile_direction(camera) + glm::dvec3{0, y, 0});
}

double linear(int byte) {
  const double c = byte / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

TEST(WallMap, UsesTheColoursOfTheScale) {
  const std::vector<float> walls{8.0f, 6.0f, 4.0f, 2.0f, 40.0f};
  render::Picture picture = banded(walls, 0.0);
  picture.cut = render::Cut::half;
  const render::Image image = drawn(picture);
  for (std::size_t k = 0; k < walls.size(); ++k) {
    const auto* px = at(image, picture.camera, 37.5, 10.0 + 20.0 * static_cast<double>(k));
    const auto swatch = render::wall_swatch(*picture.wall_map, static_cast<double>(walls[k]));
    EXPECT_TRUE(is_near(px, swatch.red, swatch.green, swatch.blue, 3))
        << walls[k] << ": " << int{px[0]} << " " << int{px[1]} << " " << int{px[2]};
  }
}

TEST(WallMap, ShadingKeepsTheHue) {
  const std::vector<float> walls{9.0f, 7.0f, 5.0f, 3.0f, 1.0f};
  const render::Picture picture = banded(walls, 0.0);
  const render::Image image = drawn(picture);
  for (std::size_t k = 0; k < walls.size(); ++k) {
    const double azimuth = picture.camera.azimuth_rad;
    const auto* px = at(
        image, picture.camera,
        {45.0 * std::sin(azimuth), 10.0 + 20.0 * static_cast<double>(k), 45.0 * std::cos(azimuth)});
    const auto swatch = render::wall_swatch(*picture.wall_map, static_cast<double>(walls[k]));
    const double green = linear(px[1]) / linear(swatch.green);
    EXPECT_GT(green, 0.45);
    EXPECT_LE(green, 1.02);
    EXPECT_NEAR(linear(px[2]) / linear(swatch.blue), green, 0.06) << walls[k];
  }
}

TEST(WallMap, HatchesThinWallsInASeparateColour) {
  render::Picture picture = banded({2.9f, 3.1f}, 3.0);
  picture.cut = render::Cut::half;
  const render::Image image = drawn(picture);
  const auto red_part = [&](double low, double high) {
    int red = 0, all = 0;
    for (double y = low; y < high; y += 0.2)
      for (double rho = 33.0; rho < 43.0; rho += 0.2, ++all)
        red += at(image, picture.camera, rho, y)[0] > 2 * at(image, picture.camera, rho, y)[2];
    return static_cast<double>(red) / all;
  };
  EXPECT_GT(red_part(15.0, 45.0), 0.5);
  EXPECT_LT(red_part(15.0, 45.0), 0.9);  // and stripes between
  EXPECT_EQ(red_part(55.0, 95.0), 0.0);
}

TEST(WallMap, ShowsUnboundedWallsAsThick) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  render::Picture picture = banded({5.0f, kInfinite, 5.0f}, 3.0);
  picture.cut = render::Cut::half;
  const render::Image image = drawn(picture);
  const auto thick = render::wall_swatch(*picture.wall_map, 10.0);
  for (double y = 1.0; y < 99.0; y += 0.25) {
    const auto* px = at(image, picture.camera, 37.5, y);
    EXPECT_FALSE(px[0] > 2 * px[1]) << y;  // none is shown as thin
  }
  EXPECT_TRUE(
      is_near(at(image, picture.camera, 37.5, 50.0), thick.red, thick.green, thick.blue, 3));
}

TEST(WallMap, RowsUseTheWallsOfTheSection) {
  // A cup: 5 mm around, a floor of 8 mm.
  std::vector<Ring> rings;
  for (int i = 0; i < 100; ++i)
    rings.push_back({quanta_from_radius(40.0), i < 8 ? 0 : quanta_from_radius(35.0)});
  const auto stack = ClayStack::from_rings(1.0, rings, 0);
  ASSERT_TRUE(stack);
  Pot pot;
  pot.stack = *stack;
  const auto mapped = render::map_walls(pot, {}, 100);
  ASSERT_TRUE(mapped) << mapped.error().message;
  EXPECT_NEAR(mapped->min_wall_mm, 5.0, 0.02);
  const std::vector<render::RowWall>& walls = mapped->rows;
  ASSERT_EQ(walls.size(), 100u);
  for (std::size_t row = 20; row < 95; ++row) {
    EXPECT_NEAR(walls[row].outer_mm, 5.0, 0.02) << row;
    EXPECT_NEAR(walls[row].inner_mm, 5.0, 0.02) << row;
  }
  EXPECT_NEAR(walls[7].inner_mm, 8.0, 0.02);
  for (std::size_t row = 0; row < 8; ++row) EXPECT_NEAR(walls[row].inner_mm, 8.0, 0.02) << row;
}

TEST(WallMap, LegendMatchesTheColourScale) {
  const render::WallMap map{2.0, 10.0};
  render::Image image{400, 360, std::vector<std::uint8_t>(4 * 400 * 360, 255)};
  render::draw_legend(map, render::Theme::light, image);
  // From the top of the bar down: yellow, then dark blue, then red below the limit.
  std::vector<const std::uint8_t*> bar;
  for (int y = 0; y < 360; ++y)
    if (!is_near(image.at(20, y), 255, 255, 255, 0)) bar.push_back(image.at(20, y));
  ASSERT_GT(bar.size(), 150u);
  int red = 0;
  for (const auto* px : bar) red += px[0] > 200 && px[1] < 80;
  EXPECT_NEAR(red, 40, 2);  // two tenths of the 200 px of the bar
  render::Image small{100, 100, std::vector<std::uint8_t>(40000, 7)};
  const render::Image before = small;
  render::draw_legend(map, render::Theme::dark, small);
  EXPECT_EQ(small, before);
}

}  // namespace
}  // namespace clay::test
