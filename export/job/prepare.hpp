#pragma once
// The first stage of every export: scales the pot to the size of its files and drills its drain.

#include "claystack/core/result.hpp"
#include "claystack/export/job.hpp"

#include <string>

namespace clay::solid::inline job {

/// The pot with its radii and heights multiplied. Squared radii are rounded to the nearest quantum;
/// the ledger begins with the clay of the result. Errors (bad_input): beyond the limits of
/// ClayStack.
Result<Pot> scaled(const Pot& pot, double radius_factor, double height_factor);

struct DrainedStack {
  ClayStack stack;
  double drilled_mm3 = 0.0;  ///< clay removed by the drill
};

/// Drills a hole of this diameter along the axis, from the foot up into the uppermost closed
/// cavity, through all floors between, so that no cavity remains closed. Errors (bad_input): no
/// cavity to drain; a hole that leaves a ring without a wall (the message names the ring).
Result<DrainedStack> drain(const ClayStack& stack, double diameter_mm);

struct PreparedPot {
  Pot pot;
  Preparation done;
  std::optional<WallLimit> limit;  ///< the limit for a solid of about this size
};

/// Enlarges and drains the pot as the options request. Errors: as for `enlarged` and `drain`; a
/// collapsed pot cannot be drained.
Result<PreparedPot> prepare(const Pot& pot, const ExportOptions& options);

/// Puts `name` in front of the error unless it is there already.
template <class T>
Result<T> named(Result<T> result, const std::string& name) {
  if (result || name.empty() || result.error().message.starts_with(name + ": ")) return result;
  return failure(result.error().kind, name + ": " + result.error().message);
}

}  // namespace clay::solid::inline job
