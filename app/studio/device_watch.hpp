#pragma once
// Looks for an arm or a controller while the window runs, and opens one that appears. Opening may
// take seconds, so a thread of its own does it.

#include "claystack/core/result.hpp"
#include "claystack/falcon/device.hpp"
#include "claystack/falcon/falcon_device.hpp"
#include "core/worker.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace clay::studio {

/// One look: a device, open; null where none is plugged in; or why the one that is cannot be used.
using LookForDevice = std::function<Result<std::unique_ptr<falcon::HapticDevice>>()>;

/// `which` as device_choice has it: "auto" waits for whatever is plugged in, any other is tried
/// until it opens.
[[nodiscard]] LookForDevice look_for(std::string which, falcon::FalconSettings settings);

class DeviceWatch {
 public:
  explicit DeviceWatch(LookForDevice look,
                       std::chrono::milliseconds between = std::chrono::seconds(1));
  DeviceWatch(const DeviceWatch&) = delete;
  DeviceWatch& operator=(const DeviceWatch&) = delete;

  /// An open device that has appeared since, or null. It then stops looking, until `look_again`.
  [[nodiscard]] std::unique_ptr<falcon::HapticDevice> take();
  void look_again();
  /// Why what is there cannot be used, each reason once; empty: nothing new.
  [[nodiscard]] std::string take_problem();

 private:
  void look();

  LookForDevice look_for_;
  std::mutex mutex_;  // of the next three
  std::unique_ptr<falcon::HapticDevice> found_;
  std::string problem_, told_;
  bool looking_ = true;
  PeriodicWorker worker_;  // last: it uses all members above
};

}  // namespace clay::studio
