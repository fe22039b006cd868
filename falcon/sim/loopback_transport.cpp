#include "falcon/sim/loopback_transport.hpp"

#include <time.h>

#include <algorithm>
#include <cerrno>

namespace clay::falcon::inline sim {
namespace {

constexpr int kPatience = 1'000'000;  // polls: about ten milliseconds

}  // namespace

LoopbackTransport::LoopbackTransport(std::shared_ptr<FalconModel> model, SimClock clock)
    : model_(std::move(model)), clock_(clock) {}

std::int64_t LoopbackTransport::now_us() const noexcept {
  return clock_ == SimClock::real ? monotonic_us() : stepped_us_;
}

void LoopbackTransport::wait_until(std::int64_t time_us) noexcept {
  if (clock_ == SimClock::stepped) {
    stepped_us_ = std::max(stepped_us_, time_us);
    return;
  }
  const timespec until{time_us / 1'000'000, static_cast<long>(time_us % 1'000'000 * 1'000)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

DeviceResult<void> LoopbackTransport::open() {
  if (model_->unplugged())
    return device_failure(DeviceFault::not_found, "simulated: unplugged", "plug it in again");
  open_ = true;
  asked_us_ = now_us();
  return {};
}

void LoopbackTransport::close() noexcept {
  open_ = false;
  size_ = 0;
}

DeviceResult<void> LoopbackTransport::set_mode(LineMode mode) {
  size_ = 0;
  model_->set_baud(baud_of(mode));
  if (mode != LineMode::running) model_->set_dtr(false);
  if (mode == LineMode::greeting) model_->set_dtr(true);
  return {};
}

WireStatus LoopbackTransport::write(std::span<const std::uint8_t> bytes) noexcept {
  if (!open_) return WireStatus::failed;
  const std::int64_t now = now_us();
  const bool held = hold_model();
  const Answer answer = model_->receive(bytes, 1e-6 * static_cast<double>(now - asked_us_));
  release_model(held);
  asked_us_ = now;
  if (model_->unplugged()) return WireStatus::unplugged;
  if (size_ == queue_.size()) return WireStatus::busy;
  if (answer.size > 0) queue_[(first_ + size_++) % queue_.size()] = {now + answer_us_, answer, 0};
  return WireStatus::ok;
}

Received LoopbackTransport::read(std::span<std::uint8_t> bytes, std::int64_t wait_us) noexcept {
  const std::int64_t end_us = now_us() + wait_us;
  if (!open_) return {0, now_us(), WireStatus::failed};
  if (!model_->unplugged()) wait_until(size_ == 0 ? end_us : std::min(end_us, first().ready_us));
  Received received{0, now_us(), model_->unplugged() ? WireStatus::unplugged : WireStatus::ok};
  const std::int64_t now = received.time_us;
  while (size_ > 0 && first().ready_us <= now) {
    // The arrival time, independent of the time of reading.
    received.time_us = first().ready_us;
    const auto next = first().answer.span().subspan(first().taken);
    const std::size_t taken = std::min(next.size(), bytes.size() - received.size);
    std::copy_n(next.begin(), taken, bytes.begin() + static_cast<long>(received.size));
    received.size += taken;
    first().taken += taken;
    if (taken < next.size()) break;
    ++first_;
    --size_;
  }
  return received;
}

/// Serializes packets, as a real wire does. A signal handler that interrupted its own thread in the
/// model would wait without end, so it continues after a while.
bool LoopbackTransport::hold_model() noexcept {
  for (int looks = 0; looks < kPatience; ++looks)
    if (!model_held_.exchange(true, std::memory_order_acquire)) return true;
  return false;
}

void LoopbackTransport::release_model(bool held) noexcept {
  if (held) model_held_.store(false, std::memory_order_release);
}

void LoopbackTransport::write_last(std::span<const std::uint8_t> bytes) noexcept {
  if (!open_) return;
  const bool held = hold_model();
  model_->receive_last(bytes);
  release_model(held);
}

}  // namespace clay::falcon::inline sim
