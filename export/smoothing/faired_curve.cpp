#include "export/smoothing/faired_curve.hpp"

#include "core/cancel.hpp"
#include "export/solid/banded_system.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace clay::solid::inline smoothing {
namespace {

constexpr double kKnotsPerLength = 32.0;  ///< more only cost digits: the penalty grows by its sixth
constexpr std::size_t kBand = 3;
constexpr std::array<double, kBand + 1> kThirdDifference = {-1.0, 3.0, -3.0, 1.0};

/// The four uniform cubic B-splines of an interval at t.
std::array<double, kBand + 1> basis(double t) {
  const double s = 1.0 - t;
  return {s * s * s / 6.0, (3.0 * t * t * (t - 2.0) + 4.0) / 6.0,
          (3.0 * s * s * (s - 2.0) + 4.0) / 6.0, t * t * t / 6.0};
}

}  // namespace

FairedCurve::FairedCurve(const RunOfRings& run, const std::vector<double>& lengths_mm) : run_(run) {
  const auto begin = lengths_mm.begin();
  const double longest =
      *std::max_element(begin + std::ptrdiff_t(run.first), begin + std::ptrdiff_t(run.end));
  const double height = run.top_mm() - run.bottom_mm();
  const double wanted =
      std::max(run.piece.ring_height_mm, std::min(longest, height) / kKnotsPerLength);
  intervals_ = static_cast<std::size_t>(std::max(1.0, std::ceil(height / wanted)));
  spacing_mm_ = height / static_cast<double>(intervals_);
  base_mm_ = run.wall.radius[run.first];
  fit(stiffness(lengths_mm));
}

FairedCurve::Place FairedCurve::place_of(double y) const {
  const double at = std::max(0.0, (y - run_.bottom_mm()) / spacing_mm_);
  const std::size_t interval = std::min(static_cast<std::size_t>(at), intervals_ - 1);
  return {interval, std::min(at - static_cast<double>(interval), 1.0)};
}

double FairedCurve::radius(Place place) const {
  const auto weights = basis(place.t);
  double sum = 0.0;
  for (std::size_t a = 0; a <= kBand; ++a) sum += weights[a] * coeffs_[place.interval + a];
  return base_mm_ + sum;
}

double FairedCurve::at(double y) const { return radius(place_of(y)); }

/// (l / (2 pi spacing))^6 by interval.
std::vector<double> FairedCurve::stiffness(const std::vector<double>& lengths_mm) const {
  std::vector<double> lengths(intervals_);
  std::size_t ring = run_.first;
  for (std::size_t j = 0; j < intervals_; ++j) {
    const double middle = run_.bottom_mm() + (static_cast<double>(j) + 0.5) * spacing_mm_;
    while (ring + 1 < run_.end && run_.piece.level[ring + 1] < middle) ++ring;
    lengths[j] = std::min({lengths_mm[ring], middle - run_.bottom_mm(), run_.top_mm() - middle});
  }
  for (std::size_t i = run_.first; i < run_.end; ++i) {
    step_of_loop();
    double& length = lengths[place_of(run_.middle_mm(i)).interval];
    length = std::min(length, lengths_mm[i]);
  }
  for (double& length : lengths) {
    const double least = kLeastFairedLength * run_.piece.ring_height_mm;
    const double ratio = std::max(length, least) / (2.0 * std::numbers::pi * spacing_mm_);
    const double cube = ratio * ratio * ratio;
    length = cube * cube;
  }
  return lengths;
}

void FairedCurve::fit(const std::vector<double>& stiffness) {
  BandedSystem<kBand, 1> system(intervals_ + kBand);
  const double weight = run_.piece.ring_height_mm / spacing_mm_;
  for (std::size_t i = run_.first; i < run_.end; ++i) {
    step_of_loop();
    const Place place = place_of(run_.middle_mm(i));
    system.add(place.interval, basis(place.t), weight, {run_.wall.radius[i] - base_mm_});
  }
  for (std::size_t j = 0; j < intervals_; ++j) system.add(j, kThirdDifference, stiffness[j], {0.0});
  for (const auto& [coeff] : std::move(system).solved()) coeffs_.push_back(coeff);
}

/// The number of chords in each interval: u'' is linear between knots, and a chord of height d is
/// within |u''| d^2 / 8 of the curve.
std::vector<std::size_t> FairedCurve::chords_of_intervals(double sagitta_mm) const {
  const auto bend = [&](std::size_t knot) {
    return std::abs(coeffs_[knot] - 2.0 * coeffs_[knot + 1] + coeffs_[knot + 2]);
  };
  std::vector<double> wanted(intervals_);
  double sum = 0.0;
  for (std::size_t j = 0; j < intervals_; ++j) {
    const double needed = std::ceil(std::sqrt(std::max(bend(j), bend(j + 1)) / (8.0 * sagitta_mm)));
    wanted[j] = std::min(needed, kMostPoints);  // infinite for a tiny sagitta
    sum += wanted[j];
  }
  const double share = std::min(1.0, kMostPoints / std::max(sum, 1.0));
  std::vector<std::size_t> chords(intervals_);
  for (std::size_t j = 0; j < intervals_; ++j)
    chords[j] = std::max<std::size_t>(1, static_cast<std::size_t>(share * wanted[j]));
  return chords;
}

Polygon FairedCurve::points(double sagitta_mm) const {
  const std::vector<std::size_t> chords = chords_of_intervals(sagitta_mm);
  Polygon line{{radius({0, 0.0}), run_.bottom_mm()}};
  for (std::size_t j = 0; j < intervals_; ++j)
    for (std::size_t k = 1; k <= chords[j]; ++k) {
      step_of_loop();
      const double t = static_cast<double>(k) / static_cast<double>(chords[j]);
      const double knots = static_cast<double>(j) + t;
      line.push_back({radius({j, t}), run_.bottom_mm() + knots * spacing_mm_});
    }
  line.back().y = run_.top_mm();
  return line;
}

}  // namespace clay::solid::inline smoothing
