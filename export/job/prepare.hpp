#pragma once
// The first stage of every export: the pot in the size of its files, with its drain.

#include "claystack/core/result.hpp"
#include "claystack/export/job.hpp"

#include <string>

namespace clay::solid::inline job {

struct DrainedStack {
  ClayStack stack;
  double drilled_mm3 = 0.0;  ///< clay that the drill took
};

/// The stack with a hole of this diameter along the axis, from its foot up into the uppermost
/// closed cavity, so that no cavity stays closed; through floors in the way as well. Errors
/// (bad_input): no cavity to drain; a hole that leaves a ring, named, without a wall.
Result<DrainedStack> drain(const ClayStack& stack, double diameter_mm);

struct PreparedPot {
  Pot pot;
  Preparation done;
  std::optional<WallLimit> limit;  ///< asked of a solid of about this size
};

/// Enlarged and drained as the options ask. Errors: as `enlarged` and `drain`; a collapsed pot
/// cannot be drained.
Result<PreparedPot> prepare(const Pot& pot, const ExportOptions& options);

/// The error with `name` before it, unless it begins with it.
template <class T>
Result<T> named(Result<T> result, const std::string& name) {
  if (result || name.empty() || result.error().message.starts_with(name)) return result;
  return failure(result.error().kind, name + ": " + result.error().message);
}

}  // namespace clay::solid::inline job
