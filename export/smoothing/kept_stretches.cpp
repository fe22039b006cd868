#include "export/smoothing/kept_stretches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clay::solid::inline smoothing {
namespace {
constexpr double kNotKept = std::numeric_limits<double>::infinity();
}

void KeptStretches::add(std::size_t interface, double figure) {
  if (least_.empty()) least_.assign(piece_.size() + 1, kNotKept);
  least_[interface] = std::min(least_[interface], figure);
}

std::vector<char> KeptStretches::rings() const {
  std::vector<char> flags(piece_.size(), 0);
  for (std::size_t k = 1; k < least_.size(); ++k)
    if (least_[k] != kNotKept) flags[k - 1] = flags[std::min(k, piece_.size() - 1)] = 1;
  return flags;
}

void KeptStretches::report(KeptFor reason, const std::vector<double>& walls_mm,
                           std::vector<KeptSteps>& reports) const {
  for (std::size_t k = 0; k < least_.size(); ++k) {
    if (least_[k] == kNotKept) continue;
    const std::size_t first = k;
    double figure = least_[k];
    while (k + 1 < least_.size() && least_[k + 1] != kNotKept)
      figure = std::min(figure, least_[++k]);
    KeptSteps kept{piece_.level[first], piece_.level[k], reason, std::abs(figure), 0.0};
    if (!walls_mm.empty()) {
      const auto begin = walls_mm.begin();
      kept.kept_mm = *std::min_element(begin + static_cast<std::ptrdiff_t>(first - 1),
                                       begin + static_cast<std::ptrdiff_t>(k + 1));
    }
    reports.push_back(kept);
  }
}

}  // namespace clay::solid::inline smoothing
