#include "app/render/legend.hpp"
#include "app/render/pot_picture.hpp"
#include "app/render/wall_rows.hpp"
#include "tests/app/render/drawn.hpp"

#include <algorithm>
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

TEST(WallMap, StripesOfTheCutCrossThoseOfTheBore) {
  render::Picture picture = banded({2.0f}, 3.0);
  picture.cut = render::Cut::half;
  const render::Image image = drawn(picture);
  // Pale pixels that repeat one pixel up and to the right, less those up and to the left.
  const auto slope_at = [&](double rho, double y) {
    const auto px =
        render::pixel_of(picture.camera, kView,
                         rho * render::profile_direction(picture.camera) + glm::dvec3{0, y, 0})
            .value();
    const auto pale = [&](int x, int row) {
      return int{image.at(static_cast<int>(px.x) + x, static_cast<int>(px.y) + row)[2]} > 120;
    };
    int rising = 0;
    for (int row = -12; row < 12; ++row)
      for (int x = -12; x < 12; ++x)
        if (pale(x, row)) rising += pale(x + 2, row - 2) - pale(x - 2, row - 2);
    return rising;
  };
  EXPECT_GT(slope_at(37.5, 50.0), 50);  // on the cut: up to the right
  EXPECT_LT(slope_at(0.0, 50.0), -50);  // on the bore behind it: up to the left
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

/// An image of one colour.
render::Image plain(int width, int height, std::uint8_t grey, std::uint8_t alpha = 255) {
  render::Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    image.rgba.insert(image.rgba.end(), {grey, grey, grey, alpha});
  return image;
}

bool is_colour(const std::uint8_t* px, render::Swatch s) {
  return is_near(px, s.red, s.green, s.blue, 0);
}

TEST(WallMap, LegendMatchesTheColourScale) {
  const render::WallMap map{2.0, 10.0};
  render::Image image = plain(640, 480, 255);
  render::draw_legend(map, render::Theme::light, image);
  // The column with the most colours is in the bar. From its top down: the scale, then red with
  // stripes for a fifth.
  const auto rows_in = [&](int x, const auto& matches) {
    std::vector<int> rows;
    for (int y = 0; y < image.height_px; ++y)
      if (matches(image.at(x, y))) rows.push_back(y);
    return rows;
  };
  const auto coloured = [](const std::uint8_t* px) { return std::abs(px[0] - px[2]) > 20; };
  int bar = 0;
  for (int x = 1; x < image.width_px; ++x)
    if (rows_in(x, coloured).size() > rows_in(bar, coloured).size()) bar = x;
  const auto rows = rows_in(bar, coloured);
  ASSERT_GT(rows.size(), 150u);
  const int top = rows.front(), height = rows.back() - top + 1;
  for (const double mm : {2.1, 4.0, 6.0, 8.0, 9.9}) {
    const int y = top + static_cast<int>(std::lround((1.0 - mm / map.top_mm) * height - 0.5));
    const auto *px = image.at(bar, y), *above = image.at(bar, y - 1);
    const render::Swatch wanted = render::wall_swatch(map, mm);
    EXPECT_TRUE(is_near(px, wanted.red, wanted.green, wanted.blue, 4) ||
                is_near(above, wanted.red, wanted.green, wanted.blue, 4))
        << mm << " mm at " << y;
  }
  const render::Swatch thin = render::wall_swatch(map, 1.0);
  const auto red = rows_in(bar, [&](const auto* px) { return is_colour(px, thin); });
  EXPECT_GT(std::ssize(red), height / 10);  // the stripes take the rest
  EXPECT_NEAR(red.front(), top + 0.8 * height, 8.0);
  EXPECT_LE(red.back(), rows.back());
}

// A wall passes that is 0.1 % below the limit; the legend states the limit.
TEST(WallMap, LegendStatesTheLimitWithoutItsTolerance) {
  Pot pot;
  pot.stack = ClayStack::cylinder(50, 1.0, 40.0, 30.0, 50).value();
  solid::WallDemand demand;
  demand.min_wall_mm = 6.0;
  render::Picture picture = render::picture_of(pot, {});
  ASSERT_TRUE(render::show_walls(pot, demand, picture));
  EXPECT_LT(picture.wall_map->limit_mm, 6.0);
  const auto legend_of = [](const render::WallMap& map) {
    render::Image image = plain(640, 440, 255);
    render::draw_legend(map, render::Theme::light, image);
    return image;
  };
  // At this size, no row of the scale lies between the two.
  EXPECT_EQ(legend_of(*picture.wall_map), legend_of({6.0, 10.0}));
}

TEST(WallMap, LegendHasSmoothLettersAndStaysAtTheLeft) {
  for (const render::Viewport size : {render::Viewport{240, 240}, {1280, 720}, {2000, 300}}) {
    render::Image image = plain(size.width_px, size.height_px, 255);
    render::draw_legend({4.995, 10.0}, render::Theme::light, image);
    std::vector<bool> greys(256, false);
    int right = 0, bottom = 0, top = size.height_px;
    for (int y = 0; y < size.height_px; ++y)
      for (int x = 0; x < size.width_px; ++x) {
        const auto* px = image.at(x, y);
        if (px[0] == 255 && px[1] == 255 && px[2] == 255) continue;
        right = std::max(right, x);
        bottom = std::max(bottom, y);
        top = std::min(top, y);
        if (std::abs(px[0] - px[2]) < 8) greys[px[0]] = true;
      }
    EXPECT_GT(std::count(greys.begin(), greys.end(), true), 40) << "letters of two colours only";
    EXPECT_LT(right, 0.5 * std::min(size.width_px, size.height_px));
    EXPECT_GT(top, 0);
    EXPECT_LT(bottom, size.height_px - 1);
    EXPECT_NEAR(top, size.height_px - 1 - bottom, 2.0) << "in the middle of the height";
  }
}

TEST(WallMap, LegendOfATransparentPictureKeepsItsColours) {
  render::Image opaque = plain(640, 480, 255), clear = plain(640, 480, 0, 0);
  const render::WallMap map{0.0, 10.0};
  render::draw_legend(map, render::Theme::dark, opaque);
  render::draw_legend(map, render::Theme::dark, clear);
  for (std::size_t i = 0; i < clear.rgba.size(); i += 4) {
    const double alpha = clear.rgba[i + 3] / 255.0;  // laid over white afterwards
    for (std::size_t k = i; k < i + 3; ++k)
      ASSERT_NEAR(clear.rgba[k] * alpha + 255.0 * (1.0 - alpha), opaque.rgba[k], 1.6) << i;
  }
}

TEST(WallMap, SmallPicturesHaveNoLegend) {
  render::Image small = plain(100, 100, 7);
  render::draw_legend({2.0, 10.0}, render::Theme::dark, small);
  EXPECT_EQ(small, plain(100, 100, 7));
}

}  // namespace
}  // namespace clay::test
