#include "app/studio/stroke_session.hpp"

#include <utility>

namespace clay::studio {

Result<std::unique_ptr<StrokeSession>> StrokeSession::begin(
    Wheel wheel, falcon::HapticDevice& device, servo::Clock& clock, servo::Recorder* recorder,
    servo::TickTrace* trace, const servo::LiveSettings& settings, Pace pace) {
  std::unique_ptr<StrokeSession> sitting(new StrokeSession(std::move(wheel), pace));
  const servo::Bench bench{sitting->wheel_, device, clock, recorder, trace};
  auto loop = servo::ServoLoop::build(bench, settings);
  if (!loop) return tl::make_unexpected(loop.error());
  sitting->clock_ = &clock;
  sitting->loop_.emplace(std::move(*loop));
  if (pace == Pace::stepped) {
    sitting->loop_->start();
  } else {
    sitting->servo_ =
        std::make_unique<servo::Servo>(bench, *sitting->loop_, pace == Pace::real_time);
    sitting->servo_->start();
  }
  return sitting;
}

StrokeSession::~StrokeSession() { end(); }

void StrokeSession::advance(std::int64_t until_ns) {
  while (!servo_ && ending_ == servo::Ending::none && clock_->now_ns() < until_ns)
    ending_ = loop_->tick(gate_, commands_, view_, heartbeat_us_);
}

bool StrokeSession::command(const servo::Command& command) noexcept {
  return servo_ ? servo_->command(command) : commands_.push(command);
}

bool StrokeSession::running() const noexcept {
  return servo_ ? servo_->running() : ending_ == servo::Ending::none;
}

const servo::LiveProfile* StrokeSession::new_profile() noexcept {
  return view().profile.has_new() ? &view().profile.newest() : nullptr;
}

servo::Ending StrokeSession::end() {
  if (!loop_) return servo::Ending::stopped;
  if (!running()) return servo_ ? servo_->join() : ending_;
  command({servo::CommandKind::stop, 0.0});
  if (servo_) return servo_->join();
  return ending_ = loop_->tick(gate_, commands_, view_, heartbeat_us_);
}

}  // namespace clay::studio
