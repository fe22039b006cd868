#include "falcon/device/usb/hid_node.hpp"

#include "falcon/device/usb/held_signals.hpp"
#include "falcon/device/usb/usb_error.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <memory>
#include <system_error>

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

HidNode::Identity HidNode::identity_of(const hid_device_info& info) {
  const auto text = [](const wchar_t* string) { return string ? string : L""; };
  return {info.vendor_id,        info.product_id,          info.usage_page,          info.usage,
          info.interface_number, text(info.serial_number), text(info.product_string)};
}

std::string HidNode::find(const std::string& place) {
  const std::unique_ptr<hid_device_info, decltype(&hid_free_enumeration)> all(
      hid_enumerate(0, 0), &hid_free_enumeration);
  std::string found;
  for (const hid_device_info* info = all.get(); info; info = info->next) {
    if (identity_ && identity_of(*info) != *identity_) continue;
    const bool there = place == info->path;
    if (there && !identity_) identity_ = identity_of(*info);
    if (there) return place;
    if (identity_ && found.empty()) found = info->path;
  }
  return found;
}

DeviceResult<void> HidNode::open(const std::string& place, Use use) {
  close();
  const HeldSignals held;
  const std::string path = find(place);
  if (path.empty())
    return device_failure(DeviceFault::unplugged, place + ": could not open: it is not there",
                          "plug it in again");
  device_ = hid_open_path(path.c_str());
  if (!device_) return tl::make_unexpected(node_error(path));
  if (path.front() != '/') return {};
  auto opened = open_descriptor(path, use);
  if (!opened) close();
  return opened;
}

/// For a signal handler, which may not call hidapi, and for the lock.
DeviceResult<void> HidNode::open_descriptor(const std::string& path, Use use) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
  descriptor_.store(descriptor);
  if (descriptor < 0)
    return device_failure(DeviceFault::transfer_failed,
                          path + ": could not open it for ending the force: " +
                              std::generic_category().message(errno));
  if (use == Use::shared || flock(descriptor, LOCK_EX | LOCK_NB) == 0) return {};
  if (errno == EWOULDBLOCK)
    return device_failure(DeviceFault::busy, path + ": could not open: another program uses it",
                          "close the other program that uses it");
  return device_failure(DeviceFault::transfer_failed,
                        path + ": could not lock: " + std::generic_category().message(errno));
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
  errno = 0;  // hidapi may fail without setting it
  const int size = hid_read_timeout(device_, report.data(), report.size(),
                                    static_cast<int>((wait_us + 999) / 1000));
  return size < 0 && errno == EINTR ? 0 : size;
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
