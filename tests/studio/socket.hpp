#pragma once
// What is plugged in, for the thread of a DeviceWatch.

#include "studio/device_watch.hpp"

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace clay::studio {

using DevicePointer = std::unique_ptr<falcon::HapticDevice>;

struct Socket {
  std::mutex mutex;  // of what follows
  DevicePointer device;
  std::string problem;
  std::atomic<int> looks{0};

  LookForDevice look() {
    return [this]() -> Result<DevicePointer> {
      const std::lock_guard lock(mutex);
      ++looks;
      if (!problem.empty()) return failure(ErrorKind::device, std::string(problem));
      return std::move(device);
    };
  }
  void plug(DevicePointer arm) {
    const std::lock_guard lock(mutex);
    device = std::move(arm);
  }
  void wait_until_opened() {
    for (;; std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
      const std::lock_guard lock(mutex);
      if (!device) return;
    }
  }
  void say(const std::string& what) {
    const std::lock_guard lock(mutex);
    problem = what;
  }
  void wait_for_looks(int more) {
    const int before = looks;
    while (looks < before + more) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
};

}  // namespace clay::studio
