#include "app/render/painter.hpp"
#include "app/render/gl_objects.hpp"
#include "tests/app/render/drawn.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace clay::test {
namespace {

/// sRGB of the linear colour (0.43, 0.178, 0.088)^0.45: leather-hard clay, paler.
bool is_section(const std::uint8_t* rgba) { return is_near(rgba, 0xD8, 0xB5, 0x9D, 2); }

/// A picture and a turntable may be drawn at the same time.
TEST(Offscreen, StaysWhenAnotherEnds) {
  const render::Picture picture = picture_of(pot_of([](double) { return 45.0; }, 120.0, 12.0));
  auto first = render::Offscreen::create().value();
  {
    auto second = render::Offscreen::create().value();
    EXPECT_TRUE(second.draw(picture, {16, 16}));
  }
  const auto image = first.draw(picture, {16, 16});
  EXPECT_TRUE(image) << image.error().message;
}

TEST(Painter, CutFaceIsAsWideAsTheWall) {
  render::Picture picture =
      picture_of(pot_of([](double) { return 45.0; }, 120.0, 12.0, 20.0), 0.15);
  picture.cut = render::Cut::half;
  const render::Image image = drawn(picture);
  const glm::dvec3 right = render::profile_direction(picture.camera);
  const auto px = [&](double rho, double y) {
    return render::pixel_of(picture.camera, kView, rho * right + glm::dvec3{0, y, 0}).value();
  };
  for (const double y : {30.0, 60.0, 110.0})
    for (const double side : {-1.0, 1.0}) {
      const auto bore = px(side * 33.0, y), outside = px(side * 45.0, y);
      const auto row = static_cast<int>(bore.y);
      int found = 0;
      for (int x = 0; x < kView.width_px; ++x)
        found += (x > 240) == (side > 0.0) && is_section(image.at(x, row));
      EXPECT_NEAR(found, std::abs(outside.x - bore.x), 1.5) << y << " " << side;
      EXPECT_FALSE(is_section(image.at(static_cast<int>(px(side * 31.0, y).x), row)));
      EXPECT_TRUE(is_section(image.at(static_cast<int>(px(side * 39.0, y).x), row)));
    }
  // The floor is cut from side to side.
  const auto floor = px(0.0, 10.0);
  EXPECT_TRUE(is_section(image.at(static_cast<int>(floor.x), static_cast<int>(floor.y))));
  const auto above = px(0.0, 23.0);
  EXPECT_FALSE(is_section(image.at(static_cast<int>(above.x), static_cast<int>(above.y))));
}

TEST(Painter, DrawsNoSectionWithoutACut) {
  const render::Image image =
      drawn(picture_of(pot_of([](double) { return 45.0; }, 120.0, 12.0, 20.0)));
  for (int y = 0; y < kView.height_px; ++y)
    for (int x = 0; x < kView.width_px; ++x) ASSERT_FALSE(is_section(image.at(x, y)));
}

TEST(Painter, QuarterCutShowsTheSideFacingTheCamera) {
  render::Picture picture = picture_of(pot_of([](double) { return 45.0; }, 120.0, 12.0, 20.0), 0.3);
  picture.cut = render::Cut::quarter;
  const auto count = [](const render::Image& image) {
    int found = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) found += is_section(&image.rgba[i]);
    return found;
  };
  EXPECT_GT(count(drawn(picture)), 500);
  picture.cut_azimuth_rad = picture.camera.azimuth_rad + 3.14159;  // opens to the back
  EXPECT_LT(count(drawn(picture)), 200);
}

render::Picture with_tool(glm::dvec3 place) {
  render::Picture picture = picture_of(pot_of([](double) { return 30.0; }, 60.0), 0.3);
  picture.wheel_radius_mm = 80.0;
  picture.camera.distance_mm *= 1.8;
  render::ToolView tool;
  for (int k = 0; k <= 64; ++k) {
    const double a = 3.14159265358979 * k / 64;
    tool.half_profile_mm.emplace_back(10.0 * std::sin(a), -10.0 * std::cos(a));
  }
  tool.half_profile_mm.front().x = tool.half_profile_mm.back().x = 0.0f;
  tool.place_mm = place;
  picture.tool = tool;
  return picture;
}

