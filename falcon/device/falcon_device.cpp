#include "falcon/device/falcon_device.hpp"

#include "core/limit_norm.hpp"
#include "core/text.hpp"
#include "falcon/device/firmware.hpp"
#include "falcon/device/setting_ranges.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace clay::falcon::inline device {
namespace {

constexpr double kStatedForceN = 8.9;  // 2 lbf, as printed on Novint's box
constexpr double kWorkspaceMm = 48.0;  // largest ball within the range of all encoders
// Motors 0, lights off. A constant, so that a signal handler can send it.
constexpr std::uint8_t kZeroFrame[] = {'<', 'A', 'A', 'A', 'A', 'A', 'A', 'A',
                                       'A', 'A', 'A', 'A', 'A', 'A', 'A', '>'};
// A transport with less remaining room than this may have stopped because of it.
constexpr std::size_t kMostInPiece = 64;
// More than a transport keeps: a device that floods the line must not block the servo.
constexpr int kMostReads = 8;
constexpr int kQuestions = 10;
constexpr std::int64_t kAnswerUs = 20'000;  // ten times the duration of a frame and its answer
constexpr int kTimedQuestions = 5;

DeviceInfo info_of(const Transport& line, const FalconSettings& settings) {
  return {"Novint Falcon",        line.describe(),          true,
          settings.force_limit_n, glm::dvec3(kWorkspaceMm), 1000.0};
}

}  // namespace

FalconDevice::FalconDevice(std::unique_ptr<Transport> line, const FalconSettings& settings)
    : line_(std::move(line)),
      settings_(settings),
      kinematics_(settings.geometry),
      info_(info_of(*line_, settings)),
      position_mm_(settings.centre_mm) {}

FalconDevice::~FalconDevice() {
  stop();
  line_->close();
}

DeviceResult<void> FalconDevice::check_settings() const {
  const OutOfRange settings[] = {
      {"motor_counts_per_nmm", 1e-3, 1e3, settings_.motor_counts_per_nmm},
      {"force_limit_n", 0.0, kStatedForceN, settings_.force_limit_n},
      {"silence_us", 1e4, 6e7, static_cast<double>(settings_.silence_us)},
  };
  if (const auto checked = check_ranges(settings); !checked)
    return bad_setting("falcon", checked.error());
  const glm::dvec3& centre = settings_.centre_mm;
  if (!kinematics_.jacobian(centre))
    return device_failure(DeviceFault::bad_setting,
                          "falcon: centre_mm: expected a point that the arms of this geometry "
                          "reach, found (" +
                              number_text(centre.x) + ", " + number_text(centre.y) + ", " +
                              number_text(centre.z) + ")");
  return {};
}

DeviceResult<void> FalconDevice::open() {
  line_->close();
  reader_ = FrameReader();
  counters_ = {};
  position_mm_ = settings_.centre_mm;
  unanswered_since_us_ = 0;
  sample_ = {};
  auto opened = start();
  if (opened) {
    info_.answer_us = answer_time_us();
  } else {
    line_->close();
    refusal_ = opened.error();
    if (sample_.state != DeviceState::needs_firmware) sample_.state = DeviceState::closed;
  }
  stopped_.store(!opened);
  return opened;
}

