#pragma once
// The servo's data for other threads: complete values, without a lock.

#include "claystack/engine/clay.hpp"
#include "claystack/servo/servo.hpp"
#include "core/snapshot.hpp"

namespace clay::servo {

/// Fills `profile`. Time and memory are bounded for any size of the stack.
void show(const ClayStack& stack, double time_s, LiveProfile& profile) noexcept;

/// One reader for each.
struct LiveView {
  Snapshot<LiveStatus> status;
  Snapshot<LiveProfile> profile;
};

}  // namespace clay::servo
