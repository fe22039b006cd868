#pragma once
// A mesh as the binary chunk of a GLB holds it, with the parts of the JSON that describe it.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"
#include "core/text.hpp"
#include "export/formats/glb.hpp"
#include "export/formats/mesh_limits.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats::glb {

using OrderedJson = nlohmann::ordered_json;

/// Of a vertex, in linear light, 65535 is 1.
using Colour16 = std::array<std::uint16_t, 4>;

struct Packed {
  std::string bytes;
  OrderedJson accessors = OrderedJson::array();  ///< points, indices, colours if there are any
  OrderedJson views = OrderedJson::array();
  OrderedJson node = OrderedJson::object();       ///< its transform
  OrderedJson primitive = OrderedJson::object();  ///< its extensions
  std::vector<std::string_view> extensions;       ///< used and required
  std::size_t unpacked_bytes = 0;                 ///< of the buffer that is not in the file

  /// The bytes as the next view; its number.
  std::size_t add_view(std::string_view stream, OrderedJson view) {
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    view["buffer"] = 0;
    if (!bytes.empty()) view["byteOffset"] = bytes.size();
    view["byteLength"] = stream.size();
    bytes += stream;
    views.push_back(std::move(view));
    return views.size() - 1;
  }
};

inline constexpr int kVertexTarget = 34962, kIndexTarget = 34963;

/// float32 as the shortest decimals that read back as the same double.
[[nodiscard]] inline OrderedJson numbers(const glm::vec3& v) {
  return {double{v.x}, double{v.y}, double{v.z}};
}

struct Bounds {
  glm::vec3 low{0.0F}, high{0.0F};
};
[[nodiscard]] inline Bounds bounds_of(std::span<const glm::vec3> points) {
  if (points.empty()) return {};
  Bounds bounds{points.front(), points.front()};
  for (const glm::vec3& point : points)
    bounds = {glm::min(bounds.low, point), glm::max(bounds.high, point)};
  return bounds;
}

/// The error [m] that is left for a grid: a vertex is also rounded to float32 in metres, by a
/// decoder, and to float32 in mm by a reader. Errors: nothing is left.
[[nodiscard]] inline Result<double> error_left(const TriangleMesh& metres, double max_error_mm,
                                               double roundings) {
  double farthest = 0.0;
  for (const glm::dvec3& point : metres.points) farthest = std::max(farthest, glm::length(point));
  const double rounding = roundings * std::ldexp(farthest, -24);
  const double left = max_error_mm / kMmPerMetre - rounding;
  if (left > 0.0) return left;
  return failure(ErrorKind::bad_input, "cannot write .glb: expected a vertex error above " +
                                           sufficient_text(kMmPerMetre * rounding) +
                                           " mm, the rounding to float32, found " +
                                           nine_digit_text(max_error_mm) + " mm");
}

/// The mesh compressed by meshoptimizer: points of 16 bits on the coarsest grid that keeps the
/// error of `settings`, or float32 where 16 bits are too few.
[[nodiscard]] Result<Packed> packed_by_meshopt(const TriangleMesh& metres,
                                               std::span<const Colour16> colours,
                                               const DracoSettings& settings);

}  // namespace clay::solid::inline formats::glb
