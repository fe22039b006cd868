#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace clay::test {
namespace {

/// One thrown pot for all tests of this file.
const std::string& vase() {
  static const ScratchFolder folder;
  static const std::string path = [] {
    const std::string file = folder.file("vase.pot.json");
    const Ran run = claystack("throw -q " + sample("vase.scene.json") + " -o " + file);
    EXPECT_EQ(run.status, 0) << run.err;
    return file;
  }();
  return path;
}

TEST(Render, WritesAPictureOfTheRequestedSize) {
  const ScratchFolder folder;
  const Ran run =
      claystack("render --json " + vase() + " --size 320x200 -o " + folder.file("v.png"));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.json().at("png").at("bytes"), std::filesystem::file_size(folder.file("v.png")));
  EXPECT_EQ(shell("identify -format \"%m %w %h\" " + folder.file("v.png")).out, "PNG 320 200");
}

TEST(Render, TurntableHasTheRequestedFrames) {
  const ScratchFolder folder;
  const Ran run = claystack("render -q " + vase() + " --size 120x90 --frames 5 --section --theme " +
                            "dark --turntable " + folder.file("v.gif"));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(shell("identify -format \"%m \" " + folder.file("v.gif")).out, "GIF GIF GIF GIF GIF ");
}

/// Its frames are many, and a graphics card may be missing.
TEST(Render, TurntableIsSmallerThanAPictureByDefault) {
  const ScratchFolder folder;
  const std::string png = folder.file("v.png"), gif = folder.file("v.gif");
  const Ran run =
      claystack("render --json " + vase() + " --frames 2 --turntable " + gif + " -o " + png);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.json().at("width_px"), 1280);
  EXPECT_EQ(run.json().at("gif").at("width_px"), 640);
  EXPECT_EQ(shell("identify -format \"%w %h\" " + png).out, "1280 720");
  EXPECT_EQ(shell("identify -format \"%w %h \" " + gif).out, "640 360 640 360 ");
  const Ran alone = claystack("render --json " + vase() + " --frames 1 --turntable " + gif);
  EXPECT_EQ(alone.json().at("width_px"), 640);
}

// A sanitizer keeps memory that was freed.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// The peak memory of a turntable [KiB].
long peak_kib_of(int frames) {
  const ScratchFolder folder;
  const std::string gif = folder.file("v.gif"), count = std::to_string(frames), pot = vase();
  const pid_t child = fork();
  if (child == 0) {
    execl(CLAYSTACK_PROGRAM, CLAYSTACK_PROGRAM, "render", "-q", pot.c_str(), "--size", "640x480",
          "--frames", count.c_str(), "--turntable", gif.c_str(), nullptr);
    _exit(127);
  }
  int status = -1;
  rusage usage{};
  EXPECT_EQ(wait4(child, &status, 0, &usage), child);
  EXPECT_EQ(status, 0);
  return usage.ru_maxrss;
}

/// 64 more frames of 1200 KiB each.
TEST(Render, TurntableMemoryIsIndependentOfFrames) {
  EXPECT_LT(peak_kib_of(72) - peak_kib_of(8), 16 * 1200);
}
#endif

TEST(Render, ShowsTheLumpOfAScene) {
  const ScratchFolder folder;
  EXPECT_EQ(claystack("render " + sample("vase.scene.json") + " --size 64x64 -o " +
                      folder.file("lump.png"))
                .status,
            0);
  EXPECT_TRUE(std::filesystem::exists(folder.file("lump.png")));
}

TEST(Render, PrintsTheMappedWalls) {
  const ScratchFolder folder;
  const Ran run = claystack("render --json " + vase() + " --size 64x64 --min-wall 5.5 -o " +
                            folder.file("v.png"));
  ASSERT_EQ(run.status, 0) << run.err;
  const auto map = run.json().at("wall_map");
  EXPECT_DOUBLE_EQ(map.at("limit_mm").get<double>(), 5.5 * 0.999);
  const Ran checked = claystack("check --json --min-wall 5.5 " + vase());
  EXPECT_EQ(checked.status, 1);
  EXPECT_NEAR(map.at("thinnest_mm").get<double>(), checked.json().at("min_wall_mm").get<double>(),
              1e-9);
}

/// Mean colour of a box of a picture, as "R G B" from 0 to 255.
std::array<int, 3> mean_colour(const std::string& file, const std::string& box) {
  const Ran ran = shell("convert " + file + " -crop " + box +
                        " -alpha off -scale 1x1! -depth 8 -format "
                        "\"%[fx:round(255*r)] %[fx:round(255*g)] %[fx:round(255*b)]\" info:");
  std::array<int, 3> colour{};
  EXPECT_EQ(std::sscanf(ran.out.c_str(), "%d %d %d", &colour[0], &colour[1], &colour[2]), 3);
  return colour;
}

