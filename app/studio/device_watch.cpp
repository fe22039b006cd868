#include "app/studio/device_watch.hpp"

#include "app/cli/device_choice.hpp"

#ifdef CLAYSTACK_USB
#include "claystack/falcon/usb.hpp"
#endif

#include <utility>

namespace clay::studio {
namespace {

/// Listing devices is cheap; trying to open a device that is not connected would report an error
/// every second.
bool anything_plugged_in() {
#ifdef CLAYSTACK_USB
  const auto listed = falcon::list_devices();
  return listed && !listed->empty();
#else
  return false;
#endif
}

}  // namespace

LookForDevice look_for(std::string which, falcon::FalconSettings settings) {
  return [which = std::move(which),
          settings = std::move(settings)]() -> Result<std::unique_ptr<falcon::HapticDevice>> {
    if (which == "auto" && !anything_plugged_in()) return nullptr;
    return cli::open_chosen(which, settings, falcon::simulated_and_loaded());
  };
}

DeviceWatch::DeviceWatch(LookForDevice look, std::chrono::milliseconds between)
    : look_for_(std::move(look)),
      worker_(
          [this](bool last) {
            if (!last) this->look();
          },
          between) {}

std::unique_ptr<falcon::HapticDevice> DeviceWatch::take() {
  const std::lock_guard lock(mutex_);
  return std::move(found_);
}

void DeviceWatch::look_again() {
  const std::lock_guard lock(mutex_);
  looking_ = true;
  reported_.clear();
}

std::string DeviceWatch::take_problem() {
  const std::lock_guard lock(mutex_);
  return std::exchange(problem_, {});
}

void DeviceWatch::look() {
  {
    const std::lock_guard lock(mutex_);
    if (!looking_) return;
  }
  auto device = look_for_();
  const std::lock_guard lock(mutex_);
  if (!device) {
    if (device.error().message != reported_) problem_ = reported_ = device.error().message;
  } else if (*device) {
    found_ = std::move(*device);
    looking_ = false;
  } else {
    reported_.clear();  // report the problems of the next device again
  }
}

}  // namespace clay::studio
