// servo_soak [FRAMES [SEED]]: throws on the emulated Falcon with random faults of the wire and
// random commands, a million frames by default, and checks each tick against bounds that follow
// from the faults alone. The clock is virtual, so a second takes milliseconds. Prints the events
// and the growth of the memory of the process; exit status 1 if a bound was broken or memory grew.

#include "tests/app/servo/live_bench.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>

namespace {

using namespace clay;
using namespace clay::servo;
using falcon::WireFault;

constexpr double kLimitN = 5.0;           // GuardSettings::force_limit_n
constexpr double kRiseN = 0.5 + 1e-9;     // 500 N/s, for a period of 1 ms
constexpr double kMotorStepN = 0.05;      // motors take whole counts
constexpr std::int64_t kZeroUs = 10'000;  // after the last frame
constexpr int kThrowFrames = 20'000;      // frames on one lump
constexpr int kQuietFrames = 4'000;       // without faults at its end: time to ramp up again

constexpr std::array kFaults = {
    WireFault::lost_byte, WireFault::extra_byte,  WireFault::half_frame,  WireFault::bad_nibble,
    WireFault::no_frame,  WireFault::stale_frame, WireFault::homing_lost, WireFault::unplugged};

struct Counts {
  std::uint64_t frames = 0, throws = 0, faults = 0, commands = 0, reopened = 0, forced = 0,
                poses = 0;
};

/// Rise of the force [N]: its distance from the nearest fraction of the last force.
double rise(const glm::dvec3& now, const glm::dvec3& before) {
  const double square = glm::dot(before, before);
  const double part = square > 0.0 ? std::clamp(glm::dot(now, before) / square, 0.0, 1.0) : 0.0;
  return glm::distance(now, part * before);
}

/// Presses and leaves the lump every two seconds, each time deeper, because the clay yields, while
/// the height wanders along the wall.
glm::dvec3 hand_at(double time_s) {
  const double depth = 3.0 * std::sin(3.14159 * time_s) + 0.2 * time_s;
  return {2.0 - depth, 15.0 * std::sin(0.7 * time_s), 0.0};
}

std::size_t allocated_bytes() { return mallinfo2().uordblks; }

class Soak {
 public:
  explicit Soak(unsigned seed) : random_(seed) {}

  /// One lump; false if a bound was broken.
  bool throw_once(int frames) {
    VirtualThrow live(rib_scene(), one_to_one(), [this](double time_s) { return hand(time_s); });
    before_n_ = glm::dvec3(0.0);
    fresh_us_ = live.clock.now_us();
    frames_seen_ = live.device.counters().frames;
    paused_ = zeroed_ = clutch_ = false;
    path_s_ = last_s_ = 0.0;
    ++counts.throws;
    for (int i = 0; i < frames; ++i) {
      if (i < frames - kQuietFrames) {
        disturb(live);
      } else if (i == frames - kQuietFrames) {
        release(live);
        engaged_ = false;
      }
      if (!tick(live)) return false;
    }
    counts.poses += live.status().poses;
    return expect(engaged_, live, "the force engaged again after the last fault");
  }

  Counts counts;

 private:
  /// Rests while the tool is held, or the clutch would leave it elsewhere, out of reach of the
  /// clay.
  glm::dvec3 hand(double time_s) {
    if (!held()) path_s_ += time_s - last_s_;
    last_s_ = time_s;
    return hand_at(path_s_);
  }

  int below(int bound) { return static_cast<int>(random_() % static_cast<unsigned>(bound)); }

  /// A fault in one of 50 frames, sometimes many at once, and a command in one of 200.
  void disturb(VirtualThrow& live) {
    if (below(50) == 0) {
      const int kind = below(40);  // the slow ones are rare
      const WireFault fault = kind < 2 ? kFaults[6 + static_cast<std::size_t>(kind)]
                                       : kFaults[static_cast<std::size_t>(below(6))];
      const int times = kind < 2 ? 1 : below(10) == 0 ? 1 + below(60) : 1;
      live.fault(fault, times);
      counts.faults += static_cast<std::uint64_t>(times);
    }
    if (below(200) == 0) command(live);
  }

  /// Each tick empties the queue, so it has room.
  static void send(VirtualThrow& live, CommandKind kind, double value = 0.0) {
    if (!live.commands.push({kind, value})) std::abort();
  }

  /// Holds the tool in one of three ways, or ends that.
  void command(VirtualThrow& live) {
    ++counts.commands;
    if (held()) return release(live);
    switch (below(3)) {
      case 0:
        paused_ = true;
        return send(live, CommandKind::pause, 1.0);
      case 1:
        zeroed_ = true;
        return send(live, CommandKind::zero);
      default:
        clutch_ = true;
        live.model->press(kFalconButtons.clutch);
    }
  }

  void release(VirtualThrow& live) {
    paused_ = zeroed_ = clutch_ = false;
    live.model->press(0);
    send(live, CommandKind::pause, 0.0);
    send(live, CommandKind::rearm);
  }

