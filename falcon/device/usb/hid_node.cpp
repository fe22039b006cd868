#include "falcon/device/usb/hid_node.hpp"

#include "falcon/device/usb/held_signals.hpp"
#include "falcon/device/usb/usb_error.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace clay::falcon::inline device {
namespace {

/// True while this thread is in a call of hidapi and may hold its locks.
thread_local volatile std::sig_atomic_t in_hidapi = 0;

class InHidapi {
 public:
  InHidapi() noexcept { in_hidapi = 1; }
  ~InHidapi() { in_hidapi = 0; }
  InHidapi(const InHidapi&) = delete;
  InHidapi& operator=(const InHidapi&) = delete;
};

}  // namespace

DeviceResult<void> HidNode::open(const std::string& place) {
  close();
  const HeldSignals held;
  device_ = hid_open_path(place.c_str());
  if (!device_) return tl::make_unexpected(node_error(place));
  if (place.front() == '/')
    descriptor_.store(::open(place.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
  return {};
}

void HidNode::close() noexcept {
  const int descriptor = descriptor_.exchange(-1);
  if (descriptor >= 0) ::close(descriptor);
  if (device_) hid_close(device_);
  device_ = nullptr;
}

int HidNode::read(std::span<std::uint8_t> report, std::int64_t wait_us) noexcept {
  if (!device_) return -1;
  const InHidapi inside;
  return hid_read_timeout(device_, report.data(), report.size(),
                          static_cast<int>((wait_us + 999) / 1000));
}

bool HidNode::write(std::span<const std::uint8_t> report) noexcept {
  const InHidapi inside;
  return device_ && hid_write(device_, report.data(), report.size()) >= 0;
}

void HidNode::write_last(std::span<const std::uint8_t> report) noexcept {
  const int before = errno;
  if (const int descriptor = descriptor_.load(); descriptor >= 0) {
    [[maybe_unused]] const auto sent = ::write(descriptor, report.data(), report.size());
  } else if (in_hidapi == 0) {
    write(report);
  }
  errno = before;
}

}  // namespace clay::falcon::inline device
