#include "app/studio/stroke_controller.hpp"

#include "app/history/split.hpp"
#include "app/servo/servo_check.hpp"
#include "app/studio/free_place.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::studio {
namespace {

constexpr double kClosingMmPerS = 15.0;  // closing speed of a pinch, like two hands on a wall

/// Two fingers are limited by the speed at which they close; needle and wire cut.
bool hand_is_free(ToolMode mode) { return mode == ToolMode::pinch || cuts_level(mode); }

render::PotView view_of(const servo::LiveProfile& profile) {
  render::PotView view;
  view.height_mm = profile.height_mm;
  view.rows.reserve(profile.size);
  for (std::size_t row = 0; row < profile.size; ++row)
    view.rows.push_back({profile.rows[row].outer_mm, profile.rows[row].inner_mm});
  return view;
}

/// The scene with its contact stiffness limited to the largest that the device can render at this
/// rate. This does not change the clay, so the work records the scene as the user has set it.
Result<SceneSpec> felt_scene(SceneSpec scene, const falcon::HapticDevice& device,
                             const servo::LiveSettings& settings) {
  if (!device.info().can_push) return scene;
  return servo::soften(scene, settings).map([&](double) { return scene; });
}

}  // namespace

Result<void> StrokeController::press(const MousePress& press) {
  if (device_) return {};  // a device is already in use
  release();
  device_waits_ = false;
  const SceneSpec scene = document_.scene_with(press.tool, press.wheel_rpm);
  servo::LiveSettings settings = MouseDevice::servo_settings();
  closed_gap_mm_ = press.tool.mode == ToolMode::pinch ? press.tool.gap_mm.value_or(0.0) : 0.0;
  gap_mm_ = std::max(closed_gap_mm_, press.gap_mm);
  settings.gap_mm = gap_mm_;
  mouse_.begin_at(press.place_mm);
  resisting_rpm_ = hand_is_free(press.tool.mode) ? 0.0 : press.wheel_rpm;
  auto begun = begin_session(scene, mouse_, settings);
  if (begun) document_.set_scene(scene);
  return begun;
}

Result<void> StrokeController::begin_session(const SceneSpec& scene, falcon::HapticDevice& device,
                                             const servo::LiveSettings& settings) {
  if (auto branched = document_.branch_here(); !branched) return branched;
  if (document_.pot().collapse)
    return failure(ErrorKind::bad_input,
                   document_.can_undo()
                       ? "The clay has fallen: undo removes the last stroke"
                       : "The clay has fallen: no stroke is possible, but it can be exported");
  view_ = document_.view();
  begun_ = render::extent_of(view_);
  crown_mm_ = 0.0;
  touched_ = false;
  if (auto started = start_servo(scene, device, settings); !started) return started;
  if (paused_) pause(true);
  status_ = {};
  last_ns_ = measured_ns_ = clock_.now_ns();
  measured_ticks_ = 0;
  tick_rate_hz_ = 0.0;
  return {};
}

Result<void> StrokeController::start_servo(const SceneSpec& scene, falcon::HapticDevice& device,
                                           const servo::LiveSettings& settings) {
  const auto felt = felt_scene(scene, device, settings);
  if (!felt) return tl::make_unexpected(felt.error());
  auto begun = document_.begin_stroke(scene);
  if (!begun) return tl::make_unexpected(begun.error());
  const auto refused = [this](const Error& error) -> tl::unexpected<Error> {
    live_.reset();
    (void)document_.end_stroke(std::nullopt, history::Recording::one_stroke);  // adds none
    return tl::make_unexpected(error);
  };
  auto wheel = *felt == scene ? Result<Wheel>(std::move(begun->wheel))
                              : Wheel::build(*felt, document_.pot());
  if (!wheel) return refused(wheel.error());
  wheel_.emplace(std::move(*wheel));
  felt_ = settings_of(*felt);
  force_ = scene.force;
  auto live = servo::LiveMeasures::build(
      {.wheel = *wheel_, .device = device, .scene = *felt, .sink = begun->sink, .clock = &clock_},
      settings, &trace_);
  if (!live) return refused(live.error());
  if (&device == &mouse_ && resisting_rpm_ > 0.0)
    mouse_.meet({&wheel_->stack(), &wheel_->plan().tool, resisting_rpm_,
                 scene.tool.mode == ToolMode::trim_foot ? std::optional(wheel_->stack().height_mm())
                                                        : std::nullopt});
  live_.emplace(std::move(*live));
  auto started = live_->start(!threads_                ? servo::Pace::stepped
                              : device.info().can_push ? servo::Pace::real_time
                                                       : servo::Pace::thread);
  if (!started) return refused(started.error());
  return {};
}

void StrokeController::command(const servo::Command& command) noexcept {
  if (live_) (void)live_->command(command);
}

void StrokeController::pause(bool on) noexcept {
  paused_ = on;
  command({servo::CommandKind::pause, on ? 1.0 : 0.0});
}

