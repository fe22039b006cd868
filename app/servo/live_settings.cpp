#include "app/servo/live_settings.hpp"

#include <fmt/format.h>

namespace clay::servo {
namespace {

constexpr double kLowestRateHz = 400.0, kHighestRateHz = 4000.0;
constexpr double kLowestClayRateHz = 20.0;

Result<void> refuse(const char* option, double low, double high, double found) {
  return failure(
      ErrorKind::bad_input,
      fmt::format("{}: expected a value from {:g} to {:g}, found {:g}", option, low, high, found));
}

bool within(double value, double low, double high) { return value >= low && value <= high; }

}  // namespace

Result<void> check(const LiveSettings& settings) {
  if (!within(settings.rate_hz, kLowestRateHz, kHighestRateHz))
    return refuse("--rate", kLowestRateHz, kHighestRateHz, settings.rate_hz);
  if (settings.clay_rate_hz != 0.0 &&
      !within(settings.clay_rate_hz, kLowestClayRateHz, settings.rate_hz))
    return refuse("--clay-rate", kLowestClayRateHz, settings.rate_hz, settings.clay_rate_hz);
  if (!within(settings.seconds, 0.0, 1e6)) return refuse("--seconds", 0.0, 1e6, settings.seconds);
  if (!within(settings.patience_s, 0.0, 1e6))
    return refuse("--patience", 0.0, 1e6, settings.patience_s);
  if (!within(settings.gap_mm, 0.0, kWidestGapMm))
    return refuse("--gap", 0.0, kWidestGapMm, settings.gap_mm);
  return {};
}

}  // namespace clay::servo
