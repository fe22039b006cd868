// The look of the window: by geometry, by colour, and against inspected reference pictures.

#include "tests/app/studio/window.hpp"

#include <cstdio>
#include <map>
#include <string>

namespace clay::studio {
namespace {

using test::claystack;
using test::Ran;
using test::read_text;
using test::shell;

/// A pixel, 0 to 255 per channel.
struct Colour {
  int red = 0, green = 0, blue = 0;
  [[nodiscard]] bool clay() const { return red > blue + 30; }
};

class Look : public test::Window {
 protected:
  /// The colour of a pixel as ImageMagick reads it.
  Colour at(const char* picture, int x, int y) {
    std::string& bytes = read_[picture];
    if (bytes.empty()) {
      const std::string raw = folder.file(std::string(picture) + ".rgb");
      EXPECT_EQ(shell("convert " + folder.file(picture) + " -depth 8 rgb:" + raw).status, 0);
      bytes = read_text(raw);
    }
    const auto channel = [&](int which) {
      return static_cast<unsigned char>(
          bytes.at(static_cast<std::size_t>(3 * (y * width_px + x) + which)));
    };
    return {channel(0), channel(1), channel(2)};
  }
  /// Takes a picture with the pointer out of the view.
  static std::string shot(const char* name) {
    return std::string("move 480 5\nwait 0.1\nscreenshot FOLDER/") + name + "\n";
  }
  bool same(const char* a, const char* b) {
    return read_text(folder.file(a)) == read_text(folder.file(b));
  }
  int width_px = 960;  ///< of the pictures

