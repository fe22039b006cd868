// Behaviour of the transports when the line stalls, another program has the device, or a signal
// arrives.

#include "claystack/falcon/usb.hpp"
#include "falcon/device/usb/hid_node.hpp"
#include "tests/falcon/device/usb/fake_usb.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace clay::falcon {
namespace {

using Packets = std::vector<UsbPacket>;

const UsbPacket kForce(16, 4), kZero(16, 0);

class FtdiStall : public testing::Test {
 protected:
  FtdiStall() {
    fake_line() = {};
    EXPECT_TRUE(transport_->open());
    send(kForce);
  }
  void send(const UsbPacket& packet) { EXPECT_EQ(transport_->write(packet), WireStatus::ok); }
  void read() {
    std::array<std::uint8_t, 64> bytes{};
    (void)transport_->read(bytes, 0);
  }

  std::unique_ptr<Transport> transport_ = make_ftdi_transport(kFakePlace);
};

TEST_F(FtdiStall, LastPacketIsZeroAfterAStall) {
  read();
  ASSERT_EQ(fake_line().delivered, Packets{kForce});
  // The line recovers while the device is being closed.
  for (const int steps : {2, 3, 10, 40}) {
    fake_line().delivered.clear();
    fake_line().stalled_steps = steps;
    for (int tick = 0; tick < 3; ++tick) send(kForce);
    transport_->write_last(kZero);
    transport_->close();
    EXPECT_EQ(fake_line().delivered, Packets{kZero}) << steps;
    EXPECT_TRUE(fake_line().writing.empty());
    ASSERT_TRUE(transport_->open());
  }
}

TEST_F(FtdiStall, SendsNoOldForceIfTheLineNeverRecovers) {
  read();
  fake_line().delivered.clear();
  fake_line().stalled_steps = 1'000'000;
  send(kForce);
  transport_->write_last(kZero);
  transport_->close();  // returns
  EXPECT_TRUE(fake_line().writing.empty()) << "would be sent when the line recovers";
  EXPECT_TRUE(fake_line().delivered.empty());
}

TEST_F(FtdiStall, SendsTheLastPacketOnceIfTheLineTakesIt) {
  transport_->write_last(kZero);
  transport_->close();
  EXPECT_EQ(fake_line().delivered, (Packets{kForce, kZero}));
}

class HidFiles : public testing::Test {
 protected:
  HidFiles() {
    EXPECT_TRUE(std::ofstream(path_)) << path_;
    fake_hid() = {};
    fake_hid().paths = {path_};
  }
  ~HidFiles() override { unlink(path_.c_str()); }

  /// A file of this process.
  const std::string path_ = testing::TempDir() + "claystack-hidraw-" + std::to_string(getpid());
};

TEST_F(HidFiles, BridgeRefusesASecondProgram) {
  const auto first = make_bridge_transport(path_), second = make_bridge_transport(path_);
  ASSERT_TRUE(first->open());
  const auto refused = second->open();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().fault, DeviceFault::busy);
  EXPECT_EQ(refused.error().what, path_ + ": could not open: another program uses it");
  EXPECT_EQ(refused.error().remedy, "close the other program that uses it");
  EXPECT_TRUE(first->open()) << "its own lock does not refuse it";
  first->close();
  EXPECT_TRUE(second->open());
}

TEST_F(HidFiles, ProgramsMayShareASpaceMouse) {
  HidNode first, second;
  EXPECT_TRUE(first.open(path_, HidNode::Use::shared));
  EXPECT_TRUE(second.open(path_, HidNode::Use::shared));
}

TEST_F(HidFiles, ASignalIsNotAnUnplugging) {
  const auto bridge = make_bridge_transport(path_);
  ASSERT_TRUE(bridge->open());
  std::array<std::uint8_t, 256> bytes{};
  fake_hid().read_fails = true;
  fake_hid().read_error = EINTR;
  EXPECT_EQ(bridge->read(bytes, 1000).status, WireStatus::ok);
  fake_hid().read_error = ENODEV;
  EXPECT_EQ(bridge->read(bytes, 1000).status, WireStatus::unplugged);
  errno = EINTR;  // of an earlier call
  fake_hid().read_error = 0;
  EXPECT_EQ(bridge->read(bytes, 1000).status, WireStatus::unplugged);
}

TEST_F(HidFiles, AFloodOfReportsDoesNotHoldTheReader) {
  const auto bridge = make_bridge_transport(path_);
  ASSERT_TRUE(bridge->open());
  std::array<std::uint8_t, 256> bytes{};
  fake_hid().reports = 1'000'000;
  fake_hid().readings = 0;
  const Received received = bridge->read(bytes, 1000);
  EXPECT_EQ(received.status, WireStatus::ok);
  EXPECT_EQ(received.size, 0u);
  EXPECT_EQ(fake_hid().readings, 64) << "as many reports as the kernel keeps";
  fake_hid().readings = 0;
  EXPECT_TRUE(bridge->set_mode(LineMode::running));
  EXPECT_EQ(fake_hid().readings, 64) << "discards pending reports";
}

}  // namespace
}  // namespace clay::falcon
