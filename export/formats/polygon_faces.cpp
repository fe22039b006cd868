#include "export/formats/polygon_faces.hpp"

#include "core/cancel.hpp"
#include "core/text.hpp"
#include "export/formats/polygon_split.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace clay::solid::inline formats {
namespace {

/// Of a face that programs take for flat: the distance of its corners from their plane, in sizes.
constexpr double kFlat = 0.01;

/// A kind of faces that gets a note.
struct OddFaces {
  std::size_t count = 0;
  glm::dvec3 first{0.0};

  void add(const glm::dvec3& at) {
    if (count++ == 0) first = at;
  }
  /// "2 faces of more than 3 corners WHAT, the first at (1, 2, 3) mm: ", for one or for several.
  [[nodiscard]] std::string text(std::string_view of_one, std::string_view of_several) const {
    return counted(count, "face") + " of more than 3 corners " +
           std::string(count == 1 ? of_one : of_several) + ", the first at (" +
           nine_digit_text(first.x) + ", " + nine_digit_text(first.y) + ", " +
           nine_digit_text(first.z) + ") mm: ";
  }
};

/// Twice the area, along the normal.
glm::dvec3 doubled_area(const std::vector<glm::dvec3>& points) {
  glm::dvec3 sum{0.0};
  for (std::size_t i = 2; i < points.size(); ++i)
    sum += glm::cross(points[i - 1] - points[0], points[i] - points[0]);
  return sum;
}

bool is_flat(const std::vector<glm::dvec3>& points, const glm::dvec3& area) {
  const double twice = glm::length(area);
  double low = 0.0, high = 0.0;
  for (const glm::dvec3& p : points) {
    const double height = glm::dot(p - points[0], area) / twice;
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return high - low <= kFlat * std::sqrt(0.5 * twice);
}

}  // namespace

void PolygonFaces::add(std::span<const std::uint32_t> corners, TriangleMesh& mesh) {
  if (corners.size() > 3)
    fans_.push_back({static_cast<std::uint32_t>(mesh.triangles.size()),
                     static_cast<std::uint32_t>(corners.size())});
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

void PolygonFaces::split(TriangleMesh& mesh, std::vector<std::string>* notes) const {
  OddFaces crossed, bent;
  std::vector<std::uint32_t> corners;
  std::vector<glm::dvec3> points;
  for (const Fan& fan : fans_) {
    step_of_loop();
    const auto triangles = std::span(mesh.triangles).subspan(fan.first, fan.corners - 2);
    corners.assign({triangles[0][0], triangles[0][1]});
    for (const auto& t : triangles) corners.push_back(t[2]);
    points.clear();
    for (const std::uint32_t c : corners) points.push_back(mesh.points[c]);
    const glm::dvec3 area = doubled_area(points);
    if (!split_polygon(corners, points, area, triangles))
      crossed.add(points[0]);
    else if (!is_flat(points, area))
      bent.add(points[0]);
  }
  if (notes == nullptr) return;
  if (crossed.count > 0)
    notes->push_back(crossed.text("crosses or touches itself", "cross or touch themselves") +
                     (crossed.count == 1 ? "split as a fan from its first corner"
                                         : "split as fans from their first corners"));
  if (bent.count > 0)
    notes->push_back(bent.text("is not flat", "are not flat") + "other programs may split " +
                     (bent.count == 1 ? "it" : "them") + " differently");
}

}  // namespace clay::solid::inline formats
