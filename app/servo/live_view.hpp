#pragma once
// What the servo shows of itself to other threads: whole values, without a lock.

#include "claystack/engine/clay.hpp"
#include "claystack/servo/servo.hpp"
#include "core/snapshot.hpp"

namespace clay::servo {

/// Fills `profile`. Work and memory are bounded, whatever the stack's size.
void show(const ClayStack& stack, double time_s, LiveProfile& profile) noexcept;

/// One reader each.
struct LiveView {
  Snapshot<LiveStatus> status;
  Snapshot<LiveProfile> profile;
};

}  // namespace clay::servo
