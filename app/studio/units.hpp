#pragma once
// Quantities as text.

#include <string>

namespace clay::studio {

enum class LengthUnit { mm, cm, in };

struct UnitText {
  double mm;  ///< millimetres in one unit
  const char* name;
  int digits;  ///< decimals
};
[[nodiscard]] UnitText unit_text(LengthUnit unit);

/// "12.5 mm", "1.25 cm", "0.49 in"; with `more_digits` 1 "12.51 mm".
[[nodiscard]] std::string length_text(double mm, LengthUnit unit, int more_digits = 0);
/// Of a wall, where hundredths of an inch are too coarse: "4.5 mm", "0.45 cm", "0.177 in".
[[nodiscard]] std::string thickness_text(double mm, LengthUnit unit);
/// The decimals of such a text.
[[nodiscard]] int thickness_digits(LengthUnit unit);
/// "3.2 g", "1.250 kg".
[[nodiscard]] std::string mass_text(double grams);
/// "9.5 ml", "340 ml", "1.20 l".
[[nodiscard]] std::string capacity_text(double mm3);

}  // namespace clay::studio