 private:
  std::map<std::string, std::string> read_;
};

TEST_F(Look, DrawsClayAtItsPosition) {
  // Seen from the front: clay on the axis, background above the lump.
  const Ran ran =
      run("key 1\npoint 47 15\nscreenshot FOLDER/in.png\npoint 80 60\nscreenshot FOLDER/out.png\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  // The middle of the view, between the strip of 62 px and the panels of 256 px, is on the axis.
  EXPECT_TRUE(at("out.png", 383, 330).clay());
  EXPECT_LT(at("out.png", 383, 60).red, at("out.png", 383, 60).blue + 10)
      << "background above the lump";
}

TEST_F(Look, WallMapShowsThickClayYellow) {
  // The whole lump is thicker than the range of the map.
  const Ran ran =
      run("key 1\nkey W\nmove 480 30\nwait 0.2\nscreenshot FOLDER/map.png\nkey W\nwait 0.2\n"
          "screenshot FOLDER/clay.png\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const auto green_of_red = [&](const char* picture) {
    const Colour colour = at(picture, 383, 330);
    EXPECT_GT(colour.red, 60);
    return static_cast<double>(colour.green) / colour.red;
  };
  EXPECT_GT(green_of_red("map.png"), 0.8) << "yellow: as much green as red";
  EXPECT_LT(green_of_red("clay.png"), 0.75) << "clay";
}

TEST_F(Look, BothThemesAndScalesAreDrawn) {
  for (const char* theme : {"dark", "light"}) {
    const Ran ran = run("", std::string("--theme ") + theme +
                                " --scale 2 --size 1920x1280 --screenshot " + folder.file("t.png"));
    ASSERT_EQ(ran.status, 0) << ran.err;
    int red = 0, green = 0, blue = 0;
    ASSERT_EQ(std::sscanf(pixel("t.png", 4, 640).c_str(), "%d %d %d", &red, &green, &blue), 3);
    if (std::string(theme) == "dark") {
      EXPECT_LT(red, 80);
    } else {
      EXPECT_GT(red, 200);
    }
  }
}

TEST_F(Look, MouseRotatesPansAndZoomsTheView) {
  const std::string drag = "move 383 300\npress BUTTON\nmove 423 220 over 0.2\nrelease BUTTON\n";
  const auto by = [&](const std::string& button) {
    std::string text = drag;
    for (auto i = text.find("BUTTON"); i != std::string::npos; i = text.find("BUTTON"))
      text.replace(i, 6, button);
    return text;
  };
  const Ran ran =
      run(shot("home.png") + by("middle") + shot("middle.png") + "key Home\n" + by("right") +
          shot("right.png") + "key 1\n" + shot("front.png") + "hold Shift\n" + by("middle") +
          "hold\n" + shot("shifted.png") + "key 1\nmove 383 300\nscroll 4\n" + shot("near.png") +
          "key Num1\n" + shot("again.png"));
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_FALSE(same("home.png", "middle.png"));
  EXPECT_TRUE(same("middle.png", "right.png")) << "either button rotates";
  EXPECT_TRUE(same("front.png", "again.png"));
  // The lump moves with the mouse, 40 px to the right and 80 px up.
  const auto left_edge = [&](const char* picture, int y) {
    for (int x = 66; x < 700; ++x)
      if (at(picture, x, y).clay()) return x;
    return 700;
  };
  const int edge = left_edge("front.png", 330);
  ASSERT_GT(edge, 70);
  EXPECT_NEAR(left_edge("shifted.png", 250), edge + 40, 2);
  EXPECT_LT(left_edge("near.png", 330), edge - 10);
}

TEST_F(Look, TheCardOfALessonStandsBelowThePot) {
  const Ran ran =
      run("do file.learn_vase\nwait 1\n" + shot("card.png"), "--size 960x600 --scale 1.25");
  ASSERT_EQ(ran.status, 0) << ran.err;
  // The axis is at 359; the lump is 84 mm wide and cut open to its foot.
  EXPECT_TRUE(at("card.png", 330, 215).clay()) << "the foot";
  EXPECT_FALSE(at("card.png", 330, 300).clay()) << "the card";
  const Colour wheel = at("card.png", 359, 255), card = at("card.png", 359, 300);
  EXPECT_GT(wheel.red, card.red + 60) << "the wheel is in sight";
}

TEST_F(Look, ALessonHasItsCardInANarrowWindowToo) {
  width_px = 390;
  const Ran ran = run("do file.learn_bowl\nwait 1\n" + shot("card.png"), "--size 390x760");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const auto clay = [&](int from, int to) {
    int rows = 0;
    for (int y = from; y < to; y += 8) rows += at("card.png", 150, y).clay() ? 1 : 0;
    return rows;
  };
  EXPECT_GT(clay(40, 400), 3) << "the pot stands above the card";
  EXPECT_EQ(clay(430, 740), 0);
}

/// Such as a part of the window that has no room.
TEST_F(Look, NothingIsInTheCornerOfANarrowView) {
  width_px = 400;
  const Ran ran = run(shot("bare.png"), "--size 400x300 --scale 1.5 --theme light");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Colour corner = at("bare.png", 30, 43), beside = at("bare.png", 60, 43);
  EXPECT_NEAR(corner.red, beside.red, 8);
  EXPECT_NEAR(corner.blue, beside.blue, 8);
}

TEST_F(Look, ARoundLumpIsRoundFromAbove) {
  const Ran ran = run("key 1\n" + shot("front.png") + "key 7\n" + shot("top.png") + "key 3\n" +
                      shot("side.png"));
  ASSERT_EQ(ran.status, 0) << ran.err;
  const auto extent = [&](const char* picture, int dx, int dy) {
    int px = 0;  // from the middle of the view above the timeline
    for (int x = 383, y = 277; x > 66 && x < 700 && y > 30 && y < 610; x += dx, y += dy, ++px)
      if (!at(picture, x, y).clay()) break;
    return px;
  };
  EXPECT_NEAR(extent("top.png", 4, 0), extent("top.png", 0, 4), 1);
  const int high = extent("front.png", 0, -4) + extent("front.png", 0, 4);
  const double wide_over_high = 2.0 * extent("front.png", 4, 0) / high;
  EXPECT_LT(wide_over_high, 96.0 / 40.0);  // perspective magnifies the nearest edge more
  EXPECT_GT(wide_over_high, 96.0 / 40.0 / 1.6);
  EXPECT_NEAR(extent("side.png", 4, 0), extent("front.png", 4, 0), 1);
}

TEST_F(Look, MatchesTheReferencePictures) {
  ASSERT_EQ(shell("sh " CLAYSTACK_STUDIO_TESTS "/references.sh " CLAYSTACK_PROGRAM " " +
                  folder.path().string())
                .status,
            0);
  for (const char* name : {"throw", "walls", "top", "front", "fallen"}) {
    // Edges differ between drivers; a tool covers about 300 pixels.
    const Ran differ =
        shell(std::string("compare -metric AE -fuzz 7% " CLAYSTACK_STUDIO_TESTS "/references/") +
              name + ".png " + folder.file(std::string(name) + ".png") + " null:");
    ASSERT_LE(differ.status, 1) << name << ": " << differ.err;
    EXPECT_LT(std::stod(differ.err), 150.0) << name
                                            << ": of 158 400 pixels; references.sh "
                                               "renews the pictures";
  }
}

}  // namespace
}  // namespace clay::studio
