#pragma once
// The table of clay bodies and glazes, for pictures, the window and GLB files.

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace clay {

/// Reflectance for red, green and blue in linear light, as glTF's baseColorFactor.
using Reflectance = std::array<float, 3>;

/// Roughness as in glTF: 0 mirror, 1 matte. The coat is a clear layer over the body, of water or
/// glass, as in KHR_materials_clearcoat.
struct Material {
  std::string_view id;     ///< as for `--material`
  std::string_view title;  ///< name in the window
  Reflectance base{};
  float roughness = 1.0f;
  float coat = 0.0f;  ///< strength of the coat, 0: none
  float coat_roughness = 0.0f;
  bool glaze = false;       ///< leaves the foot bare
  Reflectance thin = base;  ///< of a glaze where it runs thin
  Reflectance bare = base;  ///< of the clay below a glaze
  float speckle = 0.0f;     ///< darkness of the specks of iron; 0: none
  friend bool operator==(const Material&, const Material&) = default;
};

namespace detail {
inline constexpr Reflectance kBuff{0.47f, 0.33f, 0.21f};
}

// clang-format off
inline constexpr std::array kMaterials = {
    Material{"wet", "Wet clay", {0.33f, 0.128f, 0.060f}, 0.55f, 0.85f, 0.16f},
    Material{"leather-hard", "Leather-hard clay", {0.43f, 0.178f, 0.088f}, 0.55f},
    Material{"terracotta", "Terracotta", {0.56f, 0.27f, 0.16f}, 0.85f},
    Material{.id = "stoneware", .title = "Stoneware", .base = {0.45f, 0.35f, 0.25f},
             .roughness = 0.80f, .speckle = 0.45f},
    Material{"porcelain", "Porcelain", {0.62f, 0.60f, 0.56f}, 0.65f},
    Material{"clear", "Clear glaze", {0.40f, 0.22f, 0.10f}, 0.60f, 1.0f, 0.03f, true,
             {0.44f, 0.27f, 0.14f}, detail::kBuff, 0.25f},
    Material{"celadon", "Celadon glaze", {0.25f, 0.37f, 0.29f}, 0.60f, 1.0f, 0.05f, true,
             {0.52f, 0.57f, 0.46f}, detail::kBuff, 0.0f},
    Material{"tenmoku", "Tenmoku glaze", {0.016f, 0.008f, 0.006f}, 0.50f, 1.0f, 0.05f, true,
             {0.23f, 0.065f, 0.018f}, detail::kBuff, 0.0f},
    Material{"white", "White glaze", {0.60f, 0.57f, 0.50f}, 0.70f, 1.0f, 0.12f, true,
             {0.52f, 0.37f, 0.24f}, detail::kBuff, 0.55f},
};
// clang-format on

[[nodiscard]] constexpr const Material* find_material(std::string_view id) noexcept {
  for (const Material& material : kMaterials)
    if (material.id == id) return &material;
  return nullptr;
}

/// For the options of commands.
[[nodiscard]] inline std::vector<std::string> material_ids() {
  std::vector<std::string> ids;
  for (const Material& material : kMaterials) ids.emplace_back(material.id);
  return ids;
}

inline constexpr const Material& kWet = kMaterials[0];
inline constexpr const Material& kLeatherHard = kMaterials[1];

}  // namespace clay
