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

std::string speed_text(double mm_s, LengthUnit unit) { return length_text(mm_s, unit, -1) + "/s"; }

std::string tolerance_text(double mm, LengthUnit unit) {
  const UnitText text = unit_text(unit);
  return fmt::format("{:.3g} {}", mm / text.mm, text.name);
}

namespace {

/// With this many decimals the text of `value` is below that of `limit`.
bool shows_below(double value, double limit, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::round(scale * std::abs(value)) < std::round(scale * limit);
}

}  // namespace

std::string mass_text(double grams) {
  if (shows_below(grams, 1000.0, 1)) return fmt::format("{:.1f} g", grams);
  return fmt::format("{:.3f} kg", 1e-3 * grams);
}

std::string short_mass_text(double grams) {
  if (shows_below(grams, 1000.0, 0)) return fmt::format("{:.0f} g", grams);
  return fmt::format("{:.2f} kg", 1e-3 * grams);
}

std::string capacity_text(double mm3) {
  const double ml = 1e-3 * mm3;
  if (!shows_below(ml, 1000.0, 0)) return fmt::format("{:.2f} l", 1e-3 * ml);
  return fmt::format("{:.{}f} ml", ml, shows_below(ml, 10.0, 1) ? 1 : 0);
}

}  // namespace clay::studio
