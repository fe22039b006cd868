#pragma once
// Stands in for libusb, libftdi, hidapi and the USB system call: the functions of the same names
// are those of this program. One Falcon on one line, and HID devices that are files. Each call that
// waits takes one step of time, so nothing depends on the speed of the machine.

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

struct libusb_transfer;

namespace clay::falcon {

using UsbPacket = std::vector<std::uint8_t>;

struct FakeLine {
  int stalled_steps = 0;                 ///< the line takes nothing for this many steps
  std::vector<UsbPacket> delivered;      ///< packets that the device has received
  std::deque<libusb_transfer*> writing;  ///< queued, in order
  std::deque<libusb_transfer*> reading, done;
};

struct FakeHid {
  std::vector<std::string> paths;  ///< of the connected devices
  int read_error = 0;              ///< errno of a reading that fails; 0: none arrives in time
  bool read_fails = false;
  int reports = 0;   ///< that wait for a reader, each without a byte of the stream
  int readings = 0;  ///< so far
};

/// Reset by each test.
FakeLine& fake_line();
FakeHid& fake_hid();

inline constexpr const char* kFakePlace = "usb:1-1";

}  // namespace clay::falcon
