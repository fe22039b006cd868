#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace clay::draw {

/// Pixels row by row from the upper left, four bytes each: red, green, blue (sRGB), alpha.
struct Image {
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgba;  ///< 4 width height
  [[nodiscard]] const std::uint8_t* at(int x, int y) const noexcept {
    return &rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                      static_cast<std::size_t>(x))];
  }
  friend bool operator==(const Image&, const Image&) = default;
};

}  // namespace clay::draw