DeviceResult<void> FalconDevice::start() {
  if (auto checked = check_settings(); !checked) return checked;
  if (auto opened = line_->open(); !opened) return opened;
  if (auto set = line_->set_mode(LineMode::running); !set) return set;
  auto answered = answers();
  if (!answered) return tl::make_unexpected(answered.error());
  if (*answered) return {};

  sample_.state = DeviceState::needs_firmware;
  const std::string silent = info_.place + ": no answer to frames";
  if (!line_->loads_firmware())
    return device_failure(DeviceFault::no_answer, silent,
                          "switch on the Falcon's power supply and check that the bridge has "
                          "loaded its firmware");
  if (settings_.firmware_path.empty()) {
    if (auto powered = greet_loader(*line_); !powered) return powered;
    return device_failure(DeviceFault::no_firmware,
                          info_.place + ": it has power, and no firmware since it was switched on",
                          "name the firmware file that came with its driver (--firmware)");
  }
  const auto firmware = read_firmware(settings_.firmware_path);
  if (!firmware) return tl::make_unexpected(firmware.error());
  if (auto loaded = load_firmware(*line_, *firmware); !loaded) return loaded;
  answered = answers();
  if (!answered) return tl::make_unexpected(answered.error());
  if (*answered) return {};
  return device_failure(DeviceFault::no_answer,
                        silent + " with the firmware of " + settings_.firmware_path + " loaded",
                        "switch its power supply off and on, and try another firmware file");
}

/// Whether the device answers frames of zero force.
DeviceResult<bool> FalconDevice::answers() {
  for (int i = 0; i < kQuestions; ++i) {
    const WireStatus sent = line_->write(kZeroFrame);
    std::array<std::uint8_t, 64> bytes{};
    const Received got = line_->read(bytes, kAnswerUs);
    if (sent == WireStatus::unplugged || got.status == WireStatus::unplugged)
      return device_failure(DeviceFault::unplugged, info_.place + ": unplugged while it was opened",
                            "plug it in again");
    if (got.status != WireStatus::ok)
      return device_failure(DeviceFault::transfer_failed,
                            info_.place + ": a transfer failed while it was opened");
    take(std::span(bytes).first(got.size), got.time_us);
    if (counters_.frames > 0) return true;
  }
  return false;
}

/// Sends zero force; returns the time until a frame came, at most kAnswerUs.
std::int64_t FalconDevice::ask_and_wait() noexcept {
  const std::int64_t asked_us = line_->now_us(), end_us = asked_us + kAnswerUs;
  const std::uint64_t before = counters_.frames;
  WireStatus status = line_->write(kZeroFrame);
  std::int64_t arrived_us = end_us;
  while (status == WireStatus::ok && counters_.frames == before && line_->now_us() < end_us) {
    std::array<std::uint8_t, 64> bytes{};
    const Received got = line_->read(bytes, end_us - line_->now_us());
    take(std::span(bytes).first(got.size), got.time_us);
    status = got.status;
    arrived_us = got.time_us;
  }
  return counters_.frames == before ? kAnswerUs : arrived_us - asked_us;
}

/// The median of several questions, one at a time: no answer of an earlier one is on its way.
std::int64_t FalconDevice::answer_time_us() noexcept {
  std::array<std::uint8_t, 512> old{};
  for (int i = 0; i < kMostReads && line_->read(old, kAnswerUs).size > 0; ++i) continue;
  std::array<std::int64_t, kTimedQuestions> times_us{};
  for (std::int64_t& time_us : times_us) time_us = ask_and_wait();
  std::ranges::nth_element(times_us, times_us.begin() + kTimedQuestions / 2);
  return times_us[kTimedQuestions / 2];
}

void FalconDevice::fail(DeviceFault fault) noexcept {
  fault_ = fault;
  sample_.state = DeviceState::fault;
  sample_.fresh = false;
}

void FalconDevice::take(std::span<const std::uint8_t> bytes, std::int64_t time_us) noexcept {
  while (const auto frame = reader_.next(bytes)) accept(*frame, time_us);
}

void FalconDevice::accept(const StateFrame& frame, std::int64_t time_us) noexcept {
  ++counters_.frames;
  unanswered_since_us_ = 0;
  const bool was_ready = sample_.state == DeviceState::ready;
  sample_.state = frame.all_homed() ? DeviceState::ready : DeviceState::needs_homing;
  // Homing moves the origin: the last position is no longer a good start.
  const bool moved = was_ready != frame.all_homed();
  const glm::dvec3 angles = kinematics_.angles_of(frame.encoders);
  auto position = kinematics_.forward(angles, moved ? settings_.centre_mm : position_mm_);
  if (!position) position = kinematics_.forward(angles, settings_.centre_mm);
  if (!position) {
    ++counters_.without_pose;
    return;
  }
  position_mm_ = *position;
  sample_.position_mm = position_mm_ - settings_.centre_mm;
  sample_.buttons = frame.buttons;
  sample_.time_us = time_us;
  sample_.fresh = true;
}

