#include "export/solid/equal_points.hpp"

#include "core/cancel.hpp"
#include "export/solid/vertex_welder.hpp"

namespace clay::solid {

EqualPoints equal_points(const std::vector<glm::dvec3>& points) {
  std::vector<glm::dvec3> places;
  VertexWelder welder(places, points.size() / 4);
  std::vector<std::uint32_t> first_at;  // of each place
  EqualPoints result;
  result.first.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    step_of_loop();
    const std::uint32_t place = welder.index_of(glm::vec3(points[i]));
    if (place == first_at.size()) first_at.push_back(i);
    result.first.push_back(first_at[place]);
  }
  result.repeated = points.size() - places.size();
  return result;
}

}  // namespace clay::solid
