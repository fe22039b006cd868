#pragma once
// The differences between a pot and its goal: the figures of `claystack export --holds --height
// --diameter`.

#include "app/studio/units.hpp"
#include "claystack/export/maker.hpp"

#include <string>

namespace clay::studio {

inline constexpr double kMostGoalMl = 5000.0, kMostGoalMm = 600.0, kMostShrinkagePercent = 25.0;

/// 0: no goal of this kind.
struct PotGoal {
  double holds_ml = 0.0;                      ///< to the brim, at most kMostGoalMl
  double height_mm = 0.0, diameter_mm = 0.0;  ///< at most kMostGoalMm
  /// Of each length, from the pot on the wheel to the fired one; 0: the goal is that on the wheel.
  double shrinkage_percent = 0.0;
  [[nodiscard]] bool set() const noexcept {
    return holds_ml > 0.0 || height_mm > 0.0 || diameter_mm > 0.0;
  }
  friend bool operator==(const PotGoal&, const PotGoal&) = default;
};

/// Part of a figure by which it may miss its goal.
inline constexpr double kGoalPart = 0.02;

struct GoalReading {
  std::string text;  ///< "Holds 312 of 350 ml, 142 of 150 mm high after firing"
  bool met = true;   ///< every figure is within kGoalPart
};
[[nodiscard]] GoalReading read_goal(const PotGoal& goal, const solid::MakerNumbers& numbers,
                                    LengthUnit unit);

}  // namespace clay::studio
