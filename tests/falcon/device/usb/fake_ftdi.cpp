#include "claystack/falcon/usb.hpp"
#include "tests/falcon/device/usb/fake_usb.hpp"

#include <ftdi.h>
#include <libusb.h>
#include <linux/usbdevice_fs.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>

namespace clay::falcon {
namespace {

constexpr int kDescriptor = 1'000'000;  // more than a process can open

int usb_object = 0;  // its address stands for the context, the device and its handle

template <class Object>
Object* the() {
  return reinterpret_cast<Object*>(&usb_object);
}

/// Transfers that wait in the host reach the device as soon as the line works, reaped or not.
void step() {
  FakeLine& line = fake_line();
  if (line.stalled_steps > 0) --line.stalled_steps;
  if (line.stalled_steps > 0) return;
  for (libusb_transfer* transfer : line.writing) {
    line.delivered.emplace_back(transfer->buffer, transfer->buffer + transfer->length);
    transfer->status = LIBUSB_TRANSFER_COMPLETED;
    transfer->actual_length = transfer->length;
    line.done.push_back(transfer);
  }
  line.writing.clear();
}

int bulk_now(const usbdevfs_bulktransfer& bulk) {
  step();
  FakeLine& line = fake_line();
  if (line.stalled_steps > 0) {
    errno = ETIMEDOUT;
    return -1;
  }
  const auto* bytes = static_cast<const std::uint8_t*>(bulk.data);
  line.delivered.emplace_back(bytes, bytes + bulk.len);
  return static_cast<int>(bulk.len);
}

}  // namespace

FakeLine& fake_line() {
  static FakeLine line;
  return line;
}

}  // namespace clay::falcon

using clay::falcon::fake_line;
using clay::falcon::the;

extern "C" {

int ioctl(int descriptor, unsigned long request, ...) noexcept {
  va_list more;
  va_start(more, request);
  void* argument = va_arg(more, void*);
  va_end(more);
  if (descriptor == clay::falcon::kDescriptor && request == USBDEVFS_BULK)
    return clay::falcon::bulk_now(*static_cast<usbdevfs_bulktransfer*>(argument));
  return static_cast<int>(syscall(SYS_ioctl, descriptor, request, argument));
}

// ---- libftdi -------------------------------------------------------------------------

ftdi_context* ftdi_new() {
  auto* made = new ftdi_context{};
  made->usb_ctx = the<libusb_context>();
  return made;
}
void ftdi_free(ftdi_context* ftdi) { delete ftdi; }
int ftdi_usb_open_dev(ftdi_context* ftdi, libusb_device*) {
  ftdi->usb_dev = the<libusb_device_handle>();
  return 0;
}
int ftdi_usb_close(ftdi_context*) { return 0; }

// ---- libusb --------------------------------------------------------------------------

ssize_t libusb_get_device_list(libusb_context*, libusb_device*** list) {
  *list = new libusb_device* [2] { the<libusb_device>(), nullptr };
  return 1;
}
void libusb_free_device_list(libusb_device** list, int) { delete[] list; }
int libusb_get_device_descriptor(libusb_device*, libusb_device_descriptor* descriptor) {
  descriptor->idVendor = clay::falcon::kFalconVendor;
  descriptor->idProduct = clay::falcon::kFalconProduct;
  return 0;
}
std::uint8_t libusb_get_bus_number(libusb_device*) { return 1; }
int libusb_get_port_numbers(libusb_device*, std::uint8_t* ports, int) {
  ports[0] = 1;
  return 1;
}
int libusb_open(libusb_device*, libusb_device_handle** handle) {
  *handle = the<libusb_device_handle>();
  return 0;
}
void libusb_close(libusb_device_handle*) {}
int libusb_kernel_driver_active(libusb_device_handle*, int) { return 0; }
int libusb_claim_interface(libusb_device_handle*, int) { return 0; }
int libusb_release_interface(libusb_device_handle*, int) { return 0; }

const libusb_pollfd** libusb_get_pollfds(libusb_context*) {
  static const libusb_pollfd device{clay::falcon::kDescriptor, POLLOUT};
  static const libusb_pollfd* all[] = {&device, nullptr};
  return all;
}
void libusb_free_pollfds(const libusb_pollfd**) {}

libusb_transfer* libusb_alloc_transfer(int) { return new libusb_transfer{}; }
void libusb_free_transfer(libusb_transfer* transfer) { delete transfer; }
int libusb_submit_transfer(libusb_transfer* transfer) {
  const bool reads = (transfer->endpoint & LIBUSB_ENDPOINT_IN) != 0;
  (reads ? fake_line().reading : fake_line().writing).push_back(transfer);
  return 0;
}
int libusb_cancel_transfer(libusb_transfer* transfer) {
  for (auto* queue : {&fake_line().reading, &fake_line().writing})
    if (std::erase(*queue, transfer) > 0) {
      transfer->status = LIBUSB_TRANSFER_CANCELLED;
      transfer->actual_length = 0;
      fake_line().done.push_back(transfer);
      return 0;
    }
  return LIBUSB_ERROR_NOT_FOUND;
}
int libusb_handle_events_timeout_completed(libusb_context*, timeval*, int*) {
  clay::falcon::step();
  auto& done = fake_line().done;
  while (!done.empty()) {
    libusb_transfer* transfer = done.front();
    done.pop_front();
    transfer->callback(transfer);
  }
  return 0;
}

}  // extern "C"
