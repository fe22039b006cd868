#include "app/studio/length_text.hpp"

#include <fmt/format.h>

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

std::string length_text(double mm, LengthUnit unit) {
  const UnitText text = unit_text(unit);
  return fmt::format("{:.{}f} {}", mm / text.mm, text.digits, text.name);
}

}  // namespace clay::studio