TEST(Render, ShowsTheColourOfTheMaterial) {
  const ScratchFolder folder;
  std::map<std::string, std::array<int, 3>> seen;
  for (const char* id : {"leather-hard", "wet", "porcelain", "celadon", "tenmoku"}) {
    const std::string file = folder.file(std::string(id) + ".png");
    const Ran run =
        claystack("render --json " + vase() + " --size 200x200 --material " + id + " -o " + file);
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.json().at("material"), id);
    seen[id] = mean_colour(file, "20x30+90+110");
  }
  EXPECT_GT(seen["leather-hard"][0], seen["leather-hard"][2] + 40) << "red clay";
  EXPECT_LT(seen["wet"][0], seen["leather-hard"][0]) << "wet clay is darker";
  EXPECT_LT(std::abs(seen["porcelain"][0] - seen["porcelain"][2]), 30) << "white";
  EXPECT_GT(seen["porcelain"][2], seen["leather-hard"][2] + 60);
  EXPECT_GT(seen["celadon"][1], seen["celadon"][0] + 10) << "green";
  EXPECT_LT(seen["tenmoku"][0], 100) << "black";
}

/// The brightest pixel, 0 to 255.
int brightest(const std::string& file, const std::string& box) {
  return std::stoi(shell("convert " + file + " -crop " + box +
                         " -colorspace gray -format \"%[fx:round(255*maxima)]\" info:")
                       .out);
}

TEST(Render, GlazesMirrorTheWindow) {
  const ScratchFolder folder;
  for (const char* id : {"tenmoku", "terracotta"})
    ASSERT_EQ(claystack("render -q " + vase() + " --size 200x200 --material " + id + " -o " +
                        folder.file(std::string(id) + ".png"))
                  .status,
              0);
  const std::string box = "40x60+80+80";  // on the body
  const std::array<int, 3> glaze = mean_colour(folder.file("tenmoku.png"), box);
  EXPECT_GT(brightest(folder.file("tenmoku.png"), box), glaze[0] + 80);
  const std::array<int, 3> matte = mean_colour(folder.file("terracotta.png"), box);
  EXPECT_LT(brightest(folder.file("terracotta.png"), box), matte[0] + 80);
}

TEST(Render, TransparentPicturesShowThePotAlone) {
  const ScratchFolder folder;
  const std::string file = folder.file("v.png");
  ASSERT_EQ(claystack("render -q " + vase() + " --size 200x200 --transparent -o " + file).status,
            0);
  const auto alpha = [&](const char* where) {
    return shell("convert " + file + " -format \"%[fx:round(255*" + where + ".a)]\" info:").out;
  };
  EXPECT_EQ(alpha("p{100,110}"), "255") << "the pot";
  for (const char* corner : {"p{2,2}", "p{197,2}", "p{2,197}", "p{150,180}"})
    EXPECT_EQ(alpha(corner), "0") << corner;
  // Partly covered pixels keep the colour of the clay: no dark outline. Half-covered pixels over
  // black would be darker than the darkest of the pot.
  const auto darkest = [&](const char* range) {
    return std::stoi(shell("convert " + file + " -channel A -threshold " + range +
                           " +channel -background white -alpha background -flatten -colorspace "
                           "gray -format \"%[fx:round(255*minima)]\" info:")
                         .out);
  };
  EXPECT_GT(darkest("5%"), darkest("99%") - 12);
  EXPECT_EQ(
      claystack("render " + vase() + " --transparent --turntable " + folder.file("v.gif")).status,
      2);
}

TEST(Render, WritesToStandardOutputForADash) {
  const Ran run = claystack("render " + vase() + " --size 32x32 -o -");
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out.rfind("\x89PNG", 0), 0u);
  EXPECT_EQ(claystack("render --json " + vase() + " -o -").status, 2);
}

TEST(Render, PrintsTheTimePerFrame) {
  const Ran run = claystack("render --json --time --size 64x64 " + vase());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_GT(run.json().at("frame").at("ms").get<double>(), 0.0);
}

TEST(Render, ReturnsTwoForBadUsage) {
  const ScratchFolder folder;
  const std::string out = " -o " + folder.file("x.png");
  for (const std::string& arguments :
       {vase(), vase() + " -o x.jpg", vase() + out + " --size 0x10", vase() + out + " --size 10",
        vase() + out + " --size 10x10x", vase() + out + " --size 9000x10",
        vase() + out + " --theme blue", vase() + out + " --material brick",
        vase() + out + " --elevation 90", vase() + " --turntable x.png",
        vase() + out + " --process brick", vase() + out + " --frames 3",
        sample("vase.session") + out})
    EXPECT_EQ(claystack("render " + arguments).status, 2) << arguments;
  EXPECT_FALSE(std::filesystem::exists(folder.file("x.png")));
}

TEST(Render, ReturnsThreeForUnreadableOrUnwritableFiles) {
  const ScratchFolder folder;
  EXPECT_EQ(claystack("render nowhere.pot.json --size 32x32 -o " + folder.file("x.png")).status, 3);
  EXPECT_EQ(claystack("render " + vase() + " --size 32x32 -o " + folder.file("no/x.png")).status,
            3);
}

TEST(Render, ReturnsFourWithoutAGraphicsDriver) {
  const ScratchFolder folder;
  const Ran run = shell("__EGL_VENDOR_LIBRARY_DIRS=" + folder.file("none") + " " +
                        CLAYSTACK_PROGRAM + " render " + vase() + " -o " + folder.file("x.png"));
  EXPECT_EQ(run.status, 4) << run.err;
  EXPECT_NE(run.err.find("libgl1-mesa-dri"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("x.png")));
}

}  // namespace
}  // namespace clay::test
