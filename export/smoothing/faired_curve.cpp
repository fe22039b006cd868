#include "export/smoothing/faired_curve.hpp"

#include "core/cancel.hpp"

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

/// A symmetric positive definite system whose matrix has kBand diagonals beside the main one.
class BandedSystem {
 public:
  explicit BandedSystem(std::size_t size) : rows_(size), right_(size, 0.0) {}

  /// Adds weight (sum of factors times the unknowns from `first` on - value)^2 to what is
  /// minimised.
  void add(std::size_t first, const std::array<double, kBand + 1>& factors, double weight,
           double value) {
    for (std::size_t a = 0; a <= kBand; ++a) {
      for (std::size_t b = 0; b <= a; ++b)
        rows_[first + a][a - b] += weight * factors[a] * factors[b];
      right_[first + a] += weight * factors[a] * value;
    }
  }

  /// By L D L^T.
  std::vector<double> solved() && {
    const std::size_t n = rows_.size();
    for (std::size_t i = 0; i < n; ++i) eliminate(i);
    for (std::size_t i = n; i-- > 0;)
      for (std::size_t d = 1; d <= kBand && i + d < n; ++d)
        right_[i] -= rows_[i + d][d] * right_[i + d];
    return std::move(right_);
  }

 private:
  /// Leaves D in [i][0], L in [i][1..] and D^-1 L^-1 of the right side.
  void eliminate(std::size_t i) {
    step_of_loop();
    const std::size_t reach = std::min(kBand, i);
    std::array<double, kBand + 1>& row = rows_[i];
    for (std::size_t d = reach; d > 0; --d) {
      double sum = row[d];  // of L times D
      for (std::size_t e = reach; e > d; --e) sum -= row[e] * rows_[i - d][e - d];
      row[d] = sum;
    }
    double right = right_[i];
    for (std::size_t d = reach; d > 0; --d) {
      const double scaled = row[d], pivot = rows_[i - d][0];
      row[d] = scaled / pivot;
      row[0] -= row[d] * scaled;
      right -= scaled * right_[i - d];
    }
    right_[i] = right / row[0];
  }

  std::vector<std::array<double, kBand + 1>> rows_;  ///< [i][d]: the entry (i, i - d)
  std::vector<double> right_;
};

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
  BandedSystem system(intervals_ + kBand);
  const double weight = run_.piece.ring_height_mm / spacing_mm_;
  for (std::size_t i = run_.first; i < run_.end; ++i) {
    step_of_loop();
    const Place place = place_of(run_.middle_mm(i));
    system.add(place.interval, basis(place.t), weight, run_.wall.radius[i] - base_mm_);
  }
  for (std::size_t j = 0; j < intervals_; ++j) system.add(j, kThirdDifference, stiffness[j], 0.0);
  coeffs_ = std::move(system).solved();
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
    wanted[j] = std::ceil(std::sqrt(std::max(bend(j), bend(j + 1)) / (8.0 * sagitta_mm)));
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
