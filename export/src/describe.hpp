#pragma once
// Numbers and findings as messages for people show them.

#include "claystack/export/mesh_check.hpp"

#include <array>
#include <charconv>
#include <string>

namespace clay::solid {

/// Nine significant digits: enough to tell two neighbouring float32 apart.
inline std::string in_mm(double mm) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), mm,
                                 std::chars_format::general, 9);
  return {digits.data(), end.ptr};
}

/// "open edge (3): triangle 12 at (1, 2, 3) mm"
inline std::string describe(const MeshProblem& problem) {
  return problem.what + " (" + std::to_string(problem.count) + "): " + problem.where;
}

}  // namespace clay::solid
