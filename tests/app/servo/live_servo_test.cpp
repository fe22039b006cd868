// Servo, watchdog and readers as threads. Nothing is timed, because the machine may be busy.

#include "app/servo/servo.hpp"
#include "app/servo/signals.hpp"
#include "tests/app/servo/live_bench.hpp"
#include "tests/app/servo/scripted_device.hpp"
#include "tests/support/wait_until.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <new>
#include <stdexcept>
#include <thread>

namespace clay::servo {
namespace {

template <class Condition>
void wait_until(Condition condition, const std::string& what) {
  test::wait_until(condition, test::kDeadline, what);
}

/// The force ramps up in 0.1 s.
LiveSettings quick() {
  LiveSettings settings = one_to_one();
  settings.guard.ramp_s = 0.1;
  // Late ticks of a busy machine should not matter here.
  settings.guard.safe_rest_s = 0.01;
  return settings;
}

/// A servo that runs on a scripted device.
struct Threads {
  explicit Threads(WireLog& wire)
      : log(wire), device(wire), loop(ServoLoop::build(loop_parts(), quick()).value()) {
    servo.start();
  }
  /// A hanging servo would not end.
  ~Threads() { log.hang = false; }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  LoopParts loop_parts() { return {wheel, device, clock, nullptr}; }
  void wait_for_force() {
    wait_until([&] { return log.last_force_n > 0.0; }, "a force");
  }
  void wait_for_writes(std::uint64_t more) {
    wait_until([&, end = log.writes + more] { return log.writes > end; }, "forces to be written");
  }
  Ending end() {
    wait_until([&] { return !servo.running(); }, "the servo's end");
    return servo.join();
  }
  Ending stop() { return servo.command({CommandKind::stop, 0.0}) ? end() : Ending::none; }

  WireLog& log;
  ScriptedDevice device;
  Wheel wheel = Wheel::build(rib_scene()).value();
  MonotonicClock clock;
  ServoLoop loop;
  Servo servo{loop_parts(), loop, Pace::thread};
};

TEST(Servo, EndsByCommandWithAFinalStop) {
  WireLog log;
  Threads threads(log);
  threads.wait_for_writes(50);
  EXPECT_EQ(threads.stop(), Ending::stopped);
  EXPECT_FALSE(threads.servo.running());
  EXPECT_EQ(log.stops, 1u);
  EXPECT_EQ(log.last_force_n, 0.0);
  EXPECT_EQ(threads.loop.timing().ticks, log.writes);
  EXPECT_EQ(threads.loop.timing().lateness.count(), threads.loop.timing().ticks);
}

TEST(Servo, DestructorEndsTheForce) {
  WireLog log;
  {
    Threads threads(log);
    threads.wait_for_force();
  }
  EXPECT_EQ(log.stops, 1u);
  EXPECT_EQ(log.last_force_n, 0.0);
}

TEST(Servo, WatchdogEndsTheForceDuringAHang) {
  WireLog log;
  Threads threads(log);
  threads.wait_for_force();
  const std::uint64_t zeros = log.zeros;
  log.hang = true;
  wait_until([&] { return log.zeros > zeros; }, "the watchdog to end the force");
  EXPECT_EQ(log.last_force_n, 0.0) << "a force was written during the hang";
  log.hang = false;
  threads.wait_for_writes(20);
  EXPECT_EQ(threads.stop(), Ending::stopped);
  EXPECT_GE(threads.loop.events().watchdog, 1u);
}

/// A clock that stands still, so that a servo that ticks is never late, even on a busy machine.
/// Counts the readings of the watchdog, which sleeps for longer than a tick.
class StoppedClock final : public Clock {
 public:
  std::int64_t now_ns() noexcept override { return kNowNs; }
  void sleep_until_ns(std::int64_t time_ns) noexcept override {
    if (time_ns > kNowNs + 5'000'000) ++looks;
    std::this_thread::yield();
  }
  std::atomic<std::uint64_t> looks{0};

