#pragma once
#include <charconv>
#include <string>

namespace clay {

/// The shortest decimal that reads back as the same number. std::to_string gives 1e-9 as 0.000000,
/// and 300 digits of 1e300.
[[nodiscard]] inline std::string number_text(double value) {
  char text[32];  // the longest has 24
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace clay