DeviceSample FalconDevice::read(std::int64_t wait_us) noexcept {
  sample_.fresh = false;
  if (!is_open(sample_.state)) return sample_;
  const std::int64_t end_us = line_->now_us() + wait_us;
  std::int64_t left_us = wait_us;
  std::array<std::uint8_t, 512> bytes{};
  bool more = false;  // after a pause of the host, the newest frame is the last one
  int reads = 0;
  do {
    const Received got = line_->read(bytes, std::max<std::int64_t>(left_us, 0));
    take(std::span(bytes).first(got.size), got.time_us);
    if (got.status != WireStatus::ok) {
      fail(got.status == WireStatus::unplugged ? DeviceFault::unplugged
                                               : DeviceFault::transfer_failed);
      return sample_;
    }
    more = bytes.size() - got.size < kMostInPiece && ++reads < kMostReads;
    left_us = more ? 0 : end_us - line_->now_us();
  } while (more || (!sample_.fresh && left_us > 0));
  if (unanswered_since_us_ != 0 && line_->now_us() - unanswered_since_us_ > settings_.silence_us)
    fail(DeviceFault::no_answer);
  return sample_;
}

LegCounts FalconDevice::motors_for(const glm::dvec3& force_n) const noexcept {
  if (sample_.state != DeviceState::ready || force_n == glm::dvec3(0.0)) return {};
  const auto torques =
      kinematics_.torques(position_mm_, limit_norm(force_n, settings_.force_limit_n));
  return torques ? motor_counts(*torques, settings_.motor_counts_per_nmm) : LegCounts{};
}

void FalconDevice::write(const glm::dvec3& force_n) noexcept {
  if (!is_open(sample_.state) || stopped_.load()) return;
  const bool homing = sample_.state == DeviceState::needs_homing;
  const WireStatus sent = line_->write(
      encode({.motors = motors_for(force_n), .homing = homing, .green = !homing, .red = homing}));
  // A concurrent stop must still send the last packet.
  if (stopped_.load()) line_->write_last(kZeroFrame);
  if (unanswered_since_us_ == 0) unanswered_since_us_ = line_->now_us();
  if (sent == WireStatus::busy) ++counters_.writes_dropped;
  if (sent == WireStatus::unplugged) fail(DeviceFault::unplugged);
  if (sent == WireStatus::failed) fail(DeviceFault::transfer_failed);
}

void FalconDevice::zero() noexcept { line_->write_last(kZeroFrame); }

void FalconDevice::stop() noexcept {
  stopped_.store(true);
  line_->write_last(kZeroFrame);
}

DeviceError FalconDevice::problem() const {
  if (sample_.state != DeviceState::fault) return refusal_;
  switch (fault_) {
    case DeviceFault::unplugged:
      return {fault_, info_.place + ": unplugged", "plug it in again"};
    case DeviceFault::no_answer:
      return {fault_,
              info_.place + ": no frame for " + std::to_string(settings_.silence_us / 1000) + " ms",
              "check its power supply and its cable"};
    default:
      return {fault_, info_.place + ": a transfer failed", "unplug it and plug it in again"};
  }
}

DeviceCounters FalconDevice::counters() const noexcept {
  DeviceCounters counters = counters_;
  counters.bytes_discarded = reader_.discarded();
  return counters;
}

std::unique_ptr<HapticDevice> make_falcon(std::unique_ptr<Transport> line,
                                          const FalconSettings& settings) {
  return std::make_unique<FalconDevice>(std::move(line), settings);
}

}  // namespace clay::falcon::inline device
