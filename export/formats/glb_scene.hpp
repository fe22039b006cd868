#pragma once
// The nodes of a GLB: the meshes of its scene, and their places.

#include "export/formats/glb_json.hpp"

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <utility>
#include <vector>

namespace clay::solid::inline formats::glb {

struct Scene {
  std::vector<std::pair<std::size_t, glm::dmat4>> placed;  ///< meshes by number
  bool missing = false;  ///< the file has no scene: all its root nodes are read
  /// Nodes with a mesh that another program shows in another shape or place.
  std::size_t morphed = 0, skinned = 0, instanced = 0;
};

/// Throws BadGlb.
[[nodiscard]] Scene scene_of(const Json& json);

}  // namespace clay::solid::inline formats::glb