TEST(Painter, DrawsTheToolAtItsPosition) {
  const render::Camera camera = with_tool({}).camera;
  const glm::dvec3 place = 55.0 * render::profile_direction(camera) + glm::dvec3{0, 70, 0};
  render::Picture picture = with_tool(place);
  const render::Image with = drawn(picture);
  picture.tool.reset();
  const render::Image without = drawn(picture);
  const glm::dvec3 eye = render::eye_mm(camera), way = place - eye;
  const double px = 2.0 * std::tan(0.5 * camera.fov_rad) / kView.height_px;
  const double seen = std::asin(10.0 / glm::length(way));
  for (int y = 0; y < kView.height_px; ++y)
    for (int x = 0; x < kView.width_px; ++x) {
      const double off = std::acos(std::min(
          1.0, glm::dot(ray_through(camera, kView, x + 0.5, y + 0.5), glm::normalize(way))));
      const bool changed =
          !is_near(with.at(x, y), without.at(x, y)[0], without.at(x, y)[1], without.at(x, y)[2], 3);
      if (off < seen - 1.5 * px) {
        ASSERT_TRUE(changed) << x << " " << y;
      }
      if (off > seen + 1.5 * px) {
        ASSERT_FALSE(changed) << x << " " << y;
      }
    }
}

bool is_lit(const std::uint8_t* rgba) { return is_near(rgba, 255, 173, 63, 12); }

TEST(Painter, DrawsAHiddenToolThroughTheClay) {
  render::Picture picture = with_tool({0, 30, 0});  // in the middle of a solid lump
  const render::Image with = drawn(picture);
  picture.tool.reset();
  const render::Image without = drawn(picture);
  const auto differs = [&](double rho) {
    const auto px =
        render::pixel_of(picture.camera, kView,
                         rho * render::profile_direction(picture.camera) + glm::dvec3{0, 30, 0})
            .value();
    const int x = static_cast<int>(px.x), y = static_cast<int>(px.y);
    const std::uint8_t* clay = without.at(x, y);
    return !is_near(with.at(x, y), clay[0], clay[1], clay[2], 4);
  };
  for (const double rho : {-8.0, -4.0, 0.0, 4.0, 8.0}) EXPECT_TRUE(differs(rho)) << rho;
  for (const double rho : {-14.0, 14.0, 20.0}) EXPECT_FALSE(differs(rho)) << rho;
}

TEST(Painter, HighlightsTheTouchingSide) {
  const render::Camera camera = with_tool({}).camera;
  const glm::dvec3 right = render::profile_direction(camera);
  render::Picture picture = with_tool(55.0 * right + glm::dvec3{0, 70, 0});
  picture.tool->contact = true;
  const auto lit_at = [&](double rho) {
    const render::Image image = drawn(picture);
    const auto at = render::pixel_of(camera, kView, rho * right + glm::dvec3{0, 70, 0}).value();
    return is_lit(image.at(static_cast<int>(at.x), static_cast<int>(at.y)));
  };
  EXPECT_TRUE(lit_at(46.5));  // towards the axis
  EXPECT_FALSE(lit_at(63.5));
  picture.tool->inside = true;
  EXPECT_FALSE(lit_at(46.5));
  EXPECT_TRUE(lit_at(63.5));
  picture.tool->contact = false;
  EXPECT_FALSE(lit_at(63.5));
}

TEST(Painter, DrawsTwoToolsForAPinch) {
  const render::Camera camera = with_tool({}).camera;
  const glm::dvec3 right = render::profile_direction(camera);
  render::Picture picture = with_tool(30.0 * right + glm::dvec3{0, 90, 0});
  picture.tool->gap_mm = 6.0;
  const render::Image with = drawn(picture);
  picture.tool.reset();
  const render::Image without = drawn(picture);
  const auto tool_at = [&](double rho) {
    const auto at = render::pixel_of(camera, kView, rho * right + glm::dvec3{0, 90, 0}).value();
    const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
    const auto* was = without.at(x, y);
    return !is_near(with.at(x, y), was[0], was[1], was[2], 3);
  };
  for (const double rho : {8.0, 17.0, 26.0, 34.0, 43.0, 52.0}) EXPECT_TRUE(tool_at(rho)) << rho;
  for (const double rho : {5.5, 28.0, 30.0, 32.0, 54.5}) EXPECT_FALSE(tool_at(rho)) << rho;
}

