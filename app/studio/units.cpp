#include "app/studio/units.hpp"

#include <fmt/format.h>

#include <cmath>

namespace clay::studio {

UnitText unit_text(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::cm:
      return {10.0, "cm", 2};
    case LengthUnit::in:
      return {25.4, "in", 2};
    case LengthUnit::mm:
      break;
  }
  return {1.0, "mm", 1};
}

std::string length_text(double mm, LengthUnit unit, int more_digits) {
  const UnitText text = unit_text(unit);
  return fmt::format("{:.{}f} {}", mm / text.mm, text.digits + more_digits, text.name);
}

int thickness_digits(LengthUnit unit) {
  return unit_text(unit).digits + (unit == LengthUnit::in ? 1 : 0);
}

std::string thickness_text(double mm, LengthUnit unit) {
  return length_text(mm, unit, thickness_digits(unit) - unit_text(unit).digits);
}

std::string mass_text(double grams) {
  if (std::abs(grams) >= 1000.0) return fmt::format("{:.3f} kg", 1e-3 * grams);
  return fmt::format("{:.1f} g", grams);
}

std::string capacity_text(double mm3) {
  const double ml = 1e-3 * mm3;
  if (ml >= 1000.0) return fmt::format("{:.2f} l", 1e-3 * ml);
  return fmt::format("{:.{}f} ml", ml, ml < 10.0 ? 1 : 0);
}

}  // namespace clay::studio
