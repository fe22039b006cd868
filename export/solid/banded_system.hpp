#pragma once
// Least squares in which each unknown is coupled only with its neighbours, such as the control
// points of a spline.

#include "core/cancel.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace clay::solid {

/// A symmetric positive definite system whose matrix has `band` diagonals beside the main one. Each
/// unknown is a vector of `size` numbers.
template <std::size_t band, std::size_t size>
class BandedSystem {
 public:
  using Factors = std::array<double, band + 1>;
  using Vector = std::array<double, size>;

  explicit BandedSystem(std::size_t unknowns) : rows_(unknowns), right_(unknowns) {}

  /// Adds a term to the sum that `solved` minimises: weight (s - value)^2, where s is the sum of
  /// the factors times the unknowns from `first` on.
  void add(std::size_t first, const Factors& factors, double weight, const Vector& value) {
    for (std::size_t a = 0; a <= band; ++a) {
      for (std::size_t b = 0; b <= a; ++b)
        rows_[first + a][a - b] += weight * factors[a] * factors[b];
      subtract(right_[first + a], -(weight * factors[a]), value);
    }
  }

  /// By L D L^T.
  std::vector<Vector> solved() && {
    const std::size_t n = rows_.size();
    for (std::size_t i = 0; i < n; ++i) eliminate(i);
    for (std::size_t i = n; i-- > 0;)
      for (std::size_t d = 1; d <= band && i + d < n; ++d)
        subtract(right_[i], rows_[i + d][d], right_[i + d]);
    return std::move(right_);
  }

 private:
  static void subtract(Vector& from, double factor, const Vector& what) {
    for (std::size_t k = 0; k < size; ++k) from[k] -= factor * what[k];
  }

  /// Leaves D in [i][0], L in [i][1..] and D^-1 L^-1 of the right side.
  void eliminate(std::size_t i) {
    step_of_loop();
    const std::size_t reach = std::min(band, i);
    Factors& row = rows_[i];
    for (std::size_t d = reach; d > 0; --d) {
      double sum = row[d];  // of L times D
      for (std::size_t e = reach; e > d; --e) sum -= row[e] * rows_[i - d][e - d];
      row[d] = sum;
    }
    Vector right = right_[i];
    for (std::size_t d = reach; d > 0; --d) {
      const double scaled = row[d], pivot = rows_[i - d][0];
      row[d] = scaled / pivot;
      row[0] -= row[d] * scaled;
      subtract(right, scaled, right_[i - d]);
    }
    for (std::size_t k = 0; k < size; ++k) right_[i][k] = right[k] / row[0];
  }

  std::vector<Factors> rows_;  ///< [i][d]: the entry (i, i - d)
  std::vector<Vector> right_;
};

}  // namespace clay::solid
