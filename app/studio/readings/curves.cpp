#include "app/studio/readings/curves.hpp"

#include <algorithm>
#include <cmath>

namespace clay::studio {

std::vector<std::optional<MinMax>> min_max_of(std::span<const CurvePoint> points, double from,
                                              double to, std::size_t columns) {
  std::vector<std::optional<MinMax>> parts(columns);
  if (!(to > from) || columns == 0) return parts;
  const double scale = static_cast<double>(columns) / (to - from);
  for (const CurvePoint& point : points) {
    if (!(point.at >= from && point.at <= to)) continue;
    const auto column = std::min(static_cast<std::size_t>((point.at - from) * scale), columns - 1);
    std::optional<MinMax>& part = parts[column];
    if (!part) part = MinMax{point.value, point.value};
    part->least = std::min(part->least, point.value);
    part->most = std::max(part->most, point.value);
  }
  return parts;
}

double round_up(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * decade * (1.0 + 1e-12)) return step * decade;
  return 10.0 * decade;
}

namespace {

constexpr std::size_t kMost = 65'536;  // limit of memory; above 6 kHz fewer seconds are kept

/// Changes the order of the elements.
double percentile(std::vector<float>& values, double part) {
  const auto number =
      static_cast<std::ptrdiff_t>(std::ceil(part * static_cast<double>(values.size()))) - 1;
  const auto at = values.begin() + std::max<std::ptrdiff_t>(0, number);
  std::ranges::nth_element(values, at);
  return static_cast<double>(*at);
}

}  // namespace

void TickHistory::take(servo::TickTrace& trace) {
  while (const auto sample = trace.take()) add(*sample);
}

void TickHistory::add(const servo::TickSample& sample) {
  samples_.push_back(sample);
  const auto oldest = sample.time_ns - static_cast<std::int64_t>(1e9 * kHistoryS);
  while (samples_.front().time_ns < oldest || samples_.size() > kMost) samples_.pop_front();
}

TickFigures TickHistory::figures() const {
  TickFigures figures;
  if (samples_.empty()) return figures;
  figures.ticks = samples_.size();
  std::vector<float> late, work;
  late.reserve(samples_.size());
  work.reserve(samples_.size());
  for (const servo::TickSample& sample : samples_) {
    late.push_back(sample.late_us);
    work.push_back(sample.work_us);
    figures.missed += sample.missed ? 1u : 0u;
    figures.force_most_n = std::max(figures.force_most_n, static_cast<double>(sample.clay_n));
  }
  figures.late_most_us = static_cast<double>(*std::ranges::max_element(late));
  figures.late_p50_us = percentile(late, 0.5);
  figures.late_p99_us = percentile(late, 0.99);
  figures.work_p50_us = percentile(work, 0.5);
  return figures;
}

std::vector<CurvePoint> TickHistory::curve(float servo::TickSample::*value) const {
  std::vector<CurvePoint> points;
  points.reserve(samples_.size());
  for (const servo::TickSample& sample : samples_)
    points.push_back({1e-9 * static_cast<double>(sample.time_ns - samples_.back().time_ns),
                      static_cast<double>(sample.*value)});
  return points;
}

}  // namespace clay::studio
