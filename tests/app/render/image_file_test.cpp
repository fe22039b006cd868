#include "app/render/image_file.hpp"

#include "tests/app/render/drawn.hpp"
#include "tests/support/run_program.hpp"

#include <cstdlib>
#include <fstream>
#include <new>
#ifdef __linux__
#include <sys/resource.h>
#endif

namespace clay::test {
namespace {

render::Image turned(double azimuth) {
  render::Picture picture =
      picture_of(pot_of([](double p) { return 30.0 + 20.0 * p; }, 80.0, 5.0, 6.0));
  picture.camera.azimuth_rad = azimuth;
  picture.cut = render::Cut::quarter;
  picture.cut_azimuth_rad = 0.7;
  return drawn(picture);
}

/// Decoded by ImageMagick.
std::vector<std::uint8_t> decoded(const std::string& path, const std::string& folder) {
  const Ran run = shell("convert " + path + " -depth 8 rgba:" + folder);
  EXPECT_EQ(run.status, 0) << run.err;
  const std::string text = read_text(folder);
  return {text.begin(), text.end()};
}

render::FrameSource shown(const std::vector<render::Image>& frames) {
  return [&frames](std::size_t index) -> Result<render::Image> { return frames.at(index); };
}

render::ByteSink into(std::string& bytes) {
  return [&bytes](std::string_view more) -> Result<void> {
    bytes += more;
    return {};
  };
}

TEST(ImageFile, PngStoresEveryPixel) {
  const ScratchFolder folder;
  const render::Image image = turned(0.7);
  write_text(folder.file("p.png"), render::png_of(image));
  EXPECT_EQ(decoded(folder.file("p.png"), folder.file("raw")), image.rgba);
}

TEST(ImageFile, GifLoopsItsFrames) {
  const ScratchFolder folder;
  const std::vector<render::Image> frames{turned(0.7), turned(1.7), turned(2.7)};
  std::string bytes;
  const auto written = render::write_gif(frames.size(), 80, shown(frames), into(bytes));
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_EQ(*written, bytes.size());
  EXPECT_NE(bytes.find("NETSCAPE2.0"), std::string::npos);
  write_text(folder.file("a.gif"), bytes);
  const Ran output = shell("identify -format \"%w %h %T,\" " + folder.file("a.gif"));
  EXPECT_EQ(output.out, "480 360 8,480 360 8,480 360 8,") << output.err;
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

TEST(ImageFile, GifDrawsFewFramesTwice) {
  const render::Image image{2, 2, std::vector<std::uint8_t>(16, 90)};
  for (const std::size_t frames : {std::size_t{1}, std::size_t{5}, std::size_t{100}}) {
    std::vector<std::size_t> requested;
    std::string bytes;
    const auto frame_at = [&](std::size_t index) -> Result<render::Image> {
      requested.push_back(index);
      return image;
    };
    ASSERT_TRUE(render::write_gif(frames, 80, frame_at, into(bytes)));
    const std::size_t first = std::min(frames, std::size_t{8});
    ASSERT_EQ(requested.size(), frames + first);
    EXPECT_EQ(first, render::palette_frames(frames));
    EXPECT_GE(requested[first - 1], frames - frames / 8 - 1) << "the palette spans the turn";
    for (std::size_t k = 0; k < frames; ++k) EXPECT_EQ(requested[first + k], k);
  }
}

// A sanitizer ends the process when memory is missing.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// Whether the picture is lost when the process may allocate only this much more.
bool png_is_lost(const render::Image& image, std::uint64_t room) {
  std::uint64_t used_kb = 0;
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmData:") status >> used_kb;
  const rlimit limit{1024 * used_kb + room, RLIM_INFINITY};
  ::setrlimit(RLIMIT_DATA, &limit);
  try {
    return render::png_of(image).empty();
  } catch (const std::bad_alloc&) {
    return false;
  }
}

TEST(ImageFile, PngWithoutMemoryIsAnError) {
  // Room for the filtered rows, of 16 MB, but not for the compressed ones too.
  const render::Image image{2000, 2000, std::vector<std::uint8_t>(16'000'000, 90)};
  EXPECT_EXIT(std::_Exit(png_is_lost(image, 20'000'000) ? 1 : 0), ::testing::ExitedWithCode(0), "");
}
#endif

TEST(ImageFile, GifStopsAtTheFirstError) {
  const std::vector<render::Image> frames{turned(0.7)};
  std::string bytes;
  const auto unread = render::write_gif(
      2, 80,
      [&](std::size_t index) -> Result<render::Image> {
        if (index == 1) return failure(ErrorKind::device, "the driver is gone");
        return frames[index];
      },
      into(bytes));
  ASSERT_FALSE(unread);
  EXPECT_EQ(unread.error().message, "the driver is gone");
  int writes = 0;
  const auto unwritten =
      render::write_gif(1, 80, shown(frames), [&](std::string_view) -> Result<void> {
        ++writes;
        return failure(ErrorKind::io, "the disk is full");
      });
  ASSERT_FALSE(unwritten);
  EXPECT_EQ(unwritten.error().message, "the disk is full");
  EXPECT_EQ(writes, 1);
}

}  // namespace
}  // namespace clay::test
