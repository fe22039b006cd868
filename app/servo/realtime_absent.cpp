// Replaces realtime.cpp where a program has one thread and no real-time scheduler: in a web page.

#include "app/servo/servo.hpp"

namespace clay::servo {

Realtime request_realtime(int) {
  Realtime realtime;
  realtime.missing = "no real-time scheduling on this system";
  return realtime;
}

void unlock_memory() noexcept {}

}  // namespace clay::servo