  [[nodiscard]] bool held() const { return paused_ || zeroed_ || clutch_; }

  bool tick(VirtualThrow& live) {
    ++counts.frames;
    const std::uint64_t poses = live.status().poses;
    const Ending ending = live.tick();
    if (ending == Ending::device_lost) return reopen(live);
    const LiveStatus& status = live.status();
    const glm::dvec3 force = status.force_n;
    const std::uint64_t frames = live.device.counters().frames;
    if (frames != frames_seen_) fresh_us_ = live.clock.now_us();
    const bool fresh = frames != frames_seen_;
    frames_seen_ = frames;
    const bool ready = status.device == falcon::DeviceState::ready;
    const bool silent = live.clock.now_us() - fresh_us_ > kZeroUs;
    const double n = glm::length(force);
    counts.forced += n > 0.05;
    engaged_ = engaged_ || status.guard == falcon::GuardState::engaged;
    const bool kept =
        expect(ending == Ending::none, live, "no end") &&
        expect(std::isfinite(n) && n <= kLimitN, live, "at most 5 N") &&
        expect(rise(force, before_n_) <= kRiseN, live, "a rise of at most 0.5 N in a tick") &&
        expect(n == 0.0 || ready, live, "no force from a device that is not ready") &&
        expect(n == 0.0 || !(paused_ || zeroed_ || status.clutched), live, "no force in a pause") &&
        expect(n == 0.0 || !silent, live, "no force 11 ms after the last frame") &&
        expect(status.poses == poses || fresh, live, "no clay moved without a frame") &&
        expect(status.volume_error == 0.0 && status.imbalance == 0.0, live,
               "the volume conserved") &&
        expect(glm::distance(live.model->force_n(), force) < kMotorStepN || !ready, live,
               "the guarded force at the motors");
    before_n_ = force;
    return kept;
  }

  /// As the program does with --wait: tries again until it opens. Faults may hit the opening, too.
  bool reopen(VirtualThrow& live) {
    constexpr int kAttempts = 100;
    ++counts.reopened;
    bool open = false;
    for (int i = 0; i < kAttempts && !open; ++i) {
      live.model->replug();
      open = live.device.open().has_value();
    }
    live.loop->start();
    before_n_ = glm::dvec3(0.0);
    fresh_us_ = live.clock.now_us();
    return expect(open, live, "a device that opens again");
  }

  bool expect(bool kept, const VirtualThrow& live, const char* what) const {
    if (kept) return true;
    const LiveStatus& s = live.status();
    fmt::print(stderr,
               "frame {} (throw {}, tick {}): expected {}, found {:.3f} N, before {:.3f} N, guard "
               "{}, cause {}, device {}, ending {}, tool at ({:.2f}, {:.2f}) mm{}{}{}\n",
               counts.frames, counts.throws, s.ticks, what, glm::length(s.force_n),
               glm::length(before_n_), static_cast<int>(s.guard), static_cast<int>(s.cause),
               static_cast<int>(s.device), static_cast<int>(s.ending), s.tool_mm.x, s.tool_mm.y,
               s.contact ? ", in contact" : "", s.clutched ? ", clutched" : "",
               s.paused ? ", paused" : "");
    return false;
  }

  std::mt19937 random_;
  glm::dvec3 before_n_{0.0};
  std::int64_t fresh_us_ = 0;
  std::uint64_t frames_seen_ = 0;
  bool paused_ = false, zeroed_ = false, clutch_ = false, engaged_ = false;
  double path_s_ = 0.0, last_s_ = 0.0;
};

}  // namespace

int main(int argc, char** argv) {
  const long frames = argc > 1 ? std::strtol(argv[1], nullptr, 10) : 1'000'000;
  Soak soak(argc > 2 ? static_cast<unsigned>(std::strtoul(argv[2], nullptr, 10)) : 1);
  std::size_t first_bytes = 0;
  while (static_cast<long>(soak.counts.frames) < frames) {
    if (!soak.throw_once(kThrowFrames)) return 1;
    if (first_bytes == 0) first_bytes = allocated_bytes();
  }
  const std::size_t last_bytes = allocated_bytes();
  const Counts& c = soak.counts;
  fmt::print(
      "{} frames, {} throws, {} faults, {} commands, {} times reopened; {} poses, {} ticks with a "
      "force; {} bytes in use after the first throw, {} after the last\n",
      c.frames, c.throws, c.faults, c.commands, c.reopened, c.poses, c.forced, first_bytes,
      last_bytes);
  if (c.forced < c.frames / 50) {
    fmt::print(stderr, "expected a force in at least 2 % of the ticks\n");
    return 1;
  }
  // A throw that leaks leaves kilobytes; the allocator's own lists move by less.
  constexpr std::size_t kSlack = 4096;
  return last_bytes > first_bytes + kSlack ? 1 : 0;
}
