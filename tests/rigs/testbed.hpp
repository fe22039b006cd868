#pragma once
// An empty /sys and /dev for one test.

#include <umockdev.h>

namespace clay::rig {

class Testbed {
 public:
  Testbed() : testbed_(umockdev_testbed_new()) {}
  ~Testbed() { g_object_unref(testbed_); }
  Testbed(const Testbed&) = delete;
  Testbed& operator=(const Testbed&) = delete;
  [[nodiscard]] UMockdevTestbed* get() const { return testbed_; }

 private:
  UMockdevTestbed* testbed_;
};

}  // namespace clay::rig
