#include "app/render/legend.hpp"

#include "core/colour_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

namespace clay::render {
namespace {

constexpr int kLeastSide = 240;  // px: no legend in smaller pictures
constexpr Swatch kThin{0xE7, 0x28, 0x30}, kInkLight{0x33, 0x33, 0x38}, kInkDark{0xE6, 0xE6, 0xEA};

class Sheet {
 public:
  Sheet(Image& image, Swatch ink) : image_(image), ink_(ink) {}

  void fill(int x0, int y0, int width, int height, Swatch colour) {
    for (int y = std::max(0, y0); y < std::min(image_.height_px, y0 + height); ++y)
      for (int x = std::max(0, x0); x < std::min(image_.width_px, x0 + width); ++x) {
        std::uint8_t* p = image_.at(x, y);
        p[0] = colour.red;
        p[1] = colour.green;
        p[2] = colour.blue;
        p[3] = 255;
      }
  }

  /// Letters 7 units high, `scale` px each; `y` is their middle.
  void text(int x, int y, std::string words, int scale) {
    struct Vertex {
      float x, y, z;
      std::array<unsigned char, 4> colour;
    };
    std::array<Vertex, 2048> vertices{};
    const int quads = stb_easy_font_print(0.0f, 0.0f, words.data(), nullptr, vertices.data(),
                                          static_cast<int>(sizeof(vertices)));
    for (std::size_t quad = 0; quad < static_cast<std::size_t>(quads); ++quad) {
      const Vertex& low = vertices[4 * quad];
      const Vertex& high = vertices[4 * quad + 2];
      const auto px = [&](float units) { return static_cast<int>(std::lround(units)) * scale; };
      fill(x + px(low.x), y - 4 * scale + px(low.y), px(high.x - low.x), px(high.y - low.y), ink_);
    }
  }

 private:
  Image& image_;
  Swatch ink_;
};

}  // namespace

Swatch wall_swatch(const WallMap& map, double wall_mm) noexcept {
  if (wall_mm < map.limit_mm) return kThin;
  const auto [red, green, blue] = scale_colour(wall_mm / map.top_mm);
  return {srgb_byte(red), srgb_byte(green), srgb_byte(blue)};
}

void draw_legend(const WallMap& map, Theme theme, Image& image) {
  if (std::min(image.width_px, image.height_px) < kLeastSide) return;
  const int scale = std::max(1, image.height_px / 360);
  const Swatch ink = theme == Theme::light ? kInkLight : kInkDark;
  Sheet sheet(image, ink);
  const int left = 16 * scale, width = 9 * scale, height = image.height_px * 5 / 9;
  const int top = (image.height_px - height) / 2;
  const auto level = [&](double mm) {
    return top + static_cast<int>(std::lround((1.0 - mm / map.top_mm) * (height - 1)));
  };
  for (int y = 0; y < height; ++y) {
    const double wall = map.top_mm * (height - 1 - y) / (height - 1);
    sheet.fill(left, top + y, width, 1, wall_swatch(map, wall));
  }
  constexpr int kSteps = 5;
  for (int k = 0; k <= kSteps; ++k) {
    const double mm = map.top_mm * k / kSteps;
    sheet.fill(left + width, level(mm), 3 * scale, scale, ink);
    sheet.text(left + width + 6 * scale, level(mm),
               fmt::format("{:g}{}", mm, k == kSteps ? " mm +" : ""), scale);
  }
  sheet.text(left, top - 14 * scale, "wall", scale);
  if (map.limit_mm > 0.0)
    sheet.text(left, top + height + 12 * scale, fmt::format("red: below {:.2f} mm", map.limit_mm),
               scale);
}

}  // namespace clay::render
