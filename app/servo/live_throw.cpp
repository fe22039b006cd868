#include "app/servo/recorder.hpp"
#include "app/servo/servo.hpp"
#include "app/servo/servo_check.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/servo/servo.hpp"

#include <optional>
#include <utility>

namespace clay::servo {
namespace {

constexpr double kLowestRateHz = 400.0, kHighestRateHz = 4000.0;
constexpr double kLowestClayRateHz = 20.0;

falcon::SampledLoop arm_of(const LiveSettings& settings) {
  falcon::SampledLoop arm = settings.arm;
  arm.rate_hz = settings.rate_hz;
  return arm;
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
      .and_then([&] { return check_range("gap_mm", settings.gap_mm, 0.0, kWidestGapMm); });
}

Result<double> soften(SceneSpec& scene, const LiveSettings& settings) {
  const auto mapping = Mapping::build(settings.mapping);
  if (!mapping) return tl::make_unexpected(mapping.error());
  const auto plan = StepPlan::build(scene);
  if (!plan) return tl::make_unexpected(plan.error());
  return servo_contact(scene, *plan, arm_of(settings), mapping->stiffness_gain())
      .map([&](const ServoContact& contact) { return soften(scene, contact); });
}

/// Declared so that the servo's thread ends before the loop that it runs, and the loop before the
/// recorder that it feeds.
struct LiveThrow::State {
  explicit State(const ThrowParts& parts) : wheel(parts.wheel), device(parts.device) {}
  [[nodiscard]] Bench bench() noexcept { return {wheel, device, clock, recorder.get()}; }

  Wheel& wheel;
  falcon::HapticDevice& device;
  MonotonicClock clock;
  std::unique_ptr<Recorder> recorder;
  std::optional<ServoLoop> loop;
  std::optional<Servo> servo;
};

Result<LiveThrow> LiveThrow::build(const ThrowParts& parts, const LiveSettings& settings) {
  if (auto checked = check(settings); !checked) return tl::make_unexpected(checked.error());
  const auto mapping = Mapping::build(settings.mapping);
  if (!mapping) return tl::make_unexpected(mapping.error());
  if (parts.device.info().can_push) {
    const auto fits =
        check_servo(parts.scene, parts.wheel.plan(), arm_of(settings), mapping->stiffness_gain());
    if (!fits) return tl::make_unexpected(fits.error());
  }
  auto state = std::make_unique<State>(parts);
  if (!parts.session_path.empty()) {
    auto recorder = Recorder::create(parts.session_path, parts.scene.name, hash_of(parts.scene));
    if (!recorder) return tl::make_unexpected(recorder.error());
    state->recorder = std::move(*recorder);
  }
  auto loop = ServoLoop::build(state->bench(), settings);
  if (!loop) return tl::make_unexpected(loop.error());
  state->loop.emplace(std::move(*loop));
  return LiveThrow(std::move(state));
}

LiveThrow::LiveThrow(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
LiveThrow::LiveThrow(LiveThrow&&) noexcept = default;
LiveThrow& LiveThrow::operator=(LiveThrow&&) noexcept = default;
LiveThrow::~LiveThrow() = default;

void LiveThrow::start(bool realtime) {
  state_->servo.reset();
  state_->servo.emplace(state_->bench(), *state_->loop, realtime).start();
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

bool LiveThrow::running() const noexcept { return state_->servo && state_->servo->running(); }

Ending LiveThrow::join() { return state_->servo ? state_->servo->join() : Ending::none; }

const Realtime& LiveThrow::realtime() const noexcept {
  static const Realtime kNone;
  return state_->servo ? state_->servo->realtime() : kNone;
}

Result<void> LiveThrow::finish_recording() {
  if (!state_->recorder) return {};
  if (auto finished = state_->recorder->finish(); !finished) return finished;
  if (state_->recorder->lost() == 0) return {};
  return failure(ErrorKind::io, "the disk was too slow: the last " +
                                    std::to_string(state_->recorder->lost()) +
                                    " poses are not in the session");
}

void LiveThrow::end_force() noexcept { emergency_stop().fire(); }

}  // namespace clay::servo
