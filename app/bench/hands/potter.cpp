#include "app/bench/hands/potter.hpp"

#include "claystack/engine/files.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clay::bench {
namespace {

constexpr double kTickS = 0.001, kEventS = 1.0 / 60.0;
constexpr double kTremorMm = 0.3;
constexpr double kTurn = 2.0 * std::numbers::pi;

double smooth(double t) {
  const double x = std::clamp(t, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

}  // namespace

Potter::Potter(Wheel& wheel, std::uint64_t seed) : wheel_(wheel), dice_(seed) {
  for (std::size_t k = 0; k < 3; ++k) {
    tremor_hz_[k] = dice_.between(7.0, 9.0);
    phase_out_[k] = dice_.between(0.0, kTurn);
    phase_up_[k] = dice_.between(0.0, kTurn);
  }
}

double Potter::tool_mm() const { return wheel_.plan().tool.widest(); }

Place Potter::with_tremor(Place place, double at_s) const {
  const double each = kTremorMm * std::sqrt(2.0 / 3.0);
  for (std::size_t k = 0; k < 3; ++k) {
    place.out += each * std::sin(kTurn * tremor_hz_[k] * at_s + phase_out_[k]);
    place.up += each * std::sin(kTurn * tremor_hz_[k] * at_s + phase_up_[k]);
  }
  return place;
}

void Potter::tick(Place place, double gap_mm) {
  time_us_ += 1000;
  const Pose pose = quantized({time_us_, {place.out, place.up, 0.0}, false, gap_mm});
  const StepReport report = wheel_.step(pose);
  if (watch) watch(pose, report);
}

const Ring& Potter::ring_at(double up) const {
  const auto rings = wheel_.stack().rings();
  const double level = std::floor(up / wheel_.stack().ring_height_mm());
  return rings[static_cast<std::size_t>(
      std::clamp(level, 0.0, static_cast<double>(rings.size() - 1)))];
}

double Potter::middle_at(double up) const {
  const Ring& ring = ring_at(up);
  return 0.5 * (ring.outer_mm() + ring.inner_mm());
}

double Potter::floor_mm() const {
  const auto rings = wheel_.stack().rings();
  for (std::size_t i = 0; i < rings.size(); ++i)
    if (rings[i].inner_mm() > 2.0) return static_cast<double>(i) * wheel_.stack().ring_height_mm();
  return 0.0;
}

void Potter::stroke(const std::vector<Place>& path, double speed_mm_s, double gap_mm) {
  std::vector<double> length{0.0};
  for (std::size_t k = 1; k < path.size(); ++k)
    length.push_back(length.back() +
                     std::hypot(path[k].out - path[k - 1].out, path[k].up - path[k - 1].up));
  const double all_s = length.back() / speed_mm_s;
  const auto at = [&](double s) {
    const double travelled = std::min(s, all_s) * speed_mm_s;
    std::size_t k = 1;
    while (k + 1 < path.size() && length[k] < travelled) ++k;
    const double piece = length[k] - length[k - 1];
    const double f = piece > 0.0 ? std::clamp((travelled - length[k - 1]) / piece, 0.0, 1.0) : 1.0;
    return with_tremor({path[k - 1].out + f * (path[k].out - path[k - 1].out),
                        path[k - 1].up + f * (path[k].up - path[k - 1].up)},
                       time_s_ + s);
  };
  const int ticks = static_cast<int>(all_s / kTickS) + 1;
  for (int k = 1; k <= ticks; ++k) {
    const double s = k * kTickS, event = std::floor(s / kEventS), f = s / kEventS - event;
    const Place a = at(event * kEventS), b = at((event + 1.0) * kEventS);
    tick({a.out + f * (b.out - a.out), a.up + f * (b.up - a.up)}, gap_mm);
  }
  time_s_ += all_s + kTickS;
}

void Potter::open(double floor_mm) {
  const double top = height(), bottom = floor_mm * depth_error() + tool_mm(), v = speed();
  stroke({{1.0, top + 12.0},
          {1.0, bottom},
          {14.0, bottom + dice_.between(-1.0, 1.0)},
          {18.0, bottom},
          {20.0, top + 14.0}},
         v, 0.0);
}

void Potter::widen(double most_mm) {
  for (int pass = 0; pass < 2; ++pass) {
    const double top = height(), bottom = floor_mm() + tool_mm();
    const double to = (pass == 0 ? 0.64 * most_mm : most_mm) + dice_.between(-2.0, 2.0),
                 v = speed();
    stroke({{8.0, top + 12.0},
            {8.0, bottom + 1.0},
            {to, bottom + dice_.between(0.0, 1.5)},
            {to + dice_.between(-1.0, 1.0), 0.6 * top},
            {to, top + 12.0}},
           v, 0.0);
  }
}

void Potter::pull(double gap_mm, double target_mm) {
  const double top = height(), floor = floor_mm();
  const double from = floor + tool_mm() + dice_.between(0.0, 4.0);
  const double part = dice_.between(0.8, 1.02), v = speed();
  const Ring& half_way = ring_at(0.5 * top);
  const double wall = half_way.outer_mm() - half_way.inner_mm();
  const double off = 0.5 * wall * dice_.between(-0.3, 0.3);
  const double off_above = 0.5 * wall * dice_.between(-0.3, 0.3);
  const double gap = gap_mm * dice_.between(0.85, 1.15);
  const double end = floor + (top - floor) * part;
  const double to = target_mm > 0.0 ? target_mm : middle_at(end - 3.0);
  rise({middle_at(from + 2.0) + off, from}, to + off_above, part, floor, v, gap);
}

// Moves up to the current rim, and toward `to_out` there.
void Potter::rise(Place from, double to_out, double part, double floor_mm, double speed_mm_s,
                  double gap_mm) {
  constexpr int kTicksOfEvent = 17, kMaxTicks = 30'000;
  Place last = with_tremor(from, time_s_), next = last, at = from;
  double elapsed_s = 0.0;
  for (int n = 0; n < kMaxTicks; ++n) {
    const int phase = n % kTicksOfEvent;
    if (phase == 0) {
      last = next;
      const double end = floor_mm + part * (height() - floor_mm);
      if (at.up >= end) break;
      at.up = std::min(end + 0.01, at.up + speed_mm_s * kEventS);
      const double f = std::min(1.0, (at.up - from.up) / std::max(20.0, end - from.up));
      at.out = from.out + f * (to_out - from.out);
      next = with_tremor(at, time_s_ + elapsed_s + kEventS);
    }
    const double f = static_cast<double>(phase + 1) / kTicksOfEvent;
    tick({last.out + f * (next.out - last.out), last.up + f * (next.up - last.up)}, gap_mm);
    elapsed_s += kTickS;
  }
  time_s_ += elapsed_s;
}

// Approaches a target shape: the original surface moved by depth * bump, in passes that measure the
// pot.
void Potter::aim(const Aim& aim) {
  const double h = wheel_.stack().ring_height_mm(), original_height = height(), floor = floor_mm();
  const double a = tool_mm();
  const auto surface = [&](const Ring& ring) {
    return aim.from_outside ? ring.outer_mm() : ring.inner_mm();
  };
  const double inward = aim.from_outside ? -1.0 : 1.0;
  std::vector<double> original;
  for (const Ring& ring : wheel_.stack().rings()) original.push_back(surface(ring));
  for (int pass = 1; pass <= aim.passes; ++pass) {
    const double tall = height();
    const double low = floor + aim.start * (original_height - floor) + dice_.between(-3.0, 3.0);
    const double high = floor + (tall - floor) * dice_.between(aim.end_low, aim.end_high);
    const double error = depth_error(), v = speed();
    std::vector<Place> path;
    constexpr int kPoints = 16;
    for (int q = 0; q <= kPoints; ++q) {
      const double up = low + (high - low) * q / kPoints, f = (up - floor) / (tall - floor);
      const double old = (std::max(0.0, f) * (original_height - floor) + floor) / h;
      const double goal = original[std::min(original.size() - 1, static_cast<std::size_t>(old))] +
                          inward * aim.depth_mm * aim.bump(f) * pass / aim.passes;
      const double now = surface(ring_at(up)), left = inward * (goal - now);
      const double by = left > 0.0 ? left * error : -std::min(2.0, -left);
      path.push_back({now + inward * (by - a), up});
    }
    const double away = aim.from_outside ? 8.0 : -8.0;
    path.insert(path.begin(), {path.front().out + away, low});
    path.push_back({path.back().out + away, high});
    stroke(path, v, 0.0);
  }
}

void Potter::belly(double depth_mm) {
  aim({depth_mm, 4, false, 0.2, 0.7, 0.85, [](double f) {
         const double x = (f - 0.2) / 0.65;
         return x > 0.0 && x < 1.0 ? std::sin(std::numbers::pi * x) : 0.0;
       }});
}

void Potter::collar(double depth_mm, int passes) {
  aim({depth_mm, passes, true, 0.45, 0.8, 1.0, [](double f) { return smooth((f - 0.45) / 0.4); }});
}

void Potter::flare(double depth_mm) {
  aim({depth_mm, 5, false, 0.15, 0.85, 1.0,
       [](double f) { return std::clamp((f - 0.15) / 0.85, 0.0, 1.0); }});
}

}  // namespace clay::bench
