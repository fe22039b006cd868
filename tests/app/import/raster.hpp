#pragma once
// Drawings as pixels: by a rasteriser of these tests, and by librsvg.

#include "app/import/drawing.hpp"

#include <string>
#include <vector>

namespace clay::importing::raster {

/// Grey levels from 0 (paper) to 1 (ink), row by row from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<float> ink;

  [[nodiscard]] float at(int x, int y) const {
    return ink[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x)];
  }
  /// The sum of all pixels.
  [[nodiscard]] double area() const;
};

/// The inside of the lines by the even-odd rule, with open lines closed. The page begins at (0, 0)
/// mm and extends to the right and down.
Image drawn(const std::vector<Line>& lines, int width, int height, double pixels_per_mm);

/// The picture of an SVG file by rsvg-convert: ink is alpha. Empty if it fails.
Image rendered(const std::string& svg_path, int width, int height, const std::string& scratch);

/// The largest difference of ink of two images of one size.
double largest_difference(const Image& a, const Image& b);

/// Pixels that differ although `a` has no edge within `margin` pixels of them.
long differing_far_from_edges(const Image& a, const Image& b, int margin);

}  // namespace clay::importing::raster
