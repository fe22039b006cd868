#include "app/servo/recorder.hpp"
#include "app/servo/servo.hpp"
#include "app/servo/servo_check.hpp"
#include "app/servo/tick_trace.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/servo/servo.hpp"

#include <optional>
#include <utility>

namespace clay::servo {
namespace {

constexpr double kLowestRateHz = 400.0, kHighestRateHz = 4000.0;
constexpr double kLowestClayRateHz = 20.0;

/// `contact_of(plan, stiffness_gain)`.
template <class ContactOf>
Result<ServoContact> with_plan(const SceneSpec& scene, const LiveSettings& settings,
                               ContactOf contact_of) {
  const auto mapping = Mapping::build(settings.mapping);
  if (!mapping) return tl::make_unexpected(mapping.error());
  const auto plan = StepPlan::build(scene);
  if (!plan) return tl::make_unexpected(plan.error());
  return contact_of(*plan, mapping->stiffness_gain());
}

/// Null if nothing is to be recorded.
Result<std::unique_ptr<Recorder>> recorder_of(const ThrowParts& parts) {
  if (parts.sink != nullptr) return Recorder::create(*parts.sink);
  if (parts.session_path.empty()) return nullptr;
  const std::uint64_t hash = parts.scene_hash != 0 ? parts.scene_hash : hash_of(parts.scene);
  return Recorder::create(parts.session_path, parts.scene.name, hash);
}

}  // namespace

Result<void> check(const LiveSettings& settings) {
  const double lowest_clay = settings.clay_rate_hz == 0.0 ? 0.0 : kLowestClayRateHz;
  return check_range("rate_hz", settings.rate_hz, kLowestRateHz, kHighestRateHz)
      .and_then([&] {
        return check_range("clay_rate_hz", settings.clay_rate_hz, lowest_clay, settings.rate_hz);
      })
      .and_then([&] { return check_range("seconds", settings.seconds, 0.0, 1e6); })
      .and_then([&] { return check_range("patience_s", settings.patience_s, 0.0, 1e6); })
      .and_then([&] { return check_range("gap_mm", settings.gap_mm, 0.0, kWidestGapMm); })
      .and_then([&]() -> Result<void> {
        if (const auto arm = falcon::check(loop_of(settings)); !arm)
          return tl::make_unexpected(falcon::error_of(arm.error()));
        return {};
      });
}

Result<void> check_stiffness(const SceneSpec& scene, const LiveSettings& settings) {
  const auto checked = [&](const StepPlan& plan, double stiffness_gain) {
    return check_servo(scene, plan, loop_of(settings), stiffness_gain, settings.arm.rate_hz);
  };
  return with_plan(scene, settings, checked).map([](const ServoContact&) {});
}

Result<double> soften(SceneSpec& scene, const LiveSettings& settings) {
  const auto found = [&](const StepPlan& plan, double stiffness_gain) {
    return servo_contact(scene, plan, loop_of(settings), stiffness_gain);
  };
  return with_plan(scene, settings, found).map([&](const ServoContact& contact) {
    return soften(scene, contact);
  });
}

/// Declared so that the servo's thread ends before the loop that it runs, and the loop before the
/// recorder that it feeds.
struct LiveThrow::State {
  State(const ThrowParts& parts, TickTrace* ticks)
      : wheel(parts.wheel),
        device(parts.device),
        clock(parts.clock != nullptr ? *parts.clock : machine_clock),
        trace(ticks) {}
  [[nodiscard]] LoopParts loop_parts() noexcept {
    return {wheel, device, clock, recorder.get(), trace};
  }

  Wheel& wheel;
  falcon::HapticDevice& device;
  MonotonicClock machine_clock;
  Clock& clock;
  TickTrace* trace;
  std::unique_ptr<Recorder> recorder;
  std::optional<ServoLoop> loop;
  std::optional<Servo> servo;
};

Result<LiveThrow> LiveThrow::build(const ThrowParts& parts, const LiveSettings& settings) {
  return LiveMeasures::build(parts, settings, nullptr);
}

Result<LiveThrow> LiveMeasures::build(const ThrowParts& parts, const LiveSettings& settings,
                                      TickTrace* trace) {
  if (auto checked = check(settings); !checked) return tl::make_unexpected(checked.error());
  if (parts.device.info().can_push)
    if (auto fits = check_stiffness(parts.scene, settings); !fits)
      return tl::make_unexpected(fits.error());
  auto state = std::make_unique<LiveThrow::State>(parts, trace);
  if (auto recorder = recorder_of(parts))
    state->recorder = std::move(*recorder);
  else
    return tl::make_unexpected(recorder.error());
  auto loop = ServoLoop::build(state->loop_parts(), settings);
  if (!loop) return tl::make_unexpected(loop.error());
  state->loop.emplace(std::move(*loop));
  return LiveThrow(std::move(state));
}

LiveThrow::LiveThrow(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
LiveThrow::LiveThrow(LiveThrow&&) noexcept = default;
LiveThrow& LiveThrow::operator=(LiveThrow&&) noexcept = default;
LiveThrow::~LiveThrow() = default;

Result<void> LiveThrow::start(Pace pace) {
  state_->servo.reset();
  return state_->servo.emplace(state_->loop_parts(), *state_->loop, pace).start();
}

void LiveThrow::advance(std::int64_t until_ns) noexcept {
  if (state_->servo) state_->servo->advance(until_ns);
}

bool LiveThrow::command(const Command& command) noexcept {
  return state_->servo && state_->servo->command(command);
}

const LiveStatus& LiveThrow::status() noexcept {
  return running() ? state_->servo->view().status.newest() : state_->loop->status();
}

const LiveProfile& LiveThrow::profile() noexcept {
  static constexpr LiveProfile kNone;
  return state_->servo ? state_->servo->view().profile.newest() : kNone;
}

const LiveProfile* LiveThrow::new_profile() noexcept {
  if (!state_->servo || !state_->servo->view().profile.has_new()) return nullptr;
  return &state_->servo->view().profile.newest();
}

bool LiveThrow::running() const noexcept { return state_->servo && state_->servo->running(); }

Ending LiveThrow::join() { return state_->servo ? state_->servo->join() : Ending::none; }

Ending LiveThrow::stop() { return state_->servo ? state_->servo->stop() : Ending::none; }

const Realtime& LiveThrow::realtime() const noexcept {
  static const Realtime kNone;
  return state_->servo ? state_->servo->realtime() : kNone;
}

Result<void> LiveThrow::finish_recording() {
  if (!state_->recorder) return {};
  return state_->recorder->finish();
}

Recorded LiveThrow::recorded() const noexcept {
  if (!state_->recorder) return {};
  return {state_->recorder->taken(), state_->recorder->lost()};
}

const ServoTiming& LiveMeasures::timing(const LiveThrow& live) noexcept {
  return live.state_->loop->timing();
}

const GuardEvents& LiveMeasures::events(const LiveThrow& live) noexcept {
  return live.state_->loop->events();
}

void LiveThrow::end_force() noexcept { emergency_stop().fire(); }

}  // namespace clay::servo
