#pragma once
#include <rapidcheck.h>

namespace clay::falcon {

/// Uniform from the first case on: RapidCheck alone would start near `low`.
inline double within(double low, double high) {
  const auto step = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 1'000'001));
  return low + (high - low) * step / 1e6;
}

}  // namespace clay::falcon
