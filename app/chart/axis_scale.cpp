#include "app/chart/axis_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clay::chart {
namespace {

constexpr double kLinearParts = 6.0;
constexpr int kMostDecades = 8;      // labelled individually; above, every second one and so on
constexpr double kFewDecades = 2.5;  // up to this many also have labels at 2 and 5
constexpr double kSlack = 1e-9;      // a tick at the end of the range is within it

std::string superscript(int power) {
  constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = power < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(power))) text += kDigits[digit - '0'];
  return text;
}

std::string decade_label(int factor, int power, bool plain) {
  if (plain) return fmt::format("{:g}", factor * std::pow(10.0, power));
  const std::string ten = "10" + superscript(power);
  return factor == 1 ? ten : fmt::format("{}×{}", factor, ten);
}

}  // namespace

double round_step(double range, double parts) {
  const double raw = range / parts, power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw * (1.0 - kSlack)) return factor * power;
  return 10.0 * power;
}

AxisScale::AxisScale(bool logarithmic, double low, double high)
    : logarithmic_(logarithmic), low_(std::min(low, high)), high_(std::max(low, high)) {
  if (logarithmic_ && high_ < 1.1 * low_) {
    low_ /= 1.5;
    high_ *= 1.5;
  } else if (!logarithmic_ && high_ - low_ <= 1e-12 * std::max(std::abs(low_), std::abs(high_))) {
    const double room = low_ == 0.0 ? 1.0 : 0.1 * std::abs(low_);
    low_ -= room;
    high_ += room;
  }
}

void AxisScale::place(double low_px, double high_px) {
  low_px_ = low_px;
  high_px_ = high_px;
}

double AxisScale::at(double value) const {
  const double part = logarithmic_ ? std::log(value / low_) / std::log(high_ / low_)
                                   : (value - low_) / (high_ - low_);
  return low_px_ + part * (high_px_ - low_px_);
}

bool AxisScale::shows(double value) const {
  return std::isfinite(value) && (!logarithmic_ || value > 0.0);
}

std::vector<Tick> AxisScale::ticks() const {
  return logarithmic_ ? decade_ticks() : linear_ticks();
}

std::vector<Tick> AxisScale::linear_ticks() const {
  std::vector<Tick> ticks;
  const double step = round_step(high_ - low_, kLinearParts);
  const double first = std::ceil(low_ / step - kSlack), last = std::floor(high_ / step + kSlack);
  for (double k = first; k <= last; ++k)
    ticks.push_back({k * step, fmt::format("{:.6g}", k == 0.0 ? 0.0 : k * step)});
  return ticks;
}

std::vector<Tick> AxisScale::decade_ticks() const {
  const double decades = std::log10(high_ / low_);
  // Below a factor of two or three, a logarithmic axis looks linear.
  if (decades < 0.5) return linear_ticks();
  std::vector<Tick> ticks;
  const int first = static_cast<int>(std::floor(std::log10(low_)));
  const int last = static_cast<int>(std::ceil(std::log10(high_)));
  const int every = 1 + (last - first) / kMostDecades;
  const bool plain = first >= -3 && last <= 5;
  for (int power = first; power <= last; ++power)
    for (int factor = 1; factor < 10; ++factor) {
      const double value = factor * std::pow(10.0, power);
      if (value < low_ * (1.0 - kSlack) || value > high_ * (1.0 + kSlack)) continue;
      if (!std::isfinite(value)) continue;
      const bool labelled =
          factor == 1 ? power % every == 0 : decades < kFewDecades && (factor == 2 || factor == 5);
      if (!labelled && (factor != 1 && every > 1)) continue;
      ticks.push_back({value, labelled ? decade_label(factor, power, plain) : std::string()});
    }
  const auto labelled =
      std::ranges::count_if(ticks, [](const Tick& t) { return !t.label.empty(); });
  return labelled < 2 ? linear_ticks() : ticks;  // for example between 2 and 5, or 5 and 10
}

void Extent::add(double value) {
  if (!std::isfinite(value) || (logarithmic && value <= 0.0)) return;
  low = empty ? value : std::min(low, value);
  high = empty ? value : std::max(high, value);
  empty = false;
}

void Extent::add(const std::vector<double>& values) {
  for (const double value : values) add(value);
}

AxisScale Extent::scale(double margin) const {
  if (empty) return {logarithmic, logarithmic ? 1.0 : 0.0, logarithmic ? 10.0 : 1.0};
  const AxisScale tight(logarithmic, low, high);
  if (logarithmic) {
    const double factor = std::pow(tight.high() / tight.low(), margin);
    // A margin beyond the largest number, or down to 0, would be no range.
    return {true, std::max(tight.low() / factor, std::numeric_limits<double>::min()),
            std::min(tight.high() * factor, std::numeric_limits<double>::max())};
  }
  const double room = margin * (tight.high() - tight.low());
  return {false, tight.low() - room, tight.high() + room};
}

}  // namespace clay::chart
