// `claystack devices` as users run it, with emulated devices.

#include "tests/falcon/device/dummy_firmware.hpp"
#include "tests/rigs/falcon_gadget.hpp"
#include "tests/rigs/hid_gadget.hpp"
#include "tests/rigs/testbed.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/wait_until.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <memory>

namespace clay::rig {
namespace {

using namespace clay::falcon;
using test::claystack;

glm::dvec3 at_centre(std::uint64_t) { return kFalconCentreMm; }

class DevicesRig : public testing::Test {
 protected:
  void plug_falcon(const FalconModelSettings& model) {
    falcon_ = std::make_unique<FalconGadget>(model, at_centre);
    plug_ = std::make_unique<UsbPlug>(testbed_.get(), *falcon_);
  }

  /// The only connected device, from --json.
  static nlohmann::json only_one(const std::string& arguments = "") {
    const auto run = claystack("devices --json " + arguments);
    EXPECT_EQ(run.status, 0) << run.err;
    const auto devices = run.json().at("devices");
    EXPECT_EQ(devices.size(), 1u) << run.out;
    return devices.at(0);
  }

  /// Monitors until the condition holds, then stops. Returns the output.
  template <class Condition>
  static std::string monitored(const std::string& more, Condition condition,
                               const std::string& what) {
    test::Program program("exec " CLAYSTACK_PROGRAM " devices falcon --monitor --json " + more);
    test::wait_until([&] { return !program.running() || condition(program.out()); },
                     test::kDeadline, what);
    program.send(SIGINT);
    const auto run = program.wait();
    EXPECT_EQ(run.status, 0) << run.err;
    return run.out;
  }

  Testbed testbed_;
  std::unique_ptr<FalconGadget> falcon_;
  std::unique_ptr<UsbPlug> plug_;
  test::ScratchFolder folder_;
};

TEST_F(DevicesRig, ReportsAFalconDuringItsStart) {
  FalconModelSettings model;
  model.power = false;
  plug_falcon(model);
  EXPECT_EQ(only_one().at("problem").at("fault"), "no_answer");
  EXPECT_EQ(claystack("devices falcon").status, 4);

  falcon_->device.model.switch_power(true);
  EXPECT_EQ(only_one().at("problem").at("fault"), "no_firmware");

  const std::string file = folder_.file("firmware.bin");
  test::write_text(file, "not a boot stream");
  const auto refused = claystack("devices falcon --firmware " + file);
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find(file + ": expected a TI C28x boot stream"), std::string::npos);

  const auto firmware = dummy_firmware();
  test::write_text(file, {firmware.begin(), firmware.end()});
  const auto homing = only_one("--firmware " + file);
  EXPECT_TRUE(homing.at("usable"));
  EXPECT_EQ(homing.at("state"), "needs_homing");
  EXPECT_EQ(homing.at("place"), "usb:1-1");
  EXPECT_NE(claystack("devices").out.find("pull the grip"), std::string::npos);

