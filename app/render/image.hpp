#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace clay::render {

/// Pixels row by row from the upper left, four bytes each: red, green, blue (sRGB), alpha.
struct Image {
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgba;  ///< 4 width height
  [[nodiscard]] const std::uint8_t* at(int x, int y) const noexcept {
    return &rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                      static_cast<std::size_t>(x))];
  }
  [[nodiscard]] std::uint8_t* at(int x, int y) noexcept {
    return const_cast<std::uint8_t*>(std::as_const(*this).at(x, y));
  }
  friend bool operator==(const Image&, const Image&) = default;
};

}  // namespace clay::render
