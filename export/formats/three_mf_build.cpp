// The items of a 3MF model in one mesh.

#include "core/cancel.hpp"
#include "core/text.hpp"
#include "export/formats/mesh_limits.hpp"
#include "export/formats/text_scanner.hpp"
#include "export/formats/three_mf_model.hpp"

#include <algorithm>

namespace clay::solid::inline formats::three_mf {
namespace {

/// First `inner`, then `outer`.
Transform composed(const Transform& inner, const Transform& outer) {
  Transform product{};
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 3; ++column) {
      double sum = row == 3 ? outer[9 + column] : 0.0;
      for (std::size_t i = 0; i < 3; ++i) sum += inner[3 * row + i] * outer[3 * i + column];
      product[3 * row + column] = sum;
    }
  return product;
}

class Builder {
 public:
  Builder(const std::vector<Object>& objects, double unit_mm, TriangleMesh& mesh)
      : objects_(objects), unit_mm_(unit_mm), mesh_(mesh) {}

  /// False if a coordinate is out of range.
  [[nodiscard]] bool add(const Placed& placed, const Transform& outer) {
    step_of_loop();
    const Transform matrix = composed(placed.transform, outer);
    const Object& object = objects_[placed.object];
    for (const Placed& component : object.components)
      if (!add(component, matrix)) return false;
    const auto first = static_cast<std::uint32_t>(mesh_.points.size());
    for (const glm::vec3& point : object.points) {
      step_of_loop();
      const glm::vec3 place = placed_point(point, matrix);
      for (int axis = 0; axis < 3; ++axis)
        if (!is_coordinate(place[axis])) return false;
      mesh_.points.emplace_back(place + 0.0F);  // -0 + 0 is 0
    }
    const bool mirrored = determinant(matrix) < 0.0;
    for (auto [a, b, c] : object.triangles) {
      if (mirrored) std::swap(b, c);
      mesh_.triangles.push_back({first + a, first + b, first + c});
    }
    return true;
  }

 private:
  [[nodiscard]] glm::vec3 placed_point(const glm::vec3& point, const Transform& m) const {
    if (m == kStill && unit_mm_ == 1.0) return point;
    const glm::dvec3 p(point);
    glm::vec3 place;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      place[axis] =
          static_cast<float>(unit_mm_ * (p.x * m[i] + p.y * m[3 + i] + p.z * m[6 + i] + m[9 + i]));
    }
    return place;
  }

  const std::vector<Object>& objects_;
  double unit_mm_;
  TriangleMesh& mesh_;
};

}  // namespace

double determinant(const Transform& m) {
  return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
         m[2] * (m[3] * m[7] - m[4] * m[6]);
}

std::string ModelReader::left_out() const {
  const auto supports = static_cast<std::size_t>(std::ranges::count_if(
      items_, [&](const Placed& item) { return objects_[item.object].type == "support"; }));
  std::string text;
  const auto add = [&text](const std::string& more) {
    text.append(text.empty() ? "" : " and ").append(more);
  };
  if (supports > 0) add(counted(supports, "support item"));
  if (not_printed_ > 0) add(counted(not_printed_, "item") + " with printable=\"0\"");
  if (no_clay_.any()) add(no_clay_.text());
  return text;
}

/// Before anything is built, because a few components can stand for billions of triangles.
Result<ModelReader::Counts> ModelReader::counted_build(std::string_view name) const {
  Counts sum;
  for (const Placed& item : items_) {
    const Object& object = objects_[item.object];
    if (object.type == "support") continue;
    sum.points += object.all_points;
    sum.triangles += object.all_triangles;
  }
  if (sum.triangles > most_with_copies(stored_triangles_, kFreeTriangles) ||
      sum.points > most_with_copies(stored_points_, 3 * kFreeTriangles) || sum.points > kMaxPoints)
    return bad_file(name, "expected a build of at most " + std::to_string(kMostCopies) +
                              " times the " + std::to_string(stored_triangles_) +
                              " triangles in the file, found " + std::to_string(sum.triangles));
  if (const std::string others = left_out(); sum.triangles == 0 && !others.empty())
    return bad_file(name, "expected an item to print, found only " + others);
  return check_facet_count(sum.triangles, name).map([&] { return sum; });
}

Result<TriangleMesh> ModelReader::build(std::string_view name) const {
  if (!part_.has_build) return bad_file(name, "expected a 3MF model with resources and build");
  const auto counts = counted_build(name);
  if (!counts) return tl::make_unexpected(counts.error());
  TriangleMesh mesh;
  mesh.points.reserve(counts->points);
  mesh.triangles.reserve(counts->triangles);
  Builder builder(objects_, part_.unit_mm, mesh);
  for (const Placed& item : items_)
    if (objects_[item.object].type != "support" && !builder.add(item, kStill))
      return bad_file(name, std::string("expected ").append(kCoordinateRule) +
                                " after the transforms of its items");
  if (options_.notes == nullptr) return mesh;
  if (const std::string others = left_out(); !others.empty())
    options_.notes->push_back(others + " not read");
  if (twice_ > 0)
    options_.notes->push_back(counted(twice_, "triangle") + " with a vertex twice left out");
  return mesh;
}

}  // namespace clay::solid::inline formats::three_mf