void StrokeController::release() {
  if (!live_) return;
  news_.stroke_ended = true;
  news_.ending = live_->stop();
  status_ = live_->status();
  news_.poses = status_.poses;
  news_.ticks = status_.ticks;
  news_.before = begun_;
  news_.ring_limit = status_.ring_limit;
  servo_ = {servo::LiveMeasures::timing(*live_), servo::LiveMeasures::events(*live_),
            live_->realtime()};
  // If poses are missing, the pot is the replay of the recorded ones.
  std::optional<Pot> thrown;
  if (auto kept = live_->finish_recording(); !kept)
    news_.error = kept.error();
  else if (live_->recorded().lost > 0)
    news_.error = Error{ErrorKind::io,
                        "The end of the stroke is lost: the machine was too slow to record it"};
  else
    thrown = servo::with_force_of_scene(wheel_->pot(), felt_, force_);
  const auto recording =
      device_ ? history::Recording::several_strokes : history::Recording::one_stroke;
  const std::size_t before = document_.work().size();
  if (auto added = document_.end_stroke(std::move(thrown), recording); !added)
    news_.error = added.error();
  else if (document_.work().size() == before && touched_ && cuts_level(wheel_->plan().mode))
    news_.nothing_cut = why_nothing_cut();
  live_.reset();
  wheel_.reset();
  if (news_.ending == servo::Ending::device_lost) lose_device();
  device_waits_ = device_ != nullptr && news_.ending != servo::Ending::collapsed;
}

bool StrokeController::has_left_clay() const noexcept {
  const double away_s = 1e-9 * static_cast<double>(last_ns_ - contact_ns_);
  return touched() && !status_.contact && away_s > history::kFreeAirS;
}

/// A needle or a wire can be in the clay without changing it.
std::string StrokeController::why_nothing_cut() const {
  const ClayStack& stack = wheel_->stack();
  const char* tool = wheel_->plan().mode == ToolMode::wire ? "wire" : "needle";
  const double level = status_.tool_mm.y / stack.ring_height_mm();
  if (level < 0.5) return fmt::format("The {} was on the wheel head: nothing was cut", tool);
  if (level + 0.5 >= static_cast<double>(stack.size()))
    return fmt::format("The {} was at the rim: nothing was cut", tool);
  return wheel_->plan().mode == ToolMode::wire
             ? "The wire did not reach the axis: nothing was cut"
             : "The needle did not go through the wall from outside: nothing was cut";
}

void StrokeController::begin_work() noexcept {
  status_ = {};
  news_ = {};
  resume();
}

void StrokeController::take(std::unique_ptr<falcon::HapticDevice> device,
                            servo::LiveSettings settings) {
  release();
  device_ = std::move(device);
  device_settings_ = settings;
  device_waits_ = true;
}

/// The force of the device ended with it; the mouse replaces it.
void StrokeController::lose_device() {
  news_.error = device_->problem();
  news_.device_lost = true;
  device_.reset();
}

void StrokeController::hold(const ToolSpec& tool, double wheel_rpm) {
  if (!device_ || !document_.has_work()) return;
  const SceneSpec scene = document_.scene_with(tool, wheel_rpm);
  // Changes of the stiffness are in the scene of the document.
  const bool felt = !throwing() || scene.force == force_;
  if (felt && scene == document_.scene()) return;
  release();
  document_.set_scene(scene);
}

/// After its servo has ended, a device must be opened again before it can exert force.
void StrokeController::begin_with_device() {
  device_waits_ = false;
  closed_gap_mm_ = gap_mm_ = device_settings_.gap_mm;
  if (!device_->open()) return lose_device();
  if (auto begun = begin_session(document_.scene(), *device_, device_settings_); !begun)
    news_.error = begun.error();
}

/// The gap to which the fingers of a pinch move. Of the mouse and the gamepad, it is wider where
/// the wall leans; an arm has its own gap.
double StrokeController::aimed_gap_mm() const {
  if (device_ || wheel_->plan().mode != ToolMode::pinch || status_.ticks == 0)
    return closed_gap_mm_;
  return closed_gap_mm_ + stand_off_mm(view_, wheel_->plan().tool, status_.tool_mm.y);
}

void StrokeController::advance(std::int64_t now_ns) {
  if (!live_ && device_waits_ && document_.has_work() && !document_.pot().collapse)
    begin_with_device();
  if (!live_) return;
  if (const double aimed_mm = aimed_gap_mm(); gap_mm_ != aimed_mm) {
    // A stroke may have begun after the frame.
    const auto passed_ns = static_cast<double>(std::max<std::int64_t>(0, now_ns - last_ns_));
    const double step_mm = kClosingMmPerS * 1e-9 * passed_ns;
    gap_mm_ = std::clamp(aimed_mm, gap_mm_ - step_mm, gap_mm_ + step_mm);
    command({servo::CommandKind::gap, gap_mm_});
  }
  last_ns_ = now_ns;
  live_->advance(now_ns);
  read_servo();
  measure_rate(now_ns);
  if (!live_->running()) release();
}

void StrokeController::read_servo() {
  status_ = live_->status();
  if (status_.contact) contact_ns_ = last_ns_;
  touched_ = touched_ || status_.contact;
  const servo::LiveProfile* profile = live_->new_profile();
  if (profile == nullptr) return;
  view_ = view_of(*profile);
  crown_mm_ = profile->crown_mm;
}

/// Four times a second, so that the number is readable.
void StrokeController::measure_rate(std::int64_t now_ns) {
  constexpr std::int64_t kPeriodNs = 250'000'000;
  if (now_ns - measured_ns_ < kPeriodNs) return;
  tick_rate_hz_ = 1e9 * static_cast<double>(status_.ticks - measured_ticks_) /
                  static_cast<double>(now_ns - measured_ns_);
  measured_ns_ = now_ns;
  measured_ticks_ = status_.ticks;
}

}  // namespace clay::studio
