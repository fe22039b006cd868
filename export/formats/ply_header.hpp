#pragma once
// The header of a PLY file: the contents of its elements, and the offset of the first one.

#include "claystack/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats::ply {

enum class Number { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
[[nodiscard]] std::size_t bytes_of(Number type) noexcept;
[[nodiscard]] constexpr bool is_whole(Number type) noexcept {
  return type != Number::float32 && type != Number::float64;
}

struct Property {
  std::string name;
  Number type = Number::float32;
  std::optional<Number> count_type;  ///< of a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
  std::size_t line = 0;
};

enum class Encoding { text, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  std::size_t bytes = 0;  ///< the elements begin there
  std::size_t lines = 0;
  std::size_t stray_lines = 0;  ///< before the first element, without a keyword of PLY
  std::size_t stray_line = 0;   ///< the first of them
};

/// Also checks that the file has room for every element.
[[nodiscard]] Result<Header> read_header(std::string_view file, std::string_view name);

}  // namespace clay::solid::inline formats::ply
