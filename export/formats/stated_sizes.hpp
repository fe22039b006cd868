#pragma once
// Sizes that compressed files state, read without decoding them. 0 if the file is damaged.

#include <cstdint>
#include <string_view>

namespace clay::solid::inline formats {

/// Of all copies of meshes that the scene places.
[[nodiscard]] std::uint64_t glb_triangles(std::string_view bytes);
/// Of the model parts of a 3MF after unpacking [bytes].
[[nodiscard]] std::uint64_t bytes_of_models_in_3mf(std::string_view bytes);

}  // namespace clay::solid::inline formats