TEST(Painter, ForceArrowGrowsUpToALimit) {
  const render::Camera camera = with_tool({}).camera;
  const glm::dvec3 right = render::profile_direction(camera);
  render::Picture picture = with_tool(30.0 * right + glm::dvec3{0, 75, 0});
  const render::Image none = drawn(picture);
  const auto reach_mm = [&](double newton) {  // beyond the tool's surface
    picture.tool->force_n = newton * right;
    const render::Image image = drawn(picture);
    double farthest = 0.0;
    for (double rho = 30.0; rho < 130.0; rho += 0.25) {
      const auto at = render::pixel_of(camera, kView, rho * right + glm::dvec3{0, 75, 0}).value();
      const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
      if (x < 0 || x >= kView.width_px) break;
      const auto* was = none.at(x, y);
      if (!is_near(image.at(x, y), was[0], was[1], was[2], 12)) farthest = rho - 40.0;
    }
    return farthest;
  };
  EXPECT_EQ(reach_mm(0.0), 0.0);
  EXPECT_NEAR(reach_mm(1.0), 1.0 * render::kArrowMmPerN, 1.5);
  EXPECT_NEAR(reach_mm(2.0), 2.0 * render::kArrowMmPerN, 1.5);
  picture.tool->force_n = 5.0 * right;
  const render::Image most = drawn(picture);
  picture.tool->force_n = 500.0 * right;
  EXPECT_EQ(drawn(picture), most);
}

TEST(Painter, WheelMarkTurnsCounterclockwise) {
  render::Picture picture = picture_of(pot_of([](double) { return 20.0; }, 20.0), 1.2);
  picture.wheel_radius_mm = 30.0;
  picture.camera.distance_mm *= 1.4;
  for (const double turn : {0.0, 1.0, 2.5, -1.3}) {
    picture.wheel_turn_rad = turn;
    const render::Image image = drawn(picture);
    const auto brightness = [&](double azimuth) {
      const glm::dvec3 at = 0.93 * 30.0 * glm::dvec3{std::sin(azimuth), 0.0, std::cos(azimuth)};
      const auto px = render::pixel_of(picture.camera, kView, at).value();
      return static_cast<int>(image.at(static_cast<int>(px.x), static_cast<int>(px.y))[1]);
    };
    EXPECT_LT(brightness(turn), brightness(turn + 0.4) - 25) << turn;
    EXPECT_LT(brightness(turn), brightness(turn - 0.4) - 25) << turn;
  }
}

TEST(Painter, DrawsAFallenPartAtItsRestingPlace) {
  render::PotView pot = pot_of([](double) { return 30.0; }, 100.0);
  render::FallenView fallen;
  fallen.first_row = 100;
  fallen.place[3] = {0.0, 0.0, 0.0, 1.0};
  fallen.place[3].x = 90.0;  // beside the standing part, at the same height
  pot.fallen = fallen;
  render::Picture picture = picture_of(pot, 0.2);
  picture.camera.azimuth_rad = 0.0;
  const render::Image image = drawn(in_yellow(picture));
  const auto clay_at = [&](double x, double y) {
    const auto px = render::pixel_of(picture.camera, kView, {x, y, 30.0}).value();
    return is_clay(image.at(static_cast<int>(px.x), static_cast<int>(px.y)));
  };
  EXPECT_TRUE(clay_at(0.0, 25.0));
  EXPECT_FALSE(clay_at(0.0, 80.0));
  EXPECT_TRUE(clay_at(90.0, 75.0));
  EXPECT_FALSE(clay_at(90.0, 30.0));
}

TEST(Painter, DrawsAnEmptyWheelAndExtremePots) {
  EXPECT_EQ(drawn({}).rgba.size(), 4u * 480u * 360u);
  for (const double size : {1e-2, 5000.0}) {
    const auto picture =
        picture_of(pot_of([&](double) { return size; }, size, 0.3 * size, 0.1 * size));
    EXPECT_TRUE(is_clay(drawn(in_yellow(picture)).at(240, 200))) << size;
  }
  EXPECT_EQ(drawn(picture_of(pot_of([](double) { return 10.0; }, 20.0)), {1, 1}).rgba.size(), 4u);
}