  const auto homed = [&](const std::string&) {
    const std::scoped_lock held(falcon_->lock);
    return falcon_->device.model.homed();
  };
  monitored("", homed, "the grip to be homed");
  EXPECT_EQ(only_one().at("state"), "ready") << "homed during --monitor";
  EXPECT_EQ(falcon_->device.log.back().motors, LegCounts{});
}

/// Compares the last position printed by --monitor.
TEST_F(DevicesRig, UsesTheGivenGeometryAndMapping) {
  FalconModelSettings model;
  model.loaded = model.homed = true;
  model.geometry = kMartinHillierGeometry;
  falcon_ = std::make_unique<FalconGadget>(
      model, [](std::uint64_t) { return kFalconCentreMm + glm::dvec3(10.0, -20.0, 0.0); });
  plug_ = std::make_unique<UsbPlug>(testbed_.get(), *falcon_);
  const auto last = [](const std::string& more) {
    const auto complete = [](const std::string& lines) { return lines.ends_with("}\n"); };
    const std::string lines = monitored(more, complete, "a position");
    return nlohmann::json::parse(lines.substr(lines.rfind('\n', lines.size() - 2) + 1));
  };
  const auto right = last("--geometry martin-hillier --scale 2 --side left --reach 50 --flip x");
  EXPECT_NEAR(right.at("position_mm")[0], 10.0, 0.07);
  EXPECT_NEAR(right.at("position_mm")[1], -20.0, 0.07);
  EXPECT_NEAR(right.at("position_mm")[2], 0.0, 0.07);
  EXPECT_NEAR(right.at("tool_mm")[0], -50.0 - 2.0 * 10.0, 0.15);
  EXPECT_NEAR(right.at("tool_mm")[1], 75.0 - 2.0 * 20.0, 0.15);
  EXPECT_GT(std::abs(last("").at("position_mm")[2].get<double>()), 1.0)
      << "the default geometry must differ";
}

TEST_F(DevicesRig, ReportsABoundDriverAndAnotherProgram) {
  FalconModelSettings model;
  model.loaded = model.homed = true;
  plug_falcon(model);
  const auto reported_as_busy = [&](const std::string& lines) {
    if (!lines.ends_with("}\n")) return false;
    const auto falcon = only_one();
    EXPECT_EQ(falcon.at("problem").at("fault"), "busy");
    EXPECT_FALSE(falcon.at("usable"));
    const auto second = claystack("devices falcon");
    EXPECT_EQ(second.status, 4);
    EXPECT_NE(second.err.find("another program uses it"), std::string::npos) << second.err;
    return true;
  };
  const std::string first = monitored("", reported_as_busy, "a position");
  EXPECT_EQ(first.find("fault"), std::string::npos) << "the first program is not disturbed";
  EXPECT_TRUE(only_one().at("usable")) << "after the end of the first program";
  plug_->manners.kernel_driver = true;
  const auto bound = only_one();
  EXPECT_TRUE(bound.at("usable"));
  EXPECT_EQ(bound.at("problem").at("fault"), "driver_bound");
}

// Runs as user nobody if the tests run as root.
TEST_F(DevicesRig, ReportsMissingPermission) {
  plug_falcon({});
  SpaceMouseGadget mouse;
  const HidrawNode mouse_node(testbed_.get(), mouse, 3);
  gchar* root = umockdev_testbed_get_root_dir(testbed_.get());
  // umockdev creates sockets there and connects to them even if opening the node fails.
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::string(root) + "/ioctl"))
    std::filesystem::permissions(entry.path(), std::filesystem::perms::all);
  std::filesystem::permissions(root, std::filesystem::perms::all);
  std::filesystem::permissions(root + plug_->node(), std::filesystem::perms::none);
  std::filesystem::permissions(root + mouse_node.node(), std::filesystem::perms::none);
  // A copy in a folder that user nobody can read.
  const std::string program = std::string(root) + "/claystack";
  std::filesystem::copy_file(CLAYSTACK_PROGRAM, program);
  g_free(root);
  const std::string as_nobody =
      geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : "";
  const auto run = test::shell(as_nobody + program + " devices --json");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto devices = run.json().at("devices");
  ASSERT_EQ(devices.size(), 2u);
  for (const auto& device : devices) {
    EXPECT_FALSE(device.at("usable"));
    EXPECT_EQ(device.at("problem").at("fault"), "no_permission");
    EXPECT_NE(device.at("problem").at("remedy").get<std::string>().find("60-claystack.rules"),
              std::string::npos);
  }
}

TEST_F(DevicesRig, ListsConnectedDevicesFalconsFirst) {
  SpaceMouseGadget mouse;
  const HidrawNode mouse_node(testbed_.get(), mouse, 3);
  FalconModelSettings model;
  model.loaded = model.homed = true;
  BridgeGadget bridge(model, at_centre);
  const HidrawNode bridge_node(testbed_.get(), bridge, 2);
  plug_falcon(model);
  const auto devices = claystack("devices --json").json().at("devices");
  ASSERT_EQ(devices.size(), 3u);
  EXPECT_EQ(devices[0].at("kind"), "falcon");
  EXPECT_EQ(devices[1].at("kind"), "bridge");
  EXPECT_EQ(devices[1].at("place"), "/dev/hidraw2");
  EXPECT_EQ(devices[2].at("kind"), "spacemouse");
  EXPECT_EQ(devices[2].at("name"), "SpaceMouse Compact");
  for (const auto& device : devices) {
    EXPECT_TRUE(device.at("usable"));
    EXPECT_EQ(device.at("state"), "ready");
  }
  EXPECT_EQ(claystack("devices auto --json").json().at("place"), "usb:1-1");
}

}  // namespace
}  // namespace clay::rig
