// `claystack studio SCENE --servo-report SECONDS`. The figures depend on the machine. Tested are
// that they exist and that they decide the exit status.

#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clay::studio {
namespace {

using test::claystack;
using test::Ran;

TEST(ServoReport, ReportsTimingsAndSetsTheExitStatus) {
  ASSERT_EQ(test::shell("command -v Xvfb").status, 0) << "needs Xvfb (tests/run.sh installs it)";
  const test::ScratchFolder folder;
  Ran ran;
  nlohmann::json report;
  // A loaded machine may take seconds to draw a frame.
  for (const char* seconds : {"3", "60"}) {
    ran = test::shell(
        "sh " CLAYSTACK_STUDIO_TESTS "/servo_report_under_xvfb.sh " CLAYSTACK_PROGRAM " " +
        folder.path().string() + " " + test::sample("bowl.scene.json") + " " + seconds);
    ASSERT_TRUE(ran.status == 0 || ran.status == 1) << ran.err;
    report = ran.json();
    if (report.at("window").at("frames") > 2) break;
  }
  const auto& servo = report.at("servo");
  const auto& window = report.at("window");
  EXPECT_GT(servo.at("ticks"), 0);
  EXPECT_LE(servo.at("lateness_us").at("p50"), servo.at("lateness_us").at("p99"));
  EXPECT_LE(servo.at("lateness_us").at("p99"), servo.at("lateness_us").at("max"));
  EXPECT_GT(window.at("frames"), 2);
  // The frame times fit into the measured time.
  const double fps = window.at("fps");
  EXPECT_GT(fps, 0.0);
  EXPECT_LT(fps, 61.0);
  EXPECT_LT(fps * 1e-3 * window.at("frame_ms").at("p50").get<double>(), 2.0);
  const bool kept = servo.at("realtime").at("fifo").get<bool>() && fps >= 30.0 &&
                    servo.at("lateness_us").at("p99").get<double>() <= 100.0;
  EXPECT_EQ(ran.status, kept ? 0 : 1) << ran.err << report;
  EXPECT_EQ(ran.err.find("servo report: expected ") != std::string::npos, !kept) << ran.err;
}

TEST(ServoReport, RefusesUnsupportedMeasurements) {
  Ran ran = claystack("studio --servo-report 3");
  EXPECT_EQ(ran.status, 2);
  EXPECT_NE(ran.err.find("expected a scene"), std::string::npos) << ran.err;
  EXPECT_EQ(claystack("studio --servo-report 3 --screenshot x.png").status, 2);
  EXPECT_EQ(claystack("studio --servo-report 0").status, 2);
  EXPECT_EQ(claystack("studio --json").status, 2);
}

}  // namespace
}  // namespace clay::studio
