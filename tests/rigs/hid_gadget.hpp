#pragma once
// HID devices for both backends of hidapi: as USB devices for libusb, as kernel nodes for hidraw.

#include "tests/rigs/falcon_gadget.hpp"
#include "tests/rigs/usb_gadget.hpp"

#include <deque>
#include <string>

namespace clay::rig {

class HidGadget : public UsbGadget {
 public:
  [[nodiscard]] const UsbIdentity& identity() const override { return identity_; }
  std::optional<Bytes> control(const Setup&, std::span<const std::uint8_t>) override {
    return std::nullopt;
  }
  std::optional<Bytes> in(std::size_t room, std::chrono::microseconds waited) override;

  std::deque<Bytes> reports;  ///< waiting to be read

 protected:
  UsbIdentity identity_;
};

/// A microcontroller between HID and the Falcon's processor, as described in docs/devices.md.
class BridgeGadget final : public HidGadget {
 public:
  BridgeGadget(const falcon::FalconModelSettings& settings, Trajectory hand, int port = 2);
  void out(std::span<const std::uint8_t> report) override;
  bool unplugged() const override { return device.model.unplugged(); }

  HandledModel device;
  std::uint64_t bad_reports = 0;  ///< reports with an invalid layout
  std::uint64_t bytes = 0;        ///< payload bytes, by the reports' counts
};

/// A SpaceMouse that sends the reports in `reports`.
class SpaceMouseGadget final : public HidGadget {
 public:
  SpaceMouseGadget();
  void out(std::span<const std::uint8_t> report) override {
    light = report.size() == 2 && report[0] == 4 && report[1] == 1;
  }
  bool unplugged() const override { return gone; }

  bool light = false;
  bool gone = false;
};

/// The gadget as /dev/hidrawN. The node is a terminal with real polling: it holds one report at a
/// time, so that reports do not merge.
class HidrawNode {
 public:
  HidrawNode(UMockdevTestbed* testbed, HidGadget& gadget, int number);
  ~HidrawNode();
  HidrawNode(const HidrawNode&) = delete;
  HidrawNode& operator=(const HidrawNode&) = delete;

  /// Sends the gadget's reports; call it with the lock after a change to `reports`.
  void pump();
  /// Removes or restores the node.
  void show(bool there);
  /// From now on the node is that of another device.
  void become(const UsbIdentity& other);
  [[nodiscard]] const std::string& node() const { return node_; }

 private:
  static gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
  static gboolean on_read(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
  static gboolean on_write(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);

  HidGadget& gadget_;
  UMockdevTestbed* testbed_;
  UMockdevIoctlBase* base_ = nullptr;
  std::string node_, path_, hid_path_;
  int terminal_ = -1;
  bool waiting_ = false;  // a report is in the terminal
};

}  // namespace clay::rig
