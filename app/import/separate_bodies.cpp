#include "app/import/separate_bodies.hpp"

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

namespace clay::importing {
namespace {

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  void add(const Box& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  [[nodiscard]] bool touches(const Box& other) const {
    for (int axis = 0; axis < 3; ++axis)
      if (high[axis] < other.low[axis] || other.high[axis] < low[axis]) return false;
    return true;
  }
};

/// Points that triangles join, directly or through others, have one root.
class Joined {
 public:
  explicit Joined(std::size_t points) : above_(points) {
    std::iota(above_.begin(), above_.end(), std::uint32_t{0});
  }
  std::uint32_t root(std::uint32_t point) {
    while (above_[point] != point) point = above_[point] = above_[above_[point]];
    return point;
  }
  void join(std::uint32_t a, std::uint32_t b) { above_[root(a)] = root(b); }

 private:
  std::vector<std::uint32_t> above_;
};

/// Empty for more than `most` parts.
std::vector<Box> boxes_of_parts(const solid::TriangleMesh& mesh, std::size_t most) {
  Joined joined(mesh.points.size());
  for (const auto& [a, b, c] : mesh.triangles) joined.join(a, b), joined.join(b, c);
  std::map<std::uint32_t, Box> by_root;
  for (const auto& triangle : mesh.triangles) {
    const std::uint32_t root = joined.root(triangle[0]);
    for (const std::uint32_t p : triangle) by_root[root].add({mesh.points[p], mesh.points[p]});
    if (by_root.size() > most) return {};
  }
  std::vector<Box> boxes;
  for (const auto& [root, box] : by_root) boxes.push_back(box);
  return boxes;
}

}  // namespace

std::size_t separate_bodies(const solid::TriangleMesh& mesh) {
  constexpr std::size_t kMostParts = 1'000;
  std::vector<Box> boxes = boxes_of_parts(mesh, kMostParts);
  if (boxes.empty()) return 1;
  // A box that grows may touch one that was passed.
  for (std::size_t i = 0; i < boxes.size();) {
    std::size_t j = i + 1;
    while (j < boxes.size() && !boxes[i].touches(boxes[j])) ++j;
    if (j == boxes.size()) {
      ++i;
      continue;
    }
    boxes[i].add(boxes[j]);
    boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(j));
    i = 0;
  }
  return boxes.size();
}

}  // namespace clay::importing
