#include "app/bench/extreme/suite.hpp"

#include <vector>

namespace clay::extreme {

std::span<const Case> cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> sum;
    for (const auto part : {shape_cases(), flow_cases(), input_cases(), force_cases(),
                            stability_cases(), pinch_cases(), rule_cases(), step_cases()})
      sum.insert(sum.end(), part.begin(), part.end());
    return sum;
  }();
  return all;
}

}  // namespace clay::extreme
