#pragma once
// STEP (ISO 10303-21, AP214): a solid of exact surfaces, in mm with z up.

#include "claystack/core/result.hpp"
#include "export/solid/revolved_brep.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace clay::solid::inline formats {

/// One solid for each body, each face half a turn, so that no face has a seam or a pole; discs are
/// planes. Curved walls are rational B-splines, of exact circles. Equal breps give equal bytes.
[[nodiscard]] std::string encode_step(const RevolvedBrep& brep, std::string_view name);

struct StepSolid {
  std::size_t bodies = 0, faces = 0, edges = 0;
  double volume_mm3 = 0.0;
};

/// Reads a file of `encode_step` back, from its text alone: every edge bounds two faces of its
/// shell in opposite directions, every vertex lies on its edges and every edge on its faces, within
/// 1e-6 mm; lengths are in mm; the volume is that which the surfaces bound. Errors (`unsound`) name
/// the entity.
Result<StepSolid> verify_step(std::string_view text, std::string_view name);

}  // namespace clay::solid::inline formats
