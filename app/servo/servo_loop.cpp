#include "app/servo/servo_loop.hpp"

#include "app/servo/servo_check.hpp"
#include "claystack/engine/files.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace clay::servo {
namespace {

using falcon::DeviceState;

constexpr std::int64_t kNsPerUs = 1000;
// Interval of the profiles for a window, about sixty per second.
constexpr std::uint64_t kTicksToProfile = 16;

std::int64_t period_ns(double rate_hz) { return std::llround(1e9 / rate_hz); }

std::int64_t clay_period_us(const LiveSettings& settings) {
  return settings.clay_rate_hz > 0.0 ? std::llround(1e6 / settings.clay_rate_hz) : 0;
}

}  // namespace

StepReport LiveClay::meet(const Pose& measured) noexcept {
  const Pose pose = quantized(measured);
  if (pose.time_us <= last_us_) return {.flags = kRefused};
  if (pose.time_us < due_us_) return wheel_.probe(pose);
  const StepReport report = wheel_.step(pose);
  if ((report.flags & kRefused) != 0) return report;
  last_us_ = pose.time_us;
  // Missed periods are not repeated.
  due_us_ = std::max(due_us_ + period_us_, pose.time_us + period_us_ / 2);
  ++poses_;
  if (recorder_ != nullptr) (void)recorder_->take(pose, works(wheel_.plan().mode, report.flags));
  return report;
}

Result<ServoLoop> ServoLoop::build(const LoopParts& parts, const LiveSettings& settings) {
  if (auto checked = check(settings); !checked) return tl::make_unexpected(checked.error());
  const auto mapping = Mapping::build(settings.mapping);
  if (!mapping) return tl::make_unexpected(mapping.error());
  falcon::GuardSettings guard_settings = settings.guard;
  guard_settings.period_s = 1.0 / settings.rate_hz;
  auto guard = falcon::ForceGuard::build(guard_settings);
  if (!guard) return tl::make_unexpected(falcon::error_of(guard.error()));
  const falcon::PassivitySettings passivity{.loop = loop_of(settings),
                                            .step_mm = settings.encoder_step_mm};
  auto controller = falcon::PassivityController::build(passivity);
  if (!controller) return tl::make_unexpected(falcon::error_of(controller.error()));
  return ServoLoop(parts, settings, *mapping, std::move(*guard), passivity, std::move(*controller));
}

ServoLoop::ServoLoop(const LoopParts& parts, const LiveSettings& settings, const Mapping& mapping,
                     falcon::ForceGuard guard, const falcon::PassivitySettings& passivity,
                     falcon::PassivityController controller)
    : parts_(parts),
      seconds_(settings.seconds),
      patience_s_(std::max(settings.patience_s, settings.seconds)),
      mapping_(mapping),
      controls_(settings.buttons, (parts.wheel.plan().stages & kPinch) != 0, settings.gap_mm),
      guard_(std::move(guard)),
      passivity_(passivity),
      hand_(std::move(controller)),
      clay_(parts.wheel, parts.recorder, clay_period_us(settings)),
      pacer_(period_ns(settings.rate_hz)) {}

void ServoLoop::start() noexcept {
  started_ns_ = last_begun_ns_ = parts_.clock.now_ns();
  pacer_.start(last_begun_ns_);
  // Only the user ends a pause or the safe state of an unstable force, not a reopened device.
  if (!falcon::needs_rearm(guarded_.cause)) guard_.rearm();
  count_delay();
  wanted_ = {};
  status_.ending = Ending::none;
}

/// Begins a new energy balance, with the delay of the device as it was opened last.
void ServoLoop::count_delay() noexcept {
  const falcon::DeviceInfo& device = parts_.device.info();
  falcon::PassivitySettings settings = passivity_;
  settings.loop = with_delay_of(device, passivity_.loop);
  const bool late = settings.loop.delay_ticks > passivity_.loop.delay_ticks;
  status_.answer_ms = late ? 1e-3 * static_cast<double>(device.answer_us) : 0.0;
  // Settings that `build` has accepted, with a delay within its range.
  if (auto controller = falcon::PassivityController::build(settings))
    hand_ = HandForce(std::move(*controller));
}

