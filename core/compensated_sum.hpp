#pragma once
#include <cmath>

namespace clay {

/// Neumaier's summation: the error stays within one or two ulp of the sum for any number of terms,
/// so that the volume of a mesh of millions of triangles can be compared with counted clay.
class CompensatedSum {
 public:
  void add(double term) noexcept {
    const double next = sum_ + term;
    lost_ += std::abs(sum_) >= std::abs(term) ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
  }
  [[nodiscard]] double value() const noexcept { return sum_ + lost_; }

 private:
  double sum_ = 0.0;
  double lost_ = 0.0;
};

}  // namespace clay
