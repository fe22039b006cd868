#include "falcon/sim/falcon_model.hpp"

#include <algorithm>
#include <string_view>

namespace clay::falcon::inline sim {
namespace {

constexpr std::string_view kGreeting = "\x0A\x43\x0D";
constexpr std::string_view kGreetingAnswer = "\x0A\x44\x2C\x0D";
constexpr std::size_t kHeaderBytes = std::size_t{2} * (1 + 8 + 2);
constexpr std::size_t kBlockHeadBytes = std::size_t{2} * 2;  // the address; the size precedes it
constexpr std::size_t kMiddle = kFrameBytes / 2;

/// Whether a boot stream is complete: follows the blocks by their sizes.
bool is_whole(const std::vector<std::uint8_t>& stream) {
  std::size_t at = kHeaderBytes;
  while (at + 2 <= stream.size()) {
    const std::size_t words = stream[at] | static_cast<std::size_t>(stream[at + 1]) << 8;
    if (words == 0) return true;
    at += 2 + kBlockHeadBytes + 2 * words;
  }
  return false;
}

std::int16_t number_at(std::span<const std::uint8_t> frame, std::size_t at) {
  unsigned word = 0;
  for (std::size_t n = 4; n-- > 0;) word = word * 16 + ((frame[at + n] - 'A') & 15u);
  return static_cast<std::int16_t>(word);
}

LegCounts motors_in(std::span<const std::uint8_t> frame) {
  return {number_at(frame, 1), number_at(frame, 5), number_at(frame, 9)};
}

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

void Answer::add(std::span<const std::uint8_t> more) noexcept {
  const std::size_t taken = std::min(more.size(), bytes.size() - size);
  std::copy_n(more.begin(), taken, bytes.begin() + static_cast<long>(size));
  size += taken;
}

FalconModel::FalconModel(FalconModelSettings settings, Grip grip)
    : settings_(std::move(settings)),
      grip_(std::move(grip)),
      kinematics_(settings_.geometry),
      stage_(settings_.loaded ? Stage::running : Stage::waiting),
      homed_legs_(settings_.homed ? 3 : 0) {}

void FalconModel::set_dtr(bool high) noexcept {
  const bool rises = high && !dtr_;
  dtr_ = high;
  if (rises) restart(Stage::waiting);
}

void FalconModel::restart(Stage stage) noexcept {
  stage_ = stage;
  heard_size_ = 0;
  firmware_.clear();
  homing_ = homed_legs_ = 0;
  motors_ = {};
  force_n_ = glm::dvec3(0.0);
}

void FalconModel::replug() noexcept {
  unplugged_ = false;
  restart(settings_.loaded ? Stage::running : Stage::waiting);
}

void FalconModel::switch_power(bool on) noexcept {
  settings_.power = on;
  restart(Stage::waiting);
}

bool FalconModel::happens(WireFault fault, std::uint64_t now) {
  const auto due = std::find_if(
      settings_.faults.begin(), settings_.faults.end(),
      [&](const PlannedFault& planned) { return planned.fault == fault && planned.at <= now; });
  if (due == settings_.faults.end()) return false;
  settings_.faults.erase(due);
  return true;
}

Answer FalconModel::receive(std::span<const std::uint8_t> bytes, double dt_s) {
  Answer answer;
  if (!settings_.power) return answer;
  for (const std::uint8_t byte : bytes) {
    if (unplugged_) break;
    if (stage_ == Stage::running)
      run(byte, dt_s, answer);
    else
      boot(byte, answer);
  }
  return answer;
}

void FalconModel::receive_last(std::span<const std::uint8_t> frame) noexcept {
  if (stage_ != Stage::running || frame.size() != kFrameBytes) return;
  motors_ = motors_in(frame);
  force_n_ = force_of(motors_);
}

void FalconModel::boot(std::uint8_t byte, Answer& answer) {
  if (stage_ == Stage::waiting && baud_ == baud_of(LineMode::greeting)) {
    heard_[heard_size_++ % kFrameBytes] = byte;
    const std::span<const std::uint8_t> said(heard_.data(), kGreeting.size());
    if (heard_size_ != kGreeting.size() || !std::ranges::equal(said, bytes_of(kGreeting))) return;
    answer.add(bytes_of(kGreetingAnswer));
    stage_ = Stage::greeted;
  } else if (stage_ == Stage::greeted && baud_ == baud_of(LineMode::loading) && !dtr_ &&
             byte == 'A') {
    answer.add({&byte, 1});
    stage_ = Stage::loading;
  } else if (stage_ == Stage::loading && baud_ == baud_of(LineMode::loading)) {
    load(byte, answer);
  }
}

void FalconModel::load(std::uint8_t byte, Answer& answer) {
  const bool damaged = happens(WireFault::echo_error, firmware_.size());
  const std::uint8_t echo = damaged ? static_cast<std::uint8_t>(~byte) : byte;
  answer.add({&echo, 1});
  firmware_.push_back(byte);
  if (!is_whole(firmware_)) return;
  stage_ = Stage::running;
  heard_size_ = 0;
}

/// Returns whether a frame is complete.
bool FalconModel::take(std::uint8_t byte) noexcept {
  if (byte == '<') heard_size_ = 0;
  if (heard_size_ < kFrameBytes) heard_[heard_size_++] = byte;
  return heard_size_ == kFrameBytes && heard_.front() == '<' && heard_.back() == '>';
}

void FalconModel::run(std::uint8_t byte, double dt_s, Answer& answer) {
  if (baud_ != baud_of(LineMode::running) || !take(byte)) return;
  heard_size_ = 0;
  motors_ = motors_in(heard_);
  home(((heard_[13] - 'A') & 1) != 0);
  answer_frame(dt_s, answer);
}

void FalconModel::home(bool asked) noexcept {
  if (happens(WireFault::homing_lost, frames_)) homing_ = homed_legs_ = 0;
  if (asked && homed_legs_ < 3 && ++homing_ % settings_.homing_frames == 0) ++homed_legs_;
}

/// Virtual work: force = J^T torques.
glm::dvec3 FalconModel::force_of(const LegCounts& motors) const noexcept {
  const glm::dvec3 torques =
      -1.0 / settings_.motor_counts_per_nmm * glm::dvec3(motors[0], motors[1], motors[2]);
  const auto jacobian = kinematics_.jacobian(position_mm_);
  return jacobian ? torques * *jacobian : glm::dvec3(0.0);
}

FrameBytes FalconModel::state_frame() const {
  FrameBytes frame{};
  frame.fill('A');
  frame.front() = '<';
  frame.back() = '>';
  unsigned status = settings_.buttons & 15u;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const bool homed = static_cast<int>(leg) < homed_legs_;
    if (homed) status += 16u << leg;
    unsigned word =
        static_cast<std::uint16_t>(counts_[leg] + (homed ? 0 : settings_.unhomed_offset));
    for (std::size_t n = 0; n < 4; ++n, word /= 16)
      frame[1 + 4 * leg + n] = static_cast<std::uint8_t>('A' + word % 16);
  }
  frame[13] = static_cast<std::uint8_t>('A' + status);
  return frame;
}

void FalconModel::answer_frame(double dt_s, Answer& answer) {
  const std::uint64_t now = frames_++;
  force_n_ = force_of(motors_);
  position_mm_ = grip_(force_n_, dt_s);
  if (thumb_) press(thumb_());
  // A grip out of reach leaves the encoders unchanged.
  counts_ =
      kinematics_.inverse(position_mm_)
          .and_then([this](const glm::dvec3& angles) { return kinematics_.counts_of(angles); })
          .value_or(counts_);
  const auto whole = state_frame();
  if (happens(WireFault::unplugged, now)) {
    unplugged_ = true;
    return;
  }
  if (happens(WireFault::no_frame, now)) return;
  auto frame = happens(WireFault::stale_frame, now) && frames_ > 1 ? last_frame_ : whole;
  last_frame_ = whole;
  if (happens(WireFault::bad_nibble, now)) frame[kMiddle] = 0;
  const bool half = happens(WireFault::half_frame, now);
  const bool lost = happens(WireFault::lost_byte, now);
  const std::span<const std::uint8_t> bytes(frame);
  answer.add(bytes.first(kMiddle));
  if (half) return;
  if (happens(WireFault::extra_byte, now)) answer.add(bytes.subspan(kMiddle, 1));
  answer.add(bytes.subspan(kMiddle + (lost ? 1 : 0)));
}

}  // namespace clay::falcon::inline sim
