#pragma once
// Every wait of a test has a deadline, and reports the condition when it passes.

#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

namespace clay::test {

/// Far longer than any wait on a loaded machine, and shorter than CTest's limit for a test.
inline constexpr std::chrono::seconds kDeadline{120};

/// Polls until the condition holds. After the deadline it throws, and the test fails.
template <class Condition>
void wait_until(Condition condition, std::chrono::seconds deadline, const std::string& what) {
  const auto end = std::chrono::steady_clock::now() + deadline;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end)
      throw std::runtime_error("waited " + std::to_string(deadline.count()) + " s for " + what);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace clay::test
