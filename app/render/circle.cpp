#include "app/render/circle.hpp"

#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace clay::render {

std::vector<glm::dvec2> directions_around(std::size_t count) {
  const double third = std::sqrt(0.75);  // sine of a third of the circle
  std::vector<glm::dvec2> around = {{1.0, 0.0}};
  if (count % 3 == 0) around.insert(around.end(), {{third, 0.5}, {0.5, third}});
  const std::size_t quarter = around.size();
  for (std::size_t i = 0; i < 3 * quarter; ++i) around.emplace_back(-around[i].y, around[i].x);
  while (around.size() < count) {
    std::vector<glm::dvec2> finer;
    for (std::size_t i = 0; i < around.size(); ++i) {
      const glm::dvec2 middle = around[i] + around[(i + 1) % around.size()];
      finer.push_back(around[i]);
      finer.push_back(middle / std::sqrt(glm::dot(middle, middle)));
    }
    around = std::move(finer);
  }
  assert(around.size() == count);
  return around;
}

}  // namespace clay::render
