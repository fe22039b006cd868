#include "claystack/falcon/usb.hpp"
#include "falcon/device/usb/ftdi_stream.hpp"
#include "falcon/device/usb/usb_error.hpp"

#include <ftdi.h>
#include <libusb.h>
#include <linux/usbdevice_fs.h>
#include <poll.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <memory>

namespace clay::falcon::inline device {
namespace {

// With 1 ms the greeting often fails on real devices.
constexpr unsigned char kLoadingLatencyMs = 16, kRunningLatencyMs = 1;
constexpr unsigned kOut = 0x02;
constexpr unsigned kLastPacketMs = 20;
constexpr unsigned kAskMs = 100;
constexpr int kLastPacketTries = 50;  // with the time of each, 1 s for a stalled line

/// The file descriptor that libusb uses for the only open device of its context.
int descriptor_of(libusb_context* context) {
  const libusb_pollfd** all = libusb_get_pollfds(context);
  int found = -1;
  // libusb polls a device for writing, and its own event pipe for reading.
  for (const libusb_pollfd** one = all; one && *one; ++one)
    if ((*one)->events & POLLOUT) found = (*one)->fd;
  libusb_free_pollfds(all);
  return found;
}

class FtdiTransport final : public Transport {
 public:
  explicit FtdiTransport(std::string place) : place_(std::move(place)) {}
  ~FtdiTransport() override { close(); }

  [[nodiscard]] std::string describe() const override { return place_; }
  [[nodiscard]] bool loads_firmware() const noexcept override { return true; }

  DeviceResult<void> open() override {
    close();
    ftdi_ = ftdi_new();
    if (!ftdi_) return device_failure(DeviceFault::transfer_failed, place_ + ": no libusb");
    auto opened = open_in_context();
    if (!opened) close();
    return opened;
  }

  void close() noexcept override {
    stream_.stop();
    send_owed_packet();
    descriptor_.store(-1);
    if (!ftdi_) return;
    if (ftdi_->usb_dev) ftdi_usb_close(ftdi_);
    ftdi_free(ftdi_);
    ftdi_ = nullptr;
  }

  DeviceResult<void> set_mode(LineMode mode) override {
    const bool running = mode == LineMode::running, greeting = mode == LineMode::greeting;
    const auto set = [this](int done, const char* action) -> DeviceResult<void> {
      if (done >= 0) return {};
      return tl::make_unexpected(line_error(action, ftdi_get_error_string(ftdi_)));
    };
    auto done = set(ftdi_set_latency_timer(ftdi_, running ? kRunningLatencyMs : kLoadingLatencyMs),
                    "set the latency timer");
    if (done) done = set(ftdi_set_baudrate(ftdi_, baud_of(mode)), "set the baud rate");
    if (done) done = set(ftdi_set_line_property(ftdi_, BITS_8, STOP_BIT_1, NONE), "set the line");
    if (done) done = set(ftdi_setflowctrl(ftdi_, SIO_DISABLE_FLOW_CTRL), "set the flow control");
    if (done && greeting) done = set(ftdi_setrts(ftdi_, 0), "set RTS");
    if (done && !running) done = set(ftdi_setdtr(ftdi_, 0), "set DTR");
    if (done && greeting) done = set(ftdi_setdtr(ftdi_, 1), "set DTR");
    if (done) done = set(ftdi_tcioflush(ftdi_), "empty the buffers");
    stream_.forget();
    return done;
  }

  WireStatus write(std::span<const std::uint8_t> bytes) noexcept override {
    return stream_.write(bytes);
  }

  Received read(std::span<std::uint8_t> bytes, std::int64_t wait_us) noexcept override {
    return stream_.read(bytes, wait_us);
  }

  /// Bypasses libusb, whose locks the interrupted thread may hold: one system call, which keeps the
  /// order of queued packets. If the line stalls, `close` repeats it.
  void write_last(std::span<const std::uint8_t> bytes) noexcept override {
    const int descriptor = descriptor_.load();
    if (descriptor < 0 || bytes.size() > kMostWritten) return;
    const int before = errno;
    Packet copy{};
    std::copy(bytes.begin(), bytes.end(), copy.begin());
    usbdevfs_bulktransfer bulk{};
    bulk.ep = kOut;
    bulk.len = static_cast<unsigned>(bytes.size());
    bulk.timeout = kLastPacketMs;
    bulk.data = copy.data();
    const bool stalled = ioctl(descriptor, USBDEVFS_BULK, &bulk) < 0 && errno == ETIMEDOUT;
    if (stalled) std::copy(copy.begin(), copy.end(), owed_bytes_.begin());
    owed_size_.store(stalled ? bytes.size() : 0);
    errno = before;
  }