 private:
  static constexpr std::int64_t kNowNs = 3'600'000'000'000;
};

TEST(Servo, WatchdogLeavesATickingServoAlone) {
  WireLog log;
  ScriptedDevice device(log);
  Wheel wheel = Wheel::build(rib_scene()).value();
  StoppedClock clock;
  const LoopParts parts{wheel, device, clock, nullptr};
  ServoLoop loop = ServoLoop::build(parts, quick()).value();
  Servo servo{parts, loop, Pace::thread};
  servo.start();
  wait_until([&] { return log.writes > 50; }, "forces to be written");
  wait_until([&, end = clock.looks + 50] { return clock.looks > end; }, "the watchdog to look");
  ASSERT_TRUE(servo.command({CommandKind::stop, 0.0}));
  wait_until([&] { return !servo.running(); }, "the servo's end");
  EXPECT_EQ(servo.join(), Ending::stopped);
  EXPECT_EQ(loop.events().watchdog, 0u);
}

TEST(Servo, ReadersGetCompleteValuesInOrder) {
  WireLog log;
  Threads threads(log);
  std::uint64_t ticks = 0;
  double time_s = 0.0;
  const auto read = [&] {
    const LiveStatus& status = threads.servo.view().status.newest();
    ASSERT_GE(status.ticks, ticks);
    ASSERT_GE(status.time_s, time_s);
    ASSERT_EQ(status.volume_error, 0.0);
    ticks = status.ticks;
    time_s = status.time_s;
    const LiveProfile& profile = threads.servo.view().profile.newest();
    for (std::size_t row = 0; row < profile.size; ++row)
      ASSERT_GT(profile.rows[row].outer_mm, profile.rows[row].inner_mm);
  };
  const auto read_often = [&] {
    for (int i = 0; i < 1000; ++i) read();
    return ticks >= 300 || testing::Test::HasFailure();
  };
  wait_until(read_often, "300 ticks");
  EXPECT_EQ(threads.stop(), Ending::stopped);
}

TEST(Servo, UnpluggingEndsTheServo) {
  WireLog log;
  Threads threads(log);
  threads.wait_for_force();
  log.gone = true;
  EXPECT_EQ(threads.end(), Ending::device_lost);
  EXPECT_EQ(log.last_force_n, 0.0);
  // After a reconnection: another servo with the same loop and wheel.
  log.gone = false;
  const std::uint64_t poses = threads.loop.status().poses;
  Servo again(threads.loop_parts(), threads.loop, Pace::thread);
  again.start();
  wait_until([&] { return again.view().status.newest().poses > poses + 20; }, "poses");
  ASSERT_TRUE(again.command({CommandKind::stop, 0.0}));
  wait_until([&] { return !again.running(); }, "the other servo's end");
  EXPECT_EQ(again.join(), Ending::stopped);
}

TEST(Servo, ReportsMissingRealTime) {
  Realtime realtime;
  std::thread([&] { realtime = request_realtime(kServoPriority); }).join();
  EXPECT_EQ(realtime.missing.empty(),
            realtime.fifo && realtime.memory_locked && realtime.exact_sleep)
      << realtime.missing;
  EXPECT_EQ(realtime.missing.find("SCHED_FIFO") == std::string::npos, realtime.fifo);
  munlockall();
}

TEST(Servo, SignalHandlerWritesZeroWhileTheServoHangs) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    WireLog log;
    const ForceSignals signals;
    Threads threads(log);
    threads.wait_for_force();
    log.hang = true;
    EXPECT_EQ(log.stops, 0u);
    raise(signal);
    // raise() returns after the handler, except under ThreadSanitizer, which defers it to a sleep.
    wait_until([&] { return log.stops > 0; }, "the handler to stop the device");
    EXPECT_EQ(log.stops, 1u) << "only the handler stops the device while the servo hangs";
    EXPECT_EQ(ForceSignals::asked_to_stop(), signal);
    log.hang = false;
    (void)threads.servo.command({CommandKind::stop, 0.0});
    EXPECT_EQ(threads.end(), Ending::stopped);
    EXPECT_EQ(log.last_force_n, 0.0);
  }
}

TEST(Servo, IgnoresJobControlUnderForce) {
  WireLog log;
  const ForceSignals signals;
  Threads threads(log);
  threads.wait_for_force();
  for (const int signal : {SIGTSTP, SIGTTIN, SIGTTOU}) kill(getpid(), signal);
  threads.wait_for_writes(5);
  EXPECT_EQ(threads.stop(), Ending::stopped);
}