Ending ServoLoop::tick(falcon::ForceGate& gate, Commands& commands, LiveView& view,
                       std::atomic<std::int64_t>& heartbeat_us) noexcept {
  const std::int64_t late_ns = pacer_.wait(parts_.clock);
  const falcon::DeviceSample sample = parts_.device.read(pacer_.patience_us(parts_.clock.now_ns()));
  const std::int64_t begun_ns = parts_.clock.now_ns(), now_us = begun_ns / kNsPerUs;
  pacer_.sampled(begun_ns);
  heartbeat_us.store(now_us, std::memory_order_release);

  apply(sample, now_us, commands);
  status_.clutched = controls_.clutched();
  status_.paused = controls_.paused();
  follow(sample, now_us);
  send(gate);
  hand_.displayed(guarded_.force_n);

  keep_time(late_ns, begun_ns, sample);
  heartbeat_us.store(parts_.clock.now_us(), std::memory_order_release);
  status_.device = sample.state;
  status_.ending = ending(gate);
  publish(view, late_ns);
  return status_.ending;
}

/// Applies buttons and commands. While the clutch is held, the hand moves and the tool stays.
void ServoLoop::apply(const falcon::DeviceSample& sample, std::int64_t now_us,
                      Commands& commands) noexcept {
  const bool ready = sample.state == DeviceState::ready;
  controls_.update(now_us, ready ? sample.buttons : 0u, commands,
                   ready ? sample.grip_mm : std::nullopt);
  const bool was_held = held_, was_clutched = status_.clutched;
  held_ = controls_.clutched() || controls_.paused();
  const bool unclutched = was_clutched && !controls_.clutched();
  // Later, at an accepted sample: this one may be stale, or of a device that is not ready.
  recentre_ = recentre_ || unclutched;
  zeroed_ = controls_.zero() || (zeroed_ && !unclutched && !controls_.rearm());
  if (zeroed_ || (held_ && !was_held)) return guard_.pause();
  if (!held_ && (was_held || controls_.rearm())) {
    guard_.rearm();
    hand_.reset();
  }
}

/// Moves the tool to the accepted position of the hand and computes the force of the contact.
void ServoLoop::follow(const falcon::DeviceSample& sample, std::int64_t now_us) noexcept {
  const falcon::Admission admission = guard_.admit(
      now_us,
      {sample.time_us, sample.position_mm, sample.fresh, sample.state == DeviceState::ready});
  wanted_.clay_time_us = now_us;
  if (thrown_) status_.time_s = 1e-6 * static_cast<double>(now_us - first_us_);
  if (held_) {
    wanted_ = {.force_n = {}, .clay_time_us = now_us};
    status_.contact = false;
    status_.clay_n = {};
    return;
  }
  if (!admission.may_deform) return;  // keep the last force; the guard fades it out
  // Before the first accepted sample the tool has no position.
  if (recentre_ && thrown_) mapping_.recentre(sample.position_mm, tool_mm_);
  recentre_ = false;
  if (!thrown_) first_us_ = sample.time_us;
  thrown_ = true;
  tool_mm_ = mapping_.to_clay(sample.position_mm);
  const StepReport report =
      clay_.meet({sample.time_us - first_us_, tool_mm_, controls_.trim(), controls_.gap_mm()});
  status_.contact = (report.flags & kContact) != 0;
  status_.clay_n = report.force_n();
  status_.ring_limit = status_.ring_limit || (report.flags & kRingLimit) != 0;
  if (!parts_.device.info().can_push) return;
  const HandForce::Wanted hand = hand_.answer(now_us, sample.position_mm, mapping_, report);
  wanted_.force_n = hand.force_n;
  wanted_.passive = hand.passive;
  wanted_.contact_n = hand.contact_n;
}

/// The gate decides about the force: the watchdog may have shut it temporarily, a signal
/// permanently. A gate shut after it was opened here refuses this tick's force, which is older than
/// the watchdog's zero.
void ServoLoop::send(falcon::ForceGate& gate) noexcept {
  if (gate.is_shut() && gate.open()) guard_.was_zeroed();
  const std::int64_t now_us = parts_.clock.now_us();
  guarded_ = guard_.force(now_us, wanted_);
  count_events();
  if (!gate.enter()) {
    guard_.was_zeroed();
    guarded_.force_n = {};
    return;
  }
  parts_.device.write(guarded_.force_n);
  if (gate.leave()) return;
  parts_.device.zero();
  guard_.was_zeroed();
  guarded_.force_n = {};
}

