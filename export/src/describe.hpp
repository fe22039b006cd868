#pragma once
// Numbers and findings as messages for people show them.

#include "claystack/export/mesh_check.hpp"

#include <array>
#include <charconv>
#include <string>
#include <string_view>

namespace clay::solid {

/// Nine significant digits: enough to tell two neighbouring float32 apart.
inline std::string in_mm(double mm) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), mm,
                                 std::chars_format::general, 9);
  return {digits.data(), end.ptr};
}

/// Six significant digits, with an exponent where the number is very large or small.
inline std::string number_text(double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::general, 6);
  return {digits.data(), end.ptr};
}

/// What a file is by its first bytes, such as "a Draco mesh"; empty where they do not say.
[[nodiscard]] std::string_view known_kind(std::string_view bytes);
/// The same for a message; else "text that begins with 'abc'", "data that is no text".
[[nodiscard]] std::string kind_of_file(std::string_view bytes);

/// "open edge (3): triangle 12 at (1, 2, 3) mm"
inline std::string describe(const MeshProblem& problem) {
  return problem.what + " (" + std::to_string(problem.count) + "): " + problem.where;
}

}  // namespace clay::solid