 private:
  using Packet = std::array<std::uint8_t, kMostWritten>;

  /// A stalled line took the queued forces, but not the last packet: without it, the arm would
  /// continue to push after the line has recovered. Call when nothing is queued any more.
  void send_owed_packet() noexcept {
    for (int i = 0; i < kLastPacketTries && owed_size_.load() > 0; ++i) {
      Packet packet{};
      std::copy(owed_bytes_.begin(), owed_bytes_.end(), packet.begin());
      write_last(std::span(packet).first(owed_size_.load()));
    }
    owed_size_.store(0);
  }

  /// The codes of libftdi are not those of libusb, so a request on the line checks whether the
  /// device is connected: libusb answers other requests from data that the system has stored.
  [[nodiscard]] DeviceError line_error(const char* action, const char* why) const {
    std::array<unsigned char, 2> status{};
    const int code =
        libusb_control_transfer(ftdi_->usb_dev, LIBUSB_ENDPOINT_IN, LIBUSB_REQUEST_GET_STATUS, 0, 0,
                                status.data(), status.size(), kAskMs);
    if (code == LIBUSB_ERROR_NO_DEVICE) return usb_error(place_, action, code);
    return {DeviceFault::transfer_failed, place_ + ": could not " + action + ": " + why,
            "unplug it and plug it in again"};
  }

  DeviceResult<void> open_in_context() {
    libusb_device** devices = nullptr;
    const auto count = libusb_get_device_list(ftdi_->usb_ctx, &devices);
    if (count < 0)
      return tl::make_unexpected(usb_error(place_, "list devices", static_cast<int>(count)));
    const auto end = devices + count;
    const auto device = std::find_if(devices, end, [this](libusb_device* d) {
      libusb_device_descriptor descriptor{};
      return libusb_get_device_descriptor(d, &descriptor) == 0 &&
             descriptor.idVendor == kFalconVendor && descriptor.idProduct == kFalconProduct &&
             place_of(d) == place_;
    });
    auto opened = device == end
                      ? device_failure(DeviceFault::not_found, place_ + ": no Falcon there",
                                       "plug it in at the same port")
                      : open_device(*device);
    libusb_free_device_list(devices, 1);
    return opened;
  }

  DeviceResult<void> open_device(libusb_device* device) {
    // libftdi reports little about the cause; it detaches a bound kernel driver itself.
    auto access = check_usb_access(device);
    if (!access && access.error().fault != DeviceFault::driver_bound) return access;
    if (const int code = ftdi_usb_open_dev(ftdi_, device); code < 0) {
      // Since the check, it may have been unplugged or opened by another program.
      access = check_usb_access(device);
      if (!access && access.error().fault != DeviceFault::driver_bound) return access;
      return device_failure(DeviceFault::transfer_failed,
                            place_ + ": could not open: " + ftdi_get_error_string(ftdi_),
                            "unplug it and plug it in again");
    }
    if (!stream_.start(ftdi_->usb_ctx, ftdi_->usb_dev))
      return tl::make_unexpected(line_error("queue a transfer", "the system refused it"));
    descriptor_.store(descriptor_of(ftdi_->usb_ctx));
    if (descriptor_.load() < 0)  // watchdog and signal handlers could not end the force
      return device_failure(DeviceFault::transfer_failed,
                            place_ + ": could not find the descriptor of the device");
    return {};
  }

  std::string place_;
  ftdi_context* ftdi_ = nullptr;
  FtdiStream stream_;
  std::atomic<int> descriptor_{-1};
  // The last packet that a stalled line did not take. Atomic, because a signal handler may write it
  // while another thread does.
  std::array<std::atomic<std::uint8_t>, kMostWritten> owed_bytes_{};
  std::atomic<std::size_t> owed_size_{0};  // 0: none
};

}  // namespace

std::unique_ptr<Transport> make_ftdi_transport(std::string place) {
  return std::make_unique<FtdiTransport>(std::move(place));
}

}  // namespace clay::falcon::inline device
