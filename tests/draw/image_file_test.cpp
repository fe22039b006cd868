#include "draw/image_file.hpp"

#include "drawn.hpp"
#include "run_program.hpp"

#include <cstdlib>

namespace clay::test {
namespace {

draw::Image turned(double azimuth) {
  draw::Picture picture =
      picture_of(pot_of([](double p) { return 30.0 + 20.0 * p; }, 80.0, 5.0, 6.0));
  picture.camera.azimuth_rad = azimuth;
  picture.cut = draw::Cut::quarter;
  picture.cut_azimuth_rad = 0.7;
  return drawn(picture);
}

/// As ImageMagick reads it.
std::vector<std::uint8_t> decoded(const std::string& path, const std::string& folder) {
  const Ran run = shell("convert " + path + " -depth 8 rgba:" + folder);
  EXPECT_EQ(run.status, 0) << run.err;
  const std::string text = read_text(folder);
  return {text.begin(), text.end()};
}

TEST(ImageFile, PngHoldsEveryPixel) {
  const ScratchFolder folder;
  const draw::Image image = turned(0.7);
  write_text(folder.file("p.png"), draw::png_of(image));
  EXPECT_EQ(decoded(folder.file("p.png"), folder.file("raw")), image.rgba);
}

TEST(ImageFile, GifPlaysItsFramesForEver) {
  const ScratchFolder folder;
  const std::vector<draw::Image> frames{turned(0.7), turned(1.7), turned(2.7)};
  const auto bytes = draw::gif_of(frames, 80);
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_NE(bytes->find("NETSCAPE2.0"), std::string::npos);
  write_text(folder.file("a.gif"), *bytes);
  const Ran told = shell("identify -format \"%w %h %T,\" " + folder.file("a.gif"));
  EXPECT_EQ(told.out, "480 360 8,480 360 8,480 360 8,") << told.err;
  const auto pixels = decoded(folder.file("a.gif"), folder.file("raw"));
  const std::size_t each = frames.front().rgba.size();
  ASSERT_EQ(pixels.size(), 3 * each);
  for (std::size_t k = 0; k < 3; ++k) {
    double off = 0.0, other = 0.0;
    for (std::size_t i = 0; i < each; ++i) {
      off += std::abs(pixels[k * each + i] - frames[k].rgba[i]);
      other += std::abs(pixels[k * each + i] - frames[(k + 1) % 3].rgba[i]);
    }
    EXPECT_LT(off / static_cast<double>(each), 3.0) << k;  // of 255: the palette's steps
    EXPECT_GT(other, 1.5 * off) << k;
  }
}

}  // namespace
}  // namespace clay::test
