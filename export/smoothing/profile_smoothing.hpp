#pragma once
#include "claystack/export/smoothing.hpp"

namespace clay::solid::inline smoothing {

/// `smooth_profile_of` for a stack whose steps are known already.
Result<SmoothedProfile> smoothed_profile(const ClayStack& stack, StackProfile steps,
                                         const SmoothingOptions& options);

}  // namespace clay::solid::inline smoothing
