#include "engine/tool/tool_state.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace clay {
namespace {

constexpr double kLongestWayMm = 0.05;
constexpr int kMostParts = 32;
constexpr std::int64_t kLongestStepUs = 50'000;
constexpr std::int64_t kSlowUs = kClockPeriodUs / 3;

/// Number of thirds of periods up to a time. Only differences of it have a meaning.
std::int64_t thirds_by(std::int64_t time_us) noexcept {
  return time_us / kSlowUs - (time_us % kSlowUs < 0 ? 1 : 0);
}

// Not (|x| > limit): NaN must fail.
bool within(double mm) noexcept { return std::abs(mm) <= kFarthestMm; }

}  // namespace

int parts_of(const ToolState& tool) noexcept {
  const glm::dvec3 way = glm::abs(tool.moved_mm);
  const double parts = std::max({way.x, way.y, way.z}) / kLongestWayMm;
  return parts < kMostParts ? static_cast<int>(parts) + 1 : kMostParts;
}

ToolState ToolTracker::advance(const Pose& pose, double widest_gap_mm) noexcept {
  ToolState state;
  const glm::dvec3& p = pose.position_mm;
  if (!(within(p.x) && within(p.y) && within(p.z))) return state;
  if (!(pose.gap_mm >= 0.0 && pose.gap_mm <= widest_gap_mm)) return state;
  if (has_last_) {
    if (pose.time_us <= last_.time_us) return state;
    // Unsigned: the difference of two signed extremes must not overflow.
    const auto elapsed =
        static_cast<std::uint64_t>(pose.time_us) - static_cast<std::uint64_t>(last_.time_us);
    state.dt_clamped = elapsed > static_cast<std::uint64_t>(kLongestStepUs);
    state.dt_s =
        1e-6 * static_cast<double>(std::min(elapsed, static_cast<std::uint64_t>(kLongestStepUs)));
    constexpr std::int64_t kMostThirds = kLongestStepUs / kSlowUs;
    const std::int64_t thirds = thirds_by(pose.time_us) - thirds_by(last_.time_us);
    state.slow_s = 1e-6 * static_cast<double>(kSlowUs * std::min(thirds, kMostThirds));
    state.moved_mm = p - last_.position_mm;
    if (state.moved_mm.y != 0.0) upward_ = state.moved_mm.y > 0.0;
  }
  last_ = pose;
  has_last_ = true;
  state.phase_s = 1e-6 * static_cast<double>(pose.time_us % kClockPeriodUs);
  state.hip_mm = p;
  state.upward = upward_;
  state.trim = pose.trim;
  state.gap_mm = pose.gap_mm;
  state.valid = true;
  return state;
}

}  // namespace clay
