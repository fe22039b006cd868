#pragma once
// The connected device, as the thread of a DeviceWatch finds it.

#include "app/studio/device_watch.hpp"
#include "tests/support/wait_until.hpp"

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace clay::studio {

using DevicePointer = std::unique_ptr<falcon::HapticDevice>;

struct Socket {
  std::mutex mutex;  // guards device and problem
  DevicePointer device;
  std::string problem;
  std::atomic<int> searches{0};

  LookForDevice look() {
    return [this]() -> Result<DevicePointer> {
      const std::lock_guard lock(mutex);
      ++searches;
      if (!problem.empty()) return failure(ErrorKind::device, std::string(problem));
      return std::move(device);
    };
  }
  void plug(DevicePointer arm) {
    const std::lock_guard lock(mutex);
    device = std::move(arm);
  }
  void wait_until_opened() {
    const auto opened = [this] {
      const std::lock_guard lock(mutex);
      return !device;
    };
    test::wait_until(opened, test::kDeadline, "the watch to open the device");
  }
  void report(const std::string& what) {
    const std::lock_guard lock(mutex);
    problem = what;
  }
  void wait_for_searches(int more) {
    const int before = searches;
    test::wait_until([&] { return searches >= before + more; }, test::kDeadline,
                     "the watch to search for a device");
  }
};

}  // namespace clay::studio
