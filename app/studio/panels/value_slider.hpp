#pragma once
// Sliders with their value as text. A click on the text, or F2 on the slider, opens a field in
// which the value can be typed, with a unit as on the command line.

#include "app/cli/quantity.hpp"
#include "app/studio/units.hpp"

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace clay::studio {

/// How a typed value is read: in one of the units, or without one as the shown text.
struct ValueUnits {
  std::span<const cli::Unit> all;
  double per_value = 1.0;       ///< amount of the first unit in 1 of the slider
  std::string_view usual = {};  ///< of a number alone, where the shown text has no unit
};
inline constexpr std::array kPlainUnits{cli::Unit{"", 1.0}};
inline constexpr ValueUnits kPlain{kPlainUnits};
inline constexpr std::array kPercentUnits{cli::Unit{"%", 1.0}};
inline constexpr ValueUnits kPercent{kPercentUnits};
/// Of a slider in mm, and of one in mm/s.
[[nodiscard]] ValueUnits lengths_in(LengthUnit unit);
inline constexpr std::array kSpeedUnits{cli::Unit{"mm/s", 1.0}, cli::Unit{"cm/s", 10.0},
                                        cli::Unit{"in/s", 25.4}};
inline constexpr ValueUnits kSpeeds{kSpeedUnits};
/// In ml; in g; in kg.
inline constexpr ValueUnits kVolumes{cli::kVolumeUnits}, kWeights{cli::kWeightUnits},
    kKilograms{cli::kWeightUnits, 1000.0, "kg"};

/// A label, its value at the right, and below them a slider as wide as the panel. Returns true if
/// the value has changed. `flags`: of ImGui's sliders.
bool panel_slider(const char* label, float& value, float low, float high, const std::string& text,
                  const ValueUnits& units, int flags = 0);
/// For a length in mm, logarithmic, shown in `unit`.
bool length_slider(const char* label, double& mm, double low_mm, double high_mm, LengthUnit unit);

/// In a line of a dialog (`form_row`), with the value beside it, or above it in a narrow dialog.
bool form_slider(const char* label, float& value, float low, float high, const std::string& text,
                 const ValueUnits& units, int flags = 0);
/// For a length; `none`: text shown for 0.
bool form_length(const char* label, double& mm, double low_mm, double high_mm, LengthUnit unit,
                 const char* none = nullptr);

}  // namespace clay::studio
