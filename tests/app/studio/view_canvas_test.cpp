// The canvas of the view: its resolution, and a picture at rest that takes several frames.

#include "app/studio/view_canvas.hpp"
#include "tests/app/render/drawn.hpp"

#include <cstdint>
#include <vector>

namespace clay::studio {
namespace {

using test::kView;

TEST(Quality, DividesASlowPictureIntoPartsOf40Ms) {
  Quality quality;
  EXPECT_EQ(quality.frames(1e9), 1);  // nothing is known yet
  quality.took(0.1, 1e6);
  EXPECT_EQ(quality.frames(1e5), 1);
  EXPECT_EQ(quality.frames(2e6), 5);
  EXPECT_EQ(quality.frames(1e9), 12);
  quality.took(0.004, 4e6);  // a graphics card
  EXPECT_EQ(quality.frames(4e6), 1);
}

/// At the lowest resolution a frame has a ninth of the pixels, at the highest four samples for
/// each.
TEST(Quality, BeginsCoarseAndThenFollowsTheMachine) {
  const auto after = [](double coarse_s) {
    Quality quality;
    EXPECT_EQ(quality.fineness(true), (Fineness{1, 3})) << "quick on any machine";
    EXPECT_EQ(quality.fineness(false), (Fineness{4, 1})) << "at rest";
    quality.took(0.3, 1e5);
    EXPECT_EQ(quality.fineness(true), (Fineness{1, 3})) << "a driver compiles in the first frame";
    quality.took(coarse_s, 1e5);
    return quality.fineness(true);
  };
  EXPECT_EQ(after(0.0009), (Fineness{4, 1})) << "32 ms";
  EXPECT_EQ(after(0.001), (Fineness{1, 1})) << "36 ms with four samples";
  EXPECT_EQ(after(0.004), (Fineness{1, 2}));
  EXPECT_EQ(after(0.1), (Fineness{1, 3}));
}

/// The contents of a window: the canvas, copied to a framebuffer.
std::vector<std::uint8_t> shown(const ViewCanvas& canvas) {
  const auto window = render::Canvas::create(kView.width_px, kView.height_px, 0).value();
  canvas.copy_to(window.framebuffer(), {0, 0});
  std::vector<std::uint8_t> pixels(std::size_t{4} * kView.width_px * kView.height_px);
  glReadPixels(0, 0, kView.width_px, kView.height_px, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
  return pixels;
}

render::Picture picture_of(double radius_mm) {
  return test::picture_of(test::pot_of([=](double) { return radius_mm; }, 60.0, 8.0, 10.0));
}

TEST(ViewCanvas, ShowsTheCoarsePictureUntilAllRowsAreDrawn) {
  (void)test::drawn(picture_of(40.0));  // makes its context current
  auto whole = ViewCanvas::create().value();
  ASSERT_TRUE(whole.show(picture_of(40.0), kView, 0.0, false));
  ASSERT_TRUE(whole.draw().value());
  EXPECT_FALSE(whole.unfinished());
  const auto expected = shown(whole);

  auto canvas = ViewCanvas::create().value();
  for (int frame = 0; frame < 3; ++frame) {  // it changes, and each frame is slow
    ASSERT_TRUE(canvas.show(picture_of(30.0 + frame), kView, 0.01 * frame, true));
    ASSERT_TRUE(canvas.draw().value());
    ASSERT_TRUE(canvas.changing());
    canvas.took(0.5);
  }
  ASSERT_TRUE(canvas.show(picture_of(40.0), kView, 0.1, true));
  ASSERT_TRUE(canvas.draw().value());
  const auto coarse = shown(canvas);
  EXPECT_NE(coarse, expected);
  int frames = 0;
  for (double now_s = 1.0; canvas.show(picture_of(40.0), kView, now_s, true) && frames < 100;
       now_s += 0.05, ++frames) {
    EXPECT_EQ(shown(canvas), coarse) << frames;
    EXPECT_TRUE(canvas.unfinished());
    EXPECT_TRUE(canvas.draw().value());
  }
  EXPECT_EQ(frames, 12);
  EXPECT_FALSE(canvas.unfinished());
  EXPECT_EQ(shown(canvas), expected);
}

TEST(ViewCanvas, BeginsAnewWhenThePictureChangesBetweenItsParts) {
  (void)test::drawn(picture_of(40.0));
  auto canvas = ViewCanvas::create().value();
  const auto draw_at = [&](double radius_mm, double now_s) {
    return canvas.show(picture_of(radius_mm), kView, now_s, true) && canvas.draw().value();
  };
  for (int frame = 0; frame < 3; ++frame) {
    ASSERT_TRUE(draw_at(30.0 + frame, 0.01 * frame));
    canvas.took(0.5);
  }
  ASSERT_TRUE(draw_at(32.0, 1.0));
  ASSERT_TRUE(draw_at(32.0, 1.05));  // two parts
  ASSERT_TRUE(draw_at(40.0, 1.1));
  double now_s = 2.0;
  while (draw_at(40.0, now_s) && now_s < 10.0) now_s += 0.05;
  auto whole = ViewCanvas::create().value();
  ASSERT_TRUE(whole.show(picture_of(40.0), kView, 0.0, false) && whole.draw().value());
  EXPECT_EQ(shown(canvas), shown(whole));
}

}  // namespace
}  // namespace clay::studio
