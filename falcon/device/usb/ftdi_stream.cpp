#include "falcon/device/usb/ftdi_stream.hpp"

#include <libusb.h>

#include <algorithm>

namespace clay::falcon::inline device {
namespace {

constexpr std::uint8_t kIn = 0x81, kOut = 0x02;
// Modem and line status, which precede the data of every packet.
constexpr std::size_t kStatusBytes = 2;
// The kernel reports some broken transfers of a failing line before it reports the disconnection.
constexpr int kErrorsBorne = 3;
constexpr std::int64_t kCancelWaitUs = 10'000;
constexpr int kCancelWaits = 100;

}  // namespace

bool FtdiStream::start(libusb_context* context, libusb_device_handle* handle) {
  context_ = context;
  status_ = WireStatus::ok;
  errors_ = 0;
  stopping_ = false;
  ring_.clear();
  const auto prepare = [&](Slot& slot, std::uint8_t endpoint, libusb_transfer_cb_fn done) {
    slot.owner = this;
    slot.transfer = libusb_alloc_transfer(0);
    if (!slot.transfer) return false;
    libusb_fill_bulk_transfer(slot.transfer, handle, endpoint, slot.bytes.data(),
                              static_cast<int>(slot.bytes.size()), done, &slot, 0);
    return true;
  };
  for (Slot& slot : writes_)
    if (!prepare(slot, kOut, [](libusb_transfer* t) { on_written(t); })) return false;
  for (Slot& slot : reads_) {
    if (!prepare(slot, kIn, [](libusb_transfer* t) { on_read(t); })) return false;
    submit(slot);
  }
  return status_ == WireStatus::ok;
}

bool FtdiStream::any_queued() const noexcept {
  const auto queued = [](const Slot& slot) { return slot.queued; };
  return std::any_of(reads_.begin(), reads_.end(), queued) ||
         std::any_of(writes_.begin(), writes_.end(), queued);
}

void FtdiStream::stop() noexcept {
  if (!context_) return;
  // Queued writes are forces of earlier ticks: a line that recovers now must not send them.
  stopping_ = true;
  const auto cancel = [](Slot& slot) {
    if (slot.queued) libusb_cancel_transfer(slot.transfer);
  };
  std::for_each(reads_.begin(), reads_.end(), cancel);
  std::for_each(writes_.begin(), writes_.end(), cancel);
  for (int i = 0; i < kCancelWaits && any_queued(); ++i) pump(kCancelWaitUs);
  const auto release = [](Slot& slot) {
    // A transfer that never completed stays allocated, because the system may still use it.
    if (!slot.queued) libusb_free_transfer(slot.transfer);
    slot.transfer = nullptr;
    slot.queued = false;
  };
  std::for_each(reads_.begin(), reads_.end(), release);
  std::for_each(writes_.begin(), writes_.end(), release);
  context_ = nullptr;
}

void FtdiStream::note(int transfer_status) noexcept {
  if (transfer_status == LIBUSB_TRANSFER_COMPLETED) {
    errors_ = 0;
  } else if (transfer_status == LIBUSB_TRANSFER_NO_DEVICE) {
    status_ = WireStatus::unplugged;
  } else if (transfer_status != LIBUSB_TRANSFER_CANCELLED && ++errors_ > kErrorsBorne &&
             status_ == WireStatus::ok) {
    status_ = WireStatus::failed;
  }
}

void FtdiStream::submit(Slot& slot) noexcept {
  const int code = libusb_submit_transfer(slot.transfer);
  slot.queued = code == 0;
  if (code == LIBUSB_ERROR_NO_DEVICE) status_ = WireStatus::unplugged;
  if (code != 0 && status_ == WireStatus::ok) status_ = WireStatus::failed;
}

void FtdiStream::on_read(libusb_transfer* transfer) noexcept {
  Slot& slot = *static_cast<Slot*>(transfer->user_data);
  FtdiStream& stream = *slot.owner;
  slot.queued = false;
  stream.note(transfer->status);
  const std::size_t size = static_cast<std::size_t>(transfer->actual_length);
  if (transfer->status == LIBUSB_TRANSFER_COMPLETED && size > kStatusBytes) {
    stream.ring_.push(std::span(slot.bytes).first(size).subspan(kStatusBytes));
    stream.arrived_us_ = monotonic_us();
    stream.something_came_ = 1;
  }
  if (!stream.stopping_ && stream.status_ == WireStatus::ok) stream.submit(slot);
  if (stream.status_ != WireStatus::ok) stream.something_came_ = 1;
}

void FtdiStream::on_written(libusb_transfer* transfer) noexcept {
  Slot& slot = *static_cast<Slot*>(transfer->user_data);
  slot.queued = false;
  slot.owner->note(transfer->status);
}

void FtdiStream::pump(std::int64_t wait_us) noexcept {
  timeval wait{wait_us / 1'000'000, wait_us % 1'000'000};
  libusb_handle_events_timeout_completed(context_, &wait, nullptr);
}

WireStatus FtdiStream::write(std::span<const std::uint8_t> bytes) noexcept {
  if (!context_ || bytes.size() > kMostWritten) return WireStatus::failed;
  const auto idle = [this] {
    return std::find_if(writes_.begin(), writes_.end(), [](const Slot& s) { return !s.queued; });
  };
  if (idle() == writes_.end()) pump(0);
  if (status_ != WireStatus::ok) return status_;
  const auto slot = idle();
  if (slot == writes_.end()) return WireStatus::busy;
  std::copy(bytes.begin(), bytes.end(), slot->bytes.begin());
  slot->transfer->length = static_cast<int>(bytes.size());
  submit(*slot);
  return status_;
}

Received FtdiStream::read(std::span<std::uint8_t> bytes, std::int64_t wait_us) noexcept {
  if (!context_) return {0, monotonic_us(), WireStatus::failed};
  const std::int64_t end_us = monotonic_us() + wait_us;
  std::int64_t left_us = wait_us;
  do {
    something_came_ = 0;
    timeval wait{left_us / 1'000'000, left_us % 1'000'000};
    libusb_handle_events_timeout_completed(context_, &wait, &something_came_);
    left_us = end_us - monotonic_us();
  } while (ring_.empty() && status_ == WireStatus::ok && left_us > 0);
  return {ring_.pop(bytes), arrived_us_, status_};
}

}  // namespace clay::falcon::inline device
