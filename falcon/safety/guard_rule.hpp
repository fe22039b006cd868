#pragma once
// The rules of the guard by name, so that tests can take one away and see what gets through.

#include <cstdint>

namespace clay::falcon::inline safety {

enum GuardRule : std::uint32_t {
  kRuleFinite = 1u << 0,
  kRuleNotFiniteLatch = 1u << 1,
  kRuleLimit = 1u << 2,
  kRuleSlew = 1u << 3,
  kRuleSmallForce = 1u << 4,
  kRuleRamp = 1u << 5,
  kRuleReady = 1u << 6,
  kRuleStaleFrames = 1u << 7,
  kRulePause = 1u << 8,
  kRuleJump = 1u << 9,
  kRuleStep = 1u << 10,
  kRuleLate = 1u << 11,
  kRuleOverrun = 1u << 12,
  kRuleOldClay = 1u << 13,
  kRulePassive = 1u << 14,
  kRuleHeat = 1u << 15,
  kRuleLatch = 1u << 16,
  kRuleStop = 1u << 17,
};

struct NamedGuardRule {
  GuardRule rule;
  const char* name;
};

inline constexpr NamedGuardRule kGuardRules[] = {
    {kRuleFinite, "finite or zero"},
    {kRuleNotFiniteLatch, "three not finite are SAFE"},
    {kRuleLimit, "limit of the norm"},
    {kRuleSlew, "slew"},
    {kRuleSmallForce, "small force first"},
    {kRuleRamp, "ramp"},
    {kRuleReady, "ready or zero"},
    {kRuleStaleFrames, "stale frames fade"},
    {kRulePause, "after a pause, again"},
    {kRuleJump, "jumps"},
    {kRuleStep, "step within bounds"},
    {kRuleLate, "late tick is zero"},
    {kRuleOverrun, "overrun is SAFE"},
    {kRuleOldClay, "old clay fades"},
    {kRulePassive, "passive or SAFE"},
    {kRuleHeat, "heat"},
    {kRuleLatch, "SAFE holds"},
    {kRuleStop, "stop is for good"},
};

}  // namespace clay::falcon::inline safety
