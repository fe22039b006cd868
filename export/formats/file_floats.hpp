#pragma once
// Coordinates in files: float32, and never -0, because readers that compare bytes treat -0 and 0 as
// two points and find an open edge.

#include "core/text.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats {

/// Adds 0, because -0 + 0 is 0, and because GCC 12 at -O3 drops the rounding of a vector to float
/// and back (`glm::dvec3(glm::vec3(p))` is `p`).
[[nodiscard]] inline glm::vec3 file_point(const glm::dvec3& point) noexcept {
  return glm::vec3(point) + 0.0F;
}

[[nodiscard]] inline std::vector<glm::vec3> file_points(const std::vector<glm::dvec3>& points) {
  std::vector<glm::vec3> rounded;
  rounded.reserve(points.size());
  for (const glm::dvec3& point : points) rounded.push_back(file_point(point));
  return rounded;
}

/// Rounds the points of a mesh to those that a file can hold.
inline void round_to_file(std::vector<glm::dvec3>& points) noexcept {
  for (glm::dvec3& point : points) point = file_point(point);
}

/// Writes the fewest digits that read back as the same number, independent of the locale.
template <class Number>
void append_number(std::string& text, Number value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// Two digits.
inline void append_hexadecimal(std::string& text, std::uint8_t byte) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  text += kDigits[byte >> 4U];
  text += kDigits[byte & 15U];
}

/// "PREFIX x y z\n"
inline void append_point_line(std::string& text, std::string_view prefix, const glm::vec3& point) {
  text += prefix;
  for (int axis = 0; axis < 3; ++axis) {
    text += ' ';
    append_number(text, point[axis]);
  }
  text += '\n';
}

/// Valid UTF-8 that cannot end or continue its line, or exceed the limits of readers.
[[nodiscard]] inline std::string one_line(std::string_view name) {
  constexpr std::size_t kLongestName = 200;
  std::string line = valid_text(name);
  std::size_t end = std::min(line.size(), kLongestName);
  while (end < line.size() && (line[end] & 0xC0) == 0x80) --end;  // before a whole character
  line.resize(end);
  for (char& c : line) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    if (control || c == '\\') c = '_';
  }
  return line;
}

}  // namespace clay::solid::inline formats
