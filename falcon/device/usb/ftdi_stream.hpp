#pragma once
// The bulk transfers of an FTDI chip: reads are always queued, writes are not waited for.
// Everything runs inside `pump`, on the caller's thread. libusb allocates a little in each call.

#include "claystack/falcon/device.hpp"
#include "falcon/device/usb/byte_ring.hpp"

#include <array>
#include <cstdint>
#include <span>

struct libusb_context;
struct libusb_device_handle;
struct libusb_transfer;

namespace clay::falcon::inline device {

class FtdiStream {
 public:
  FtdiStream() = default;
  FtdiStream(const FtdiStream&) = delete;
  FtdiStream& operator=(const FtdiStream&) = delete;
  ~FtdiStream() { stop(); }

  /// Queues the reads. The handle must be claimed, and must outlive `stop`.
  [[nodiscard]] bool start(libusb_context* context, libusb_device_handle* handle);
  /// Cancels all queued transfers: bytes that were written but not sent are never sent.
  void stop() noexcept;

  WireStatus write(std::span<const std::uint8_t> bytes) noexcept;
  Received read(std::span<std::uint8_t> bytes, std::int64_t wait_us) noexcept;
  void forget() noexcept { ring_.clear(); }

 private:
  static constexpr std::size_t kPacket =
      64;  // packet size of a full-speed chip such as the Falcon's
  struct Slot {
    FtdiStream* owner = nullptr;
    libusb_transfer* transfer = nullptr;
    bool queued = false;
    std::array<std::uint8_t, kPacket> bytes{};
  };

  static void on_read(libusb_transfer* transfer) noexcept;
  static void on_written(libusb_transfer* transfer) noexcept;
  void submit(Slot& slot) noexcept;
  void note(int transfer_status) noexcept;
  void pump(std::int64_t wait_us) noexcept;
  [[nodiscard]] bool any_queued() const noexcept;

  libusb_context* context_ = nullptr;
  std::array<Slot, 2> reads_;
  std::array<Slot, 8> writes_;
  ByteRing ring_;
  std::int64_t arrived_us_ = 0;
  WireStatus status_ = WireStatus::ok;
  int errors_ = 0;
  int something_came_ = 0;
  bool stopping_ = false;
};

}  // namespace clay::falcon::inline device
