#pragma once
// Looks for an arm or a controller while the window runs, and opens it. Opening can take seconds,
// so it happens on a separate thread.

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

/// One attempt. Returns an open device, null if none is connected, or an error if a connected
/// device cannot be used.
using LookForDevice = std::function<Result<std::unique_ptr<falcon::HapticDevice>>()>;

/// `which` as in device_choice. "auto" waits for any connected device; any other choice is tried
/// until it opens.
[[nodiscard]] LookForDevice look_for(std::string which, falcon::FalconSettings settings);

class DeviceWatch {
 public:
  explicit DeviceWatch(LookForDevice look,
                       std::chrono::milliseconds between = std::chrono::seconds(1));
  DeviceWatch(const DeviceWatch&) = delete;
  DeviceWatch& operator=(const DeviceWatch&) = delete;

  /// A device that was opened since the last call, or null. The search then stops until
  /// `look_again`.
  [[nodiscard]] std::unique_ptr<falcon::HapticDevice> take();
  void look_again();
  /// Reason why a connected device cannot be used. Each problem is returned once; empty: no new
  /// problem.
  [[nodiscard]] std::string take_problem();

 private:
  void look();

  LookForDevice look_for_;
  std::mutex mutex_;  // protects the next three members
  std::unique_ptr<falcon::HapticDevice> found_;
  std::string problem_, reported_;
  bool looking_ = true;
  PeriodicWorker worker_;  // last: it uses all members above
};

}  // namespace clay::studio
