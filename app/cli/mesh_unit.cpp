#include "app/cli/mesh_unit.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::cli {

std::optional<std::string> doubted_unit(const glm::dvec3& size_mm, solid::MeshFormat format) {
  constexpr double kUsualMm = 10.0, kLargestMm = 1'000.0, kMicrometresMm = 10'000.0;
  const bool states_unit =
      format == solid::MeshFormat::three_mf || format == solid::MeshFormat::glb;
  const double largest_mm = std::max({size_mm.x, size_mm.y, size_mm.z});
  if (largest_mm > kLargestMm)
    return fmt::format(
        "{:.4g} x {:.4g} x {:.4g} m: {}", size_mm.x / 1e3, size_mm.y / 1e3, size_mm.z / 1e3,
        states_unit ? "the file states its unit, but its numbers may be in millimetres"
        : largest_mm > kMicrometresMm
            ? "meshes are read in millimetres, this one may be in micrometres"
            : "meshes are read in millimetres, this one may be in a smaller unit");
  if (largest_mm >= kUsualMm) return {};
  return fmt::format("only {:.3g} x {:.3g} x {:.3g} mm: {}", size_mm.x, size_mm.y, size_mm.z,
                     states_unit
                         ? "the file states its unit, but its numbers may be in a larger one"
                         : "meshes are read in millimetres, this one may be in metres or inches");
}

}  // namespace clay::cli
