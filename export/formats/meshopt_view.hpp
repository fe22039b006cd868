#pragma once
// The bytes of a glTF bufferView that meshoptimizer compressed.

#include "claystack/core/result.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace clay::solid::inline formats::glb {

/// As the extension EXT_meshopt_compression states them.
struct MeshoptView {
  std::string_view mode, filter = "NONE";
  std::size_t count = 0, stride = 0;  ///< elements, and bytes of each
};

/// All counts are compared with the compressed size before memory is allocated: the codec packs at
/// most 64 bytes into one. Errors (`bad_input`) hold no name of a file.
[[nodiscard]] Result<std::string> unpacked_by_meshopt(std::string_view packed,
                                                      const MeshoptView& view);

}  // namespace clay::solid::inline formats::glb
