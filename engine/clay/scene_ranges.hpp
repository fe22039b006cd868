#pragma once
// The ranges of a scene's settings. StepPlan checks a scene from memory by them, and the readers of
// files check scenes and pots: so a pot can be read if its wheel could be built.

#include "claystack/engine/clay.hpp"
#include "core/range.hpp"

namespace clay::ranges {

inline constexpr Range kRings = from(1).to(static_cast<double>(kMaxRings));
inline constexpr Range kRingLimit = from(0).to(static_cast<double>(kMaxRings));  ///< 0: default
inline constexpr Range kRingHeightMm = from(kMinRingHeightMm).to(kMaxRingHeightMm);
inline constexpr Range kDensity = from(kMinDensityGCm3).to(kMaxDensityGCm3);
inline constexpr Range kGapMm = from(kMinRadiusMm).to(1e3);

inline constexpr Range kRatePerS = from(0).to(1e6);
inline constexpr Range kYieldDepthMm = from(1e-3).to(1e3);
inline constexpr Range kMinWallMm = from(kMinRadiusMm).to(1e3);
/// k = 1 would remove the whole wall, k > 1 turn it inside out.
inline constexpr Range kPaperFraction = from(0).below(1);

inline constexpr Range kSigmaMm = from(0).to(1e9);
inline constexpr Range kReachMm = from(0).to(1e9);
inline constexpr Range kInsideShare = from(0).to(1);

inline constexpr Range kStiffness = from(0).to(1e6);       ///< [N/mm^2]
inline constexpr Range kPaperStiffness = from(0).to(1e6);  ///< [N/mm]
inline constexpr Range kForceLimitN = from(0).to(10);
inline constexpr Range kFriction = from(0).to(2);
inline constexpr Range kMaxStressKpa = above(0).to(1e6);

inline constexpr Range kWheelRpm = from(0).to(1e3);
inline constexpr Range kFloorMm = from(0).to(1e6);
inline constexpr Range kFingerMm = from(0).to(200);
inline constexpr Range kFingerBehind = from(0).to(4);
inline constexpr Range kHeaveSlope = from(0.05).to(2);

}  // namespace clay::ranges
