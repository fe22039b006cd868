#include "app/studio/sitting.hpp"

#include <utility>

namespace clay::studio {

Result<std::unique_ptr<Sitting>> Sitting::begin(Wheel wheel, falcon::HapticDevice& device,
                                                live::Clock& clock, live::Recorder* recorder,
                                                live::TickTrace* trace,
                                                const live::LiveSettings& settings, Pace pace) {
  std::unique_ptr<Sitting> sitting(new Sitting(std::move(wheel), pace));
  const live::Bench bench{sitting->wheel_, device, clock, recorder, trace};
  auto loop = live::ServoLoop::build(bench, settings);
  if (!loop) return tl::make_unexpected(loop.error());
  sitting->clock_ = &clock;
  sitting->loop_.emplace(std::move(*loop));
  if (pace == Pace::stepped) {
    sitting->loop_->start();
  } else {
    sitting->servo_ =
        std::make_unique<live::Servo>(bench, *sitting->loop_, pace == Pace::real_time);
    sitting->servo_->start();
  }
  return sitting;
}

Sitting::~Sitting() { end(); }

void Sitting::advance(std::int64_t until_ns) {
  while (!servo_ && ending_ == live::Ending::none && clock_->now_ns() < until_ns)
    ending_ = loop_->tick(gate_, commands_, view_, heartbeat_us_);
}

bool Sitting::command(const live::Command& command) noexcept {
  return servo_ ? servo_->command(command) : commands_.push(command);
}

bool Sitting::running() const noexcept {
  return servo_ ? servo_->running() : ending_ == live::Ending::none;
}

const live::LiveProfile* Sitting::new_profile() noexcept {
  return view().profile.has_new() ? &view().profile.newest() : nullptr;
}

live::Ending Sitting::end() {
  if (!loop_) return live::Ending::stopped;
  if (!running()) return servo_ ? servo_->join() : ending_;
  command({live::CommandKind::stop, 0.0});
  if (servo_) return servo_->join();
  return ending_ = loop_->tick(gate_, commands_, view_, heartbeat_us_);
}

}  // namespace clay::studio
