#pragma once
// An emulated USB device that libusb finds, opens and uses: umockdev passes the system calls of
// unmodified libraries to a gadget. Runs under umockdev-wrapper.

#include <umockdev.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace clay::rig {

using Bytes = std::vector<std::uint8_t>;

/// A control transfer's first eight bytes.
struct Setup {
  std::uint8_t request_type = 0, request = 0;
  std::uint16_t value = 0, index = 0, length = 0;
};

struct UsbIdentity {
  std::uint16_t vendor = 0, product = 0;
  std::string name;
  std::uint8_t interface_class = 0xFF;
  std::uint8_t in = 0x81, out = 0x02;  ///< endpoints, of 64 bytes
  bool interrupt = false;              ///< interrupt endpoints; otherwise bulk
  Bytes report_descriptor;             ///< of a HID device
  int port = 1;                        ///< on bus 1
};

/// Two digits per byte, as in umockdev's descriptions.
std::string hexadecimal(const Bytes& bytes);

/// The device's behaviour. Called on the testbed's thread, one call at a time, under `lock`.
class UsbGadget {
 public:
  virtual ~UsbGadget() = default;
  [[nodiscard]] virtual const UsbIdentity& identity() const = 0;
  /// The answer; empty for an unknown request.
  virtual std::optional<Bytes> control(const Setup& setup, std::span<const std::uint8_t> data) = 0;
  virtual void out(std::span<const std::uint8_t> bytes) = 0;
  /// Data for a read that has waited this long; empty: it continues to wait.
  virtual std::optional<Bytes> in(std::size_t room, std::chrono::microseconds waited) = 0;
  virtual bool unplugged() const = 0;

  std::mutex lock;
  std::vector<Bytes> refused;  ///< writes of the host to a removed device
};

/// State of the connection to the device. Change it under the gadget's lock while a program runs.
struct UsbManners {
  bool kernel_driver = false;  ///< bound until it is detached
  /// A stalled line takes writes and does not deliver them, and answers no read. It recovers after
  /// this number of synchronous writes, each of which times out.
  int stalled_writes = 0;
};
inline constexpr int kStalledForGood = 1'000'000;

class UsbPlug {
 public:
  /// Connects the gadget to the testbed, which must outlive this, permanently or until `pull`.
  UsbPlug(UMockdevTestbed* testbed, UsbGadget& gadget);
  ~UsbPlug();
  UsbPlug(const UsbPlug&) = delete;
  UsbPlug& operator=(const UsbPlug&) = delete;

  /// Path of the node, for setting its permissions.
  [[nodiscard]] const std::string& node() const { return node_; }
  /// Ends a stall: the line delivers every write that was not cancelled. Under the gadget's lock.
  void recover();
  /// Removes the device from the system.
  void pull();
  UsbManners manners;

 private:
  using Clock = std::chrono::steady_clock;
  struct Urb {
    UMockdevIoctlData* data = nullptr;
    UMockdevIoctlData* buffer = nullptr;
    Clock::time_point since;
  };

  static gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
  static void on_vanished(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
  void handle(UMockdevIoctlClient* client);
  [[nodiscard]] int claim(const UMockdevIoctlClient* client);
  void submit(UMockdevIoctlClient* client, UMockdevIoctlData* data);
  void reap(UMockdevIoctlClient* client, UMockdevIoctlData* data);
  void discard(UMockdevIoctlClient* client);
  void refuse(UMockdevIoctlData* bytes, std::size_t size);
  void bulk(UMockdevIoctlClient* client, UMockdevIoctlData* data);
  std::optional<Bytes> describe(const Setup& setup) const;
  void run_control(Urb& urb);
  void deliver_writes();
  void fill_reads();
  void finish(const Urb& urb, int status, std::size_t length);

  UMockdevTestbed* testbed_;
  UsbGadget& gadget_;
  std::string path_;  // its folder in /sys
  UMockdevIoctlBase* base_ = nullptr;
  std::string node_;
  const UMockdevIoctlClient* claimed_by_ = nullptr;  // one open file, of any program
  std::deque<Urb> writes_, reads_, done_;
};

}  // namespace clay::rig
