#pragma once
// The colours of wall maps: in the window, in pictures, in the report and in mesh files.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace clay {

/// sRGB 0xRRGGBB, from the bottom of a scale to its top: viridis of Matplotlib (van der Walt and
/// Smith). Its lightness rises evenly, so it is readable with any kind of colour vision, and it has
/// neither the grey of a background, the brown of clay, nor the red of a wall that is too thin.
inline constexpr std::array<std::uint32_t, 17> kScaleColours{
    0x440154, 0x48186A, 0x472D7B, 0x424086, 0x3B528B, 0x33638D, 0x2C728E, 0x26828E, 0x21918C,
    0x1FA088, 0x28AE80, 0x3FBC73, 0x5EC962, 0x84D44B, 0xADDC30, 0xD8E219, 0xFDE725};

/// Linear light of an sRGB byte, 0 to 1.
[[nodiscard]] inline float linear_channel(unsigned byte) noexcept {
  const float c = static_cast<float>(byte) / 255.0F;
  return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
}

/// The inverse of `linear_channel`, to the nearest byte.
[[nodiscard]] inline std::uint8_t srgb_byte(float linear) noexcept {
  const float c =
      linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(c, 0.0F, 1.0F)));
}

using LinearColour = std::array<float, 3>;

[[nodiscard]] inline LinearColour linear_colour(std::uint32_t rgb) noexcept {
  return {linear_channel(rgb >> 16U & 255U), linear_channel(rgb >> 8U & 255U),
          linear_channel(rgb & 255U)};
}

/// The colour at `part` of the scale, which is limited to 0 and 1; mixed in linear light.
[[nodiscard]] inline LinearColour scale_colour(double part) noexcept {
  static const auto kColours = [] {
    std::array<LinearColour, kScaleColours.size()> colours{};
    std::ranges::transform(kScaleColours, colours.begin(), linear_colour);
    return colours;
  }();
  const double at = std::clamp(part, 0.0, 1.0) * static_cast<double>(kColours.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), kColours.size() - 2);
  const auto t = static_cast<float>(at - static_cast<double>(below));
  LinearColour colour{};
  for (std::size_t i = 0; i < colour.size(); ++i)
    colour[i] = kColours[below][i] * (1.0F - t) + kColours[below + 1][i] * t;
  return colour;
}

/// The top of the scale for these walls [mm]: the first of 5, 10, 20, 50 and 100 that four fifths
/// of the finite ones do not exceed, because the thickest part of most pots is the floor's corner;
/// 100 if none is. Without a finite wall: 10.
[[nodiscard]] inline double scale_top_mm(std::vector<float> walls_mm) {
  constexpr std::array kTopsMm = {5.0, 10.0, 20.0, 50.0, 100.0};
  constexpr double kMost = 0.8, kWithoutWallsMm = 10.0;
  std::erase_if(walls_mm, [](float mm) { return !std::isfinite(mm); });
  if (walls_mm.empty()) return kWithoutWallsMm;
  const auto at = walls_mm.begin() +
                  static_cast<std::ptrdiff_t>(kMost * static_cast<double>(walls_mm.size() - 1));
  std::ranges::nth_element(walls_mm, at);
  const auto* top =
      std::ranges::find_if(kTopsMm, [&](double mm) { return mm >= static_cast<double>(*at); });
  return top == kTopsMm.end() ? kTopsMm.back() : *top;
}

}  // namespace clay
