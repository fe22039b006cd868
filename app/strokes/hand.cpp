#include "app/strokes/hand.hpp"

#include "claystack/engine/files.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace clay::strokes {
namespace {

/// Uniform in [-1, 1).
double noise(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;
}

Place between(const Place& a, const Place& b, double part) {
  return {a.at + (b.at - a.at) * part, a.gap_mm + (b.gap_mm - a.gap_mm) * part};
}

}  // namespace

Tremor::Tremor(double rate_hz) {
  const double w = 2.0 * std::numbers::pi * 9.0 / rate_hz, damping = 3.0 / rate_hz;
  const double radius = 1.0 - 2.0 * std::numbers::pi * damping;
  const double cosine = 1.0 - w * w / 2.0 + w * w * w * w / 24.0;
  a1_ = 2.0 * radius * cosine;
  a2_ = -radius * radius;
  // Variance of a second-order recursion driven by variance 1/3.
  const double variance =
      (1.0 - a2_) / ((1.0 + a2_) * ((1.0 - a2_) * (1.0 - a2_) - a1_ * a1_)) / 3.0;
  gain_ = 1.0 / std::sqrt(variance);
}

double Tremor::next(std::mt19937_64& random) {
  const double y = a1_ * y1_ + a2_ * y2_ + gain_ * noise(random);
  y2_ = y1_;
  return y1_ = y;
}

Path spline(const Path& through) {
  constexpr int kPieces = 32;
  const auto lerp = [](glm::dvec2 a, double ta, glm::dvec2 b, double tb, double t) {
    return (a * (tb - t) + b * (t - ta)) / (tb - ta);
  };
  Path path{through.front()};
  for (std::size_t k = 0; k + 1 < through.size(); ++k) {
    // The path is extrapolated beyond its ends.
    const glm::dvec2 p1 = through[k].at, p2 = through[k + 1].at;
    const glm::dvec2 p0 = k > 0 ? through[k - 1].at : 2.0 * p1 - p2;
    const glm::dvec2 p3 = k + 2 < through.size() ? through[k + 2].at : 2.0 * p2 - p1;
    const double gap1 = through[k].gap_mm, gap2 = through[k + 1].gap_mm;
    const double t1 = std::sqrt(glm::distance(p0, p1));
    const double t2 = t1 + std::sqrt(glm::distance(p1, p2));
    const double t3 = t2 + std::sqrt(glm::distance(p2, p3));
    for (int piece = 1; piece <= kPieces; ++piece) {
      const double t = t1 + (t2 - t1) * piece / kPieces;
      const glm::dvec2 a1 = lerp(p0, 0.0, p1, t1, t), a2 = lerp(p1, t1, p2, t2, t);
      const glm::dvec2 a3 = lerp(p2, t2, p3, t3, t);
      path.push_back({lerp(lerp(a1, 0.0, a2, t2, t), t1, lerp(a2, t1, a3, t3, t), t2, t),
                      gap1 + (gap2 - gap1) * piece / kPieces});
    }
  }
  return path;
}

Hand::Hand(const StrokeScript& script, Wheel wheel, std::size_t most_poses)
    : script_(script),
      wheel_(std::move(wheel)),
      random_(script.seed),
      here_{script.start_mm, 0.0},
      radial_(script.rate_hz),
      vertical_(script.rate_hz),
      sideways_(script.rate_hz),
      most_poses_(most_poses) {}

void Hand::move(const Path& path, double speed_mm_s, bool trim) {
  std::vector<double> length{0.0};
  for (std::size_t k = 1; k < path.size(); ++k)
    length.push_back(length.back() + glm::distance(path[k - 1].at, path[k].at));
  // Strokes of a hand vary in speed.
  const double speed = speed_mm_s * (0.95 + 0.05 * noise(random_));
  const auto ticks = static_cast<std::int64_t>(length.back() * 1.875 / speed * script_.rate_hz) + 1;
  std::size_t k = 0;
  for (std::int64_t n = 1; n <= ticks; ++n) {
    const double u = static_cast<double>(n) / static_cast<double>(ticks);
    const double s = length.back() * u * u * u * (10.0 + u * (6.0 * u - 15.0));
    while (k + 2 < path.size() && length[k + 1] < s) ++k;
    const double piece = length[k + 1] - length[k];
    emit(piece > 0.0 ? between(path[k], path[k + 1], (s - length[k]) / piece) : path[k], trim);
  }
}

void Hand::travel(const Path& path) {
  travels_ = true;
  released_ = touched_;
  move(path, script_.travel_mm_s, false);
  travels_ = false;
}

void Hand::hold(double seconds, bool trim) {
  const auto ticks = static_cast<int>(seconds * script_.rate_hz);
  for (int n = 0; n < ticks; ++n) emit(here_, trim);
}

void Hand::emit(const Place& place, bool trim) {
  here_ = place;
  full_ = full_ || poses_.size() == most_poses_;
  if (full_) return;
  // In separate statements, because compilers differ in the order of evaluating arguments.
  glm::dvec3 hip(place.at, 0.0);
  hip.x += script_.tremor_mm * radial_.next(random_);
  hip.y += script_.tremor_mm * vertical_.next(random_);
  hip.z += script_.tremor_mm * sideways_.next(random_);
  const auto time =
      static_cast<std::int64_t>(static_cast<double>(poses_.size()) * 1e6 / script_.rate_hz);
  poses_.push_back(quantized({time, hip, trim, place.gap_mm}));
  const StepReport step = wheel_.step(poses_.back());
  touched_ = (step.flags & kContact) != 0 ? step.rings_touched : 0;
  if (touched_ == 0) {
    released_ = 0;
    return;
  }
  touch_.last = poses_.size() - 1;
  if (touch_.first == 0) touch_.first = touch_.last;
  if (travels_ && touched_ > released_) obstacle_ = {obstacle_.ticks + 1, place.at.y};
}

}  // namespace clay::strokes
