#include "studio/device_watch.hpp"

#include "device_choice.hpp"

#ifdef CLAYSTACK_USB
#include "claystack/falcon/usb_devices.hpp"
#endif

#include <chrono>
#include <utility>

namespace clay::studio {
namespace {

constexpr auto kBetweenLooks = std::chrono::seconds(1);

/// Asking costs little; opening a device that nobody plugged in would say so every second.
bool anything_plugged_in() {
#ifdef CLAYSTACK_USB
  const auto listed = falcon::list_devices();
  return listed && !listed->empty();
#else
  return false;
#endif
}

}  // namespace

DeviceWatch::DeviceWatch(std::string which, falcon::FalconSettings settings)
    : which_(std::move(which)), settings_(std::move(settings)) {
  if (which_ != "none") thread_ = std::thread([this] { run(); });
}

DeviceWatch::~DeviceWatch() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

std::unique_ptr<falcon::HapticDevice> DeviceWatch::take() {
  const std::lock_guard lock(mutex_);
  return std::move(found_);
}

void DeviceWatch::look_again() {
  const std::lock_guard lock(mutex_);
  looking_ = true;
  told_.clear();
}

std::string DeviceWatch::take_problem() {
  const std::lock_guard lock(mutex_);
  return std::exchange(problem_, {});
}

void DeviceWatch::run() {
  std::unique_lock lock(mutex_);
  while (!closing_) {
    if (looking_) {
      lock.unlock();
      look();
      lock.lock();
    }
    wake_.wait_for(lock, kBetweenLooks, [this] { return closing_; });
  }
}

void DeviceWatch::look() {
  if (which_ == "auto" && !anything_plugged_in()) return;
  auto device = app::open_chosen(which_, settings_, falcon::simulated_and_loaded());
  const std::lock_guard lock(mutex_);
  if (device) {
    found_ = std::move(*device);
    looking_ = false;
  } else if (device.error().message != told_) {
    problem_ = told_ = device.error().message;
  }
}

}  // namespace clay::studio