TEST(Painter, IsDeterministic) {
  const auto picture = picture_of(pot_of([](double p) { return 30.0 + 20.0 * p; }, 80.0, 5.0, 6.0));
  EXPECT_EQ(drawn(picture), drawn(picture));
}

/// All pixels of a canvas.
std::vector<std::uint8_t> pixels_of(const render::Canvas& canvas) {
  std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(canvas.width_px()) *
                                   static_cast<std::size_t>(canvas.height_px()));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas.framebuffer());
  glReadPixels(0, 0, canvas.width_px(), canvas.height_px(), GL_RGBA, GL_UNSIGNED_BYTE,
               pixels.data());
  return pixels;
}

TEST(Painter, RowsInTurnMakeTheWholePicture) {
  render::Picture picture = with_tool({45.0, 20.0, 0.0});
  picture.cut = render::Cut::quarter;
  (void)drawn(picture);  // makes the context current
  auto painter = render::Painter::create().value();
  const int width = kView.width_px, height = kView.height_px;
  for (const int samples : {1, 4}) {
    const auto whole = render::Canvas::create(width, height, 0).value();
    const auto parts = render::Canvas::create(width, height, 0).value();
    glBindFramebuffer(GL_FRAMEBUFFER, whole.framebuffer());
    painter.paint(picture, width, height, samples);
    const auto expected = pixels_of(whole);
    const auto paint_rows = [&](int first, int end) {
      glBindFramebuffer(GL_FRAMEBUFFER, parts.framebuffer());
      painter.paint_rows(picture, width, height, samples, {first, end - first});
    };
    glBindFramebuffer(GL_FRAMEBUFFER, parts.framebuffer());
    glClearColor(1.0f, 0.0f, 1.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    const auto untouched = pixels_of(parts);
    paint_rows(100, 217);
    const auto some = pixels_of(parts);
    const auto begin = untouched.begin(), found = some.begin();
    const auto row = [&](int y) { return std::ptrdiff_t{4} * width * y; };
    EXPECT_TRUE(std::equal(begin, begin + row(100), found));
    EXPECT_TRUE(std::equal(begin + row(217), untouched.end(), found + row(217)));
    paint_rows(0, 100);
    paint_rows(217, height);
    EXPECT_EQ(pixels_of(parts), expected) << samples;
  }
  EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
}

TEST(Painter, StripsMakeTheWholePicture) {
  render::Picture picture = with_tool({45.0, 20.0, 0.0});
  picture.cut = render::Cut::quarter;
  picture.wall_map = render::WallMap{6.0, 10.0};
  picture.pot.wall_mm.assign(picture.pot.rows.size(), {5.0f, 5.0f});
  const render::Viewport large{2000, 1500};  // three million pixels: in two strips
  const render::Image image = drawn(picture, large);
  auto painter = render::Painter::create().value();
  const auto whole = render::Canvas::create(large.width_px, large.height_px, 0).value();
  glBindFramebuffer(GL_FRAMEBUFFER, whole.framebuffer());
  painter.paint(picture, large.width_px, large.height_px, render::kSamples);
  const auto expected = pixels_of(whole);  // lowest row first
  const std::size_t row = 4u * 2000u;
  int different = 0;
  for (std::size_t y = 0; y < 1500; ++y)
    for (std::size_t x = 0; x < row; ++x)
      different += std::abs(image.rgba[y * row + x] - expected[(1499 - y) * row + x]) > 2;
  EXPECT_LT(different, 1000);  // of 12 million: outlines, rounded differently
}

TEST(Painter, WarmsUpWithoutErrors) {
  (void)drawn(with_tool({45.0, 20.0, 0.0}));
  auto painter = render::Painter::create().value();
  int pictures = 1;
  while (painter.warm_up() && pictures < 100) ++pictures;
  EXPECT_LT(pictures, 100);
  EXPECT_FALSE(painter.warm_up());
  EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
}

}  // namespace
}  // namespace clay::test
