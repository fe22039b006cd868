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
/// "80 mm/s", "8.0 cm/s", "3.1 in/s".
[[nodiscard]] std::string speed_text(double mm_s, LengthUnit unit);
/// "0.02 mm", "0.002 cm", "0.000787 in".
[[nodiscard]] std::string tolerance_text(double mm, LengthUnit unit);
/// "3.2 g", "1.250 kg"; a mass that rounds to 1000 g is 1.000 kg, here and below.
[[nodiscard]] std::string mass_text(double grams);
/// "3 g", "1.25 kg".
[[nodiscard]] std::string short_mass_text(double grams);
/// "9.5 ml", "340 ml", "1.20 l".
[[nodiscard]] std::string capacity_text(double mm3);

}  // namespace clay::studio