/// Counts events when they begin, not while they last.
void ServoLoop::count_events() noexcept {
  const std::uint32_t came = guarded_.flags & ~flags_before_;
  for (std::size_t bit = 0; bit < GuardEvents::kFlags; ++bit)
    events_.flags[bit] += (came >> bit) & 1u;
  flags_before_ = guarded_.flags;
  if (guarded_.cause != status_.cause) ++events_.safe[static_cast<std::size_t>(guarded_.cause)];
  if (hand_.state() != falcon::PassivityState::watching) ++events_.damped;
}

void ServoLoop::keep_time(std::int64_t late_ns, std::int64_t begun_ns,
                          const falcon::DeviceSample& sample) noexcept {
  const std::int64_t sent_ns = parts_.clock.now_ns();
  timing_.lateness.add(late_ns);
  timing_.oversleep.add(pacer_.overslept_ns());
  if (timing_.ticks > 0) timing_.period.add(begun_ns - last_begun_ns_);
  timing_.work.add(sent_ns - begun_ns);
  if (sample.fresh) timing_.age.add(sent_ns - kNsPerUs * sample.time_us);
  timing_.stale += sample.fresh ? 0u : 1u;
  timing_.missed += late_ns >= pacer_.period_ns() ? 1u : 0u;
  ++timing_.ticks;
  last_begun_ns_ = begun_ns;
  if (parts_.trace == nullptr) return;
  const auto us = [](std::int64_t ns) { return 1e-3f * static_cast<float>(ns); };
  parts_.trace->add({begun_ns, static_cast<float>(glm::length(status_.clay_n)),
                     static_cast<float>(glm::length(guarded_.force_n)), us(late_ns),
                     us(sent_ns - begun_ns), late_ns >= pacer_.period_ns()});
}

Ending ServoLoop::ending(const falcon::ForceGate& gate) const noexcept {
  if (controls_.stopped() || gate.is_shut_for_good()) return Ending::stopped;
  if (!falcon::is_open(status_.device)) return Ending::device_lost;
  if (clay_.wheel().collapsed()) return Ending::collapsed;
  if (time_is_up()) return Ending::time_up;
  return Ending::none;
}

bool ServoLoop::time_is_up() const noexcept {
  if (seconds_ == 0.0) return false;
  if (thrown_) return status_.time_s >= seconds_;
  return 1e-9 * static_cast<double>(last_begun_ns_ - started_ns_) >= patience_s_;
}

void ServoLoop::publish(LiveView& view, std::int64_t late_ns) noexcept {
  const Wheel& wheel = clay_.wheel();
  status_.guard = guarded_.state;
  status_.cause = guarded_.cause;
  status_.passivity = hand_.state();
  status_.slow_hz = hand_.slow_rate_hz().value_or(0.0);
  status_.tool_mm = tool_mm_;
  status_.gap_mm = controls_.gap_mm();
  status_.force_n = guarded_.force_n;
  status_.force_gain = guarded_.gain;
  status_.volume_error = static_cast<double>(wheel.ledger().volume_error(wheel.stack().volume()));
  status_.imbalance = static_cast<double>(wheel.ledger().imbalance(wheel.stack().volume()));
  const double mm3 = wheel.stack().mm3_per_quantum();
  status_.stack_mm3 = wheel.stack().volume_mm3();
  status_.trimmed_mm3 = mm3 * static_cast<double>(wheel.ledger().trimmed);
  status_.outside_mm3 = mm3 * static_cast<double>(wheel.ledger().outside);
  status_.height_mm = wheel.stack().height_mm();
  status_.ticks = timing_.ticks;
  status_.poses = clay_.poses();
  status_.missed = timing_.missed;
  status_.late_ns = late_ns;
  view.status.write(status_);
  if (timing_.ticks % kTicksToProfile != 1 && status_.ending == Ending::none) return;
  show(wheel.stack(), status_.time_s, view.profile.draft());
  view.profile.publish();
}

}  // namespace clay::servo
