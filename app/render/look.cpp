#include "app/render/look.hpp"

#include "core/colour_scale.hpp"

#include <glm/geometric.hpp>

namespace clay::render {
namespace {

Look light_look() noexcept {
  return {{1.75f, 1.62f, 1.46f},    {0.58f, 0.62f, 0.70f},  {0.44f, 0.36f, 0.30f},
          {0.90f, 0.92f, 1.00f},    linear_of(0xCFCBC5),    linear_of(0xF6F4F0),
          {0.330f, 0.335f, 0.345f}, {0.46f, 0.30f, 0.145f}, {0.86f, 0.12f, 0.03f}};
}

Look dark_look() noexcept {
  return {{1.70f, 1.52f, 1.32f},    {0.34f, 0.38f, 0.46f},  {0.30f, 0.23f, 0.18f},
          {0.85f, 0.95f, 1.15f},    linear_of(0x15171B),    linear_of(0x3A3F47),
          {0.200f, 0.205f, 0.215f}, {0.46f, 0.30f, 0.145f}, {1.00f, 0.22f, 0.05f}};
}

}  // namespace

glm::vec3 linear_of(unsigned rgb) noexcept {
  const auto [red, green, blue] = linear_colour(rgb);
  return {red, green, blue};
}

const std::array<glm::vec4, kMapColours>& map_colours() noexcept {
  static_assert(kMapColours == kScaleColours.size());
  static const std::array<glm::vec4, kMapColours> kColours = [] {
    std::array<glm::vec4, kMapColours> colours{};
    for (std::size_t i = 0; i < colours.size(); ++i)
      colours[i] = glm::vec4(linear_of(kScaleColours[i]), 1.0f);
    return colours;
  }();
  return kColours;
}

const Look& look_of(Theme theme) noexcept {
  static const Look kLight = light_look(), kDark = dark_look();
  return theme == Theme::light ? kLight : kDark;
}

glm::vec3 section_colour(const Material& material) noexcept {
  constexpr float kPaler = 0.45f;
  const Reflectance& body = material.glaze ? material.bare : material.base;
  return {std::pow(body[0], kPaler), std::pow(body[1], kPaler), std::pow(body[2], kPaler)};
}

glm::dvec3 lamp_direction() noexcept { return glm::normalize(glm::dvec3{-0.62, 0.74, 0.52}); }
glm::dvec3 rim_lamp_direction() noexcept { return glm::normalize(glm::dvec3{0.72, 0.42, -0.62}); }

}  // namespace clay::render