TEST(Servo, HandlesSignalsThatWereIgnored) {
  for (const int signal : {SIGHUP, SIGINT}) {
    const auto before = std::signal(signal, SIG_IGN);
    {
      const ForceSignals signals;
      raise(signal);
      wait_until([] { return ForceSignals::asked_to_stop() != 0; }, "the handler");
      EXPECT_EQ(ForceSignals::asked_to_stop(), signal);
    }
    EXPECT_EQ(std::signal(signal, before), SIG_IGN);
  }
}

TEST(Servo, RefusesToStartBesideAnother) {
  WireLog log, other_log;
  Threads threads(log);
  ScriptedDevice device(other_log);
  Wheel wheel = Wheel::build(rib_scene()).value();
  MonotonicClock clock;
  const LoopParts parts{wheel, device, clock, nullptr};
  ServoLoop loop = ServoLoop::build(parts, quick()).value();
  {
    Servo second(parts, loop, Pace::thread);
    const auto started = second.start();
    ASSERT_FALSE(started);
    EXPECT_NE(started.error().message.find("another one is running"), std::string::npos);
    EXPECT_FALSE(second.running());
  }
  threads.wait_for_force();  // the signal handlers still end the force of the first
  emergency_stop().fire();
  EXPECT_GE(log.stops, 1u);
  EXPECT_EQ(threads.end(), Ending::stopped);
  Servo second(parts, loop, Pace::thread);
  EXPECT_TRUE(second.start());
  EXPECT_EQ(other_log.max_force_n, 0.0);
}

/// Runs a throw in a child process and ends it by an action.
class LastPacket : public testing::Test {
 protected:
  LastPacket() {
    void* shared =
        mmap(nullptr, sizeof(WireLog), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    log_ = new (shared) WireLog;
  }
  ~LastPacket() override { munmap(log_, sizeof(WireLog)); }

  /// The exit status, or 128 + the signal.
  template <class Action>
  int end_by(Action action) {
    const pid_t child = fork();
    if (child == 0) {
      const rlimit no_core{0, 0};
      setrlimit(RLIMIT_CORE, &no_core);
      // A child that hangs ends with SIGALRM.
      alarm(static_cast<unsigned>(test::kDeadline.count()));
      const ForceSignals signals;
      Threads threads(*log_);
      threads.wait_for_force();
      action();
      threads.servo.join();
      _exit(ForceSignals::asked_to_stop());
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }

  /// The force was non-zero before and is zero at the end.
  void expect_no_force() {
    EXPECT_GT(log_->max_force_n, 0.0);
    EXPECT_EQ(log_->last_force_n, 0.0);
    EXPECT_GE(log_->stops, 1u);
  }

  WireLog* log_ = nullptr;
};

TEST_F(LastPacket, IsZeroAfterAStopSignal) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    EXPECT_EQ(end_by([=] { kill(getpid(), signal); }), signal);
    expect_no_force();
    new (log_) WireLog;
  }
}

TEST_F(LastPacket, IsZeroAfterAFatalSignal) {
  // Every signal that ends a process, except SIGKILL and the stop signals above; of the real-time
  // signals the first and the last.
  for (const int signal :
       {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGQUIT, SIGTRAP, SIGSYS, SIGXCPU, SIGALRM,
        SIGVTALRM, SIGPROF, SIGUSR1, SIGUSR2, SIGSTKFLT, SIGPOLL, SIGPWR, SIGRTMIN, SIGRTMAX}) {
    EXPECT_EQ(end_by([=] { kill(getpid(), signal); }), 128 + signal);
    expect_no_force();
    new (log_) WireLog;
  }
}

TEST_F(LastPacket, IsZeroAfterAnUncaughtException) {
  const int status = end_by([] {
    std::set_terminate([] { std::abort(); });  // without its message
    std::thread([] { throw std::runtime_error("uncaught"); }).join();
  });
  EXPECT_EQ(status, 128 + SIGABRT);
  expect_no_force();
}

}  // namespace
}  // namespace clay::servo
