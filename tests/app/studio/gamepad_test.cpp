// Gamepads and pens: the strength of a press, and the gamepad as a hand. Through the window's own
// input, by scripts.

#include "app/studio/gamepad.hpp"

#include "app/studio/commands.hpp"
#include "app/studio/gamepad_hand.hpp"
#include "app/studio/settings.hpp"
#include "tests/app/studio/window.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace clay::studio {
namespace {

using test::Ran;
using test::Window;

constexpr const char* kPad = "key 1\ngamepad \"Test pad\"\nexpect gamepad \"Test pad\"\n";

std::string near(const std::string& fact, double value, double tolerance) {
  return fmt::format("expect {0} above {1}\nexpect {0} below {2}\n", fact, value - tolerance,
                     value + tolerance);
}

TEST(Strength, GoesFromTheSoftestBiteToTheFirmest) {
  EXPECT_DOUBLE_EQ(bite_at(0.0), kSoftestBiteMm);
  EXPECT_DOUBLE_EQ(bite_at(1.0), kFirmestBiteMm);
  EXPECT_NEAR(bite_at(0.5), std::sqrt(kSoftestBiteMm * kFirmestBiteMm), 1e-12);
  EXPECT_DOUBLE_EQ(bite_at(7.0), kFirmestBiteMm);
}

TEST(Gamepad, EveryButtonHasACommand) {
  for (const PadBinding& binding : pad_bindings()) {
    EXPECT_NE(find_command(binding.command), nullptr) << binding.name;
    EXPECT_EQ(pad_button_of(binding.name), binding.button);
  }
  EXPECT_FALSE(pad_button_of("turbo"));
}

/// A press of 0.5 s at the lump, 12 mm into it, by a pen of this pressure.
std::string pen(const std::string& pressure) {
  return "key 1\npoint 65 18\npressure " + pressure + "\npress left\npoint 36 18\nwait 0.5\n";
}

TEST_F(Window, AFirmPenPressesDeeperThanASoftOne) {
  const Ran soft = run(pen("0.2") + near("strength", 0.2, 1e-6) + "expect tool_rho_mm above 50\n");
  EXPECT_EQ(soft.status, 0) << soft.err;
  const Ran firm = run(pen("0.9") + near("strength", 0.9, 1e-6) + "expect tool_rho_mm below 50\n");
  EXPECT_EQ(firm.status, 0) << firm.err;
  const Ran rising =
      run(pen("0.2") + "pressure 0.9\nwait 0.5\n" + near("strength", 0.9, 1e-6) +
          "expect tool_rho_mm below 50\npressure none\nexpect strength none\nrelease left\n");
  EXPECT_EQ(rising.status, 0) << rising.err;
}

TEST_F(Window, TheStickMovesTheToolAtItsSpeed) {
  // Beside the lump of 48 mm; half a second at full deflection.
  const double way_mm = 0.5 * kStickMmPerS;
  const Ran ran = run(std::string(kPad) + "scroll -3\nmove 480 300\npoint 65 10\nwait 0.1\n" +
                      "stick left 0 1\nwait 0.4833\nstick left 0 0\n" +
                      near("tool_rho_mm", 65.0, 0.5) + near("tool_y_mm", 10.0 + way_mm, 4.0));
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, AStickInItsDeadZoneDoesNothing) {
  const Ran ran = run(std::string(kPad) +
                      "point 65 10\nstick left 0.1 0.1\nstick right 0.1 0\n"
                      "wait 1\n" +
                      near("tool_rho_mm", 65.0, 1e-3) + near("azimuth_deg", 0.0, 1e-6));
  EXPECT_EQ(ran.status, 0) << ran.err;
}

/// A tool of 10 mm beside a lump of 48 mm.
TEST_F(Window, TheToolOfAGamepadStopsAtTheClay) {
  const Ran ran = run(std::string(kPad) +
                      "point 70 18\nstick left -1 0\nwait 1\n"
                      "expect throwing no\n" +
                      near("tool_rho_mm", 58.25, 0.5));
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, TheRightTriggerBeginsAndEndsAStroke) {
  const Ran ran =
      run(std::string(kPad) +
          "point 60 18\ntrigger right 0.08\nexpect throwing no\ntrigger right 0.5\n"
          "expect throwing yes\n" +
          near("strength", (0.5 - kPressUntil) / (1.0 - kPressUntil), 1e-9) +
          "stick left -1 0\nwait 1\nexpect contact yes\n" +
          // The target is not far ahead of the tool, even if the stick is held for long.
          "expect pull_mm below 18\nexpect pull_mm above 8\n"
          "trigger right 0.07\nexpect throwing yes\ntrigger right 0.04\nexpect throwing no\n"
          "expect strokes 1\nstick left 0 0\n"
          // Released by Esc, the trigger has to be released before it presses again.
          "trigger right 1\nexpect throwing yes\npad B\nexpect throwing no\nwait 0.2\n"
          "expect throwing no\ntrigger right 0\ntrigger right 1\nexpect throwing yes\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, AGamepadThatIsUnpluggedEndsItsStroke) {
  const Ran ran = run(std::string(kPad) +
                      "point 60 18\ntrigger right 1\nstick left -1 0\nwait 0.5\n"
                      "expect contact yes\ngamepad none\nexpect throwing no\nexpect strokes 1\n"
                      "expect gamepad none\nwait 0.5\nexpect throwing no\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

/// The upright wall of the sample cylinder, without the rules that would move it back.
TEST_F(Window, TheLeftTriggerPinchesAndClosesTheFingers) {
  const Ran thrown =
      test::claystack("throw -q " + test::sample("cylinder.scene.json") + " -s " +
                      test::sample("cylinder.session") + " -o " + folder.file("cylinder.pot.json"));
  ASSERT_EQ(thrown.status, 0) << thrown.err;
  const std::string pinched =
      std::string(kPad) +
      "open FOLDER/cylinder.pot.json\ndo tool.press\npoint 80 30\ntrigger left 0.05\n" +
      "trigger left 0.2\ntrigger right 0.5\nexpect throwing yes\nwait 1\n"
      "expect gap_mm above 0\n";
  const Ran open = run(pinched + "save FOLDER/a.work\n");
  ASSERT_EQ(open.status, 0) << open.err;
  // Further on, the left trigger closes the gap of 5 mm, which the pot remembers; the gap opens
  // again when the trigger is released.
  const Ran closed = run(pinched + "trigger left 1\nwait 1\n" + near("gap_mm", 5.0, 0.02) +
                         "trigger left 0.5\nwait 1\nexpect gap_mm above 5.05\n"
                         "trigger right 0\nexpect throwing no\n");
  EXPECT_EQ(closed.status, 0) << closed.err;
}

TEST_F(Window, ButtonsRunTheirCommands) {
  const Ran ran = run(std::string(test::kPress) + kPad +
                          "pad LB\nexpect can_undo no\npad RB\nexpect can_undo yes\n"
                          "pad Right\npad Right\npad Left\npad Up\npad Start\nexpect paused yes\n"
                          "pad Start\nexpect paused no\npad X\npad Y\npad R3\npad L3\n",
                      "--size 960x640 --log");
  ASSERT_EQ(ran.status, 0) << ran.err;
  for (const char* id : {"edit.undo", "edit.redo", "tool.trim", "tool.pinch", "tool.larger",
                         "wheel.pause", "view.cut_half", "view.home", "view.nearer"})
    EXPECT_NE(ran.out.find(std::string("action: ") + id), std::string::npos) << id << ran.out;
}

/// From the lump to the export dialog and out of it.
TEST_F(Window, AGamepadWalksMenusAndDialogs) {
  const Ran ran =
      run(std::string(kPad) +
              "pad Back\npad Right\npad Left\npad Up\npad Up\npad Up\npad Up\npad Up\npad A\n"
              "expect overlay export\ntrigger right 1\nstick left 1 0\nwait 0.2\n"
              "expect throwing no\npad B\nexpect overlay none\n",
          "--size 960x640 --log");
  EXPECT_EQ(ran.status, 0) << ran.err << ran.out;
  EXPECT_EQ(ran.out.find("action: edit.undo"), std::string::npos);
}

TEST_F(Window, TheRightStickTurnsTheViewAndR3Zooms) {
  const double turn_deg = 0.5 * kStickRadPerS * 180.0 / 3.14159265358979;
  const Ran ran = run(std::string(kPad) + "stick right 1 0\nwait 0.4833\nstick right 0 0\n" +
                      near("azimuth_deg", -turn_deg, 3.0));
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, TheMouseTakesThePointerBack) {
  const Ran ran = run(std::string(kPad) +
                      "point 70 18\nstick left 0 1\nwait 0.2\nstick left 0 0\n"
                      "expect tool_y_mm above 25\npoint 66 12\n" +
                      near("tool_rho_mm", 66.0, 0.01) + near("tool_y_mm", 12.0, 0.01));
  EXPECT_EQ(ran.status, 0) << ran.err;
}

}  // namespace
}  // namespace clay::studio
