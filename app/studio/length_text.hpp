#pragma once
// Lengths as people read them.

#include "app/studio/settings.hpp"

#include <string>

namespace clay::studio {

struct UnitText {
  double mm;  ///< of one unit
  const char* name;
  int digits;  ///< behind the point
};
[[nodiscard]] UnitText unit_text(LengthUnit unit);

/// "12.5 mm", "1.25 cm", "0.49 in".
[[nodiscard]] std::string length_text(double mm, LengthUnit unit);

}  // namespace clay::studio
