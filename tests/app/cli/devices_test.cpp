#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

namespace clay::test {
namespace {

// The devices of the test machine are unknown; the rigs emulate connected devices.
TEST(Devices, ListsConnectedDevices) {
  const auto run = claystack("devices --json");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(run.json().at("devices").is_array());
}

TEST(Devices, ReturnsFourForAMissingDevice) {
  const auto run = claystack("devices usb:250-7");
  EXPECT_EQ(run.status, 4);
  EXPECT_NE(run.err.find("usb:250-7: no such device"), std::string::npos) << run.err;
}

TEST(Devices, PrintsFaultAndRemedyOfADeviceThatDoesNotOpen) {
  const auto run = claystack("devices usb:250-7 --json");
  EXPECT_EQ(run.status, 4);
  const auto json = run.json();
  const auto& problem = json.at("problem");
  EXPECT_EQ(problem.at("fault"), "not_found");
  EXPECT_EQ(problem.at("what"), "usb:250-7: no such device is connected");
  const auto remedy = problem.at("remedy").get<std::string>();
  EXPECT_NE(remedy.find("without its power supply"), std::string::npos) << remedy;
  EXPECT_EQ(json.at("kind"), "device");
  EXPECT_EQ(json.at("error"), "usb:250-7: no such device is connected; " + remedy);
}

TEST(Devices, RefusesAnUnknownKind) {
  for (const char* arguments : {"devices mouse", "devices simulated --monitor --seconds nan",
                                "devices simulated --monitor --seconds 0"})
    EXPECT_EQ(claystack(arguments).status, 2) << arguments;
}

TEST(Devices, AutoNeverSelectsTheSimulatedArm) {
  const auto run = claystack("devices auto --json");
  EXPECT_EQ(run.out.find("simulated"), std::string::npos);
}

TEST(Devices, HomesAndMonitorsTheSimulatedArm) {
  const auto run = claystack("devices simulated --monitor --seconds 2 --json");
  ASSERT_EQ(run.status, 0) << run.err;
  std::istringstream lines(run.out);
  std::string line;
  nlohmann::json last;
  while (std::getline(lines, line)) {
    last = nlohmann::json::parse(line);
    if (last.at("state") != "ready") continue;
    // Its hand moves on a circle of 20 mm.
    const auto at = last.at("position_mm");
    EXPECT_NEAR(std::hypot(at[0].get<double>(), at[1].get<double>()), 20.0, 1.0) << line;
  }
  EXPECT_EQ(last.at("state"), "ready");
  EXPECT_EQ(last.at("bytes_discarded"), 0);
}

}  // namespace
}  // namespace clay::test
