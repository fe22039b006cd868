#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

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
  EXPECT_DOUBLE_EQ(map.at("limit_mm").get<double>(), 5.5);
  const Ran checked = claystack("check --json --min-wall 5.5 " + vase());
  EXPECT_EQ(checked.status, 1);
  EXPECT_NEAR(map.at("thinnest_mm").get<double>(), checked.json().at("min_wall_mm").get<double>(),
              1e-9);
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
        vase() + out + " --theme blue", vase() + out + " --elevation 90",
        vase() + " --turntable x.png", vase() + out + " --process brick",
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
