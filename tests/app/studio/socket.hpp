#pragma once
// What is plugged in, for the thread of a DeviceWatch.

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
    const auto opened = [this] {
      const std::lock_guard lock(mutex);
      return !device;
    };
    test::wait_until(opened, test::kDeadline, "the watch to open the device");
  }
  void send(const std::string& what) {
    const std::lock_guard lock(mutex);
    problem = what;
  }
  void wait_for_looks(int more) {
    const int before = looks;
    test::wait_until([&] { return looks >= before + more; }, test::kDeadline,
                     "the watch to look for a device");
  }
};

}  // namespace clay::studio
