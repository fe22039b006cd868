#include "export/solid/box_tree.hpp"

#include "core/cancel.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

namespace clay::solid {

BoxTree::BoxTree(const TriangleMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  constexpr double kMargin = 1e-12;  // thousands of roundings of the largest coordinate
  std::vector<glm::vec3> middles;    // only for sorting: rounding is harmless
  middles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const glm::dvec3 &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
    middles.emplace_back(p / 3.0 + q / 3.0 + r / 3.0);
    for (const glm::dvec3& corner : {p, q, r})
      for (int axis = 0; axis < 3; ++axis)
        margin_ = std::max(margin_, kMargin * std::abs(corner[axis]));
  }
  std::iota(order_.begin(), order_.end(), std::uint32_t{0});
  nodes_.reserve(mesh.triangles.size() / 2 + 1);
  build(middles, 0, static_cast<std::uint32_t>(order_.size()));
  nodes_.shrink_to_fit();
}

/// Returns the number of the node. Its halves lie on both sides of the middle, along the axis of
/// largest extent.
std::uint32_t BoxTree::build(std::vector<glm::vec3>& middles, std::uint32_t begin,
                             std::uint32_t end) {
  step_of_loop();
  const auto node = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  if (end - begin <= kLeaf) {
    nodes_[node].box = box_of(begin, end);
    return node;
  }
  glm::vec3 low = middles[order_[begin]], high = low;
  for (std::uint32_t i = begin; i < end; ++i) {
    low = glm::min(low, middles[order_[i]]);
    high = glm::max(high, middles[order_[i]]);
  }
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (high[other] - low[other] > high[axis] - low[axis]) axis = other;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(
      order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
      [&](std::uint32_t i, std::uint32_t j) { return middles[i][axis] < middles[j][axis]; });
  const Box first = nodes_[build(middles, begin, middle)].box;
  const std::uint32_t second = build(middles, middle, end);
  nodes_[node].second = second;
  Box& box = nodes_[node].box;
  box.low = glm::min(first.low, nodes_[second].box.low);
  box.high = glm::max(first.high, nodes_[second].box.high);
  set_planes(box, begin, end);
  return node;
}

BoxTree::Box BoxTree::box_of(std::uint32_t begin, std::uint32_t end) const {
  Box box;
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const std::uint32_t v : mesh_.triangles[order_[i]]) {
      box.low = glm::min(box.low, mesh_.points[v]);
      box.high = glm::max(box.high, mesh_.points[v]);
    }
  }
  box.low -= margin_;
  box.high += margin_;
  set_planes(box, begin, end);
  return box;
}

/// Perpendicular to the mean of the normals, all oriented to the same side.
void BoxTree::set_planes(Box& box, std::uint32_t begin, std::uint32_t end) const {
  glm::dvec3 sum{0.0};
  for (std::uint32_t i = begin; i < end; ++i) {
    const auto& [a, b, c] = mesh_.triangles[order_[i]];
    const glm::dvec3 normal =
        glm::cross(mesh_.points[b] - mesh_.points[a], mesh_.points[c] - mesh_.points[a]);
    sum += glm::dot(sum, normal) < 0.0 ? -normal : normal;
  }
  const double length = glm::length(sum);
  if (!(length > 0.0) || !std::isfinite(length)) return;
  box.across = glm::vec3(sum / length);
  box.from = std::numeric_limits<double>::infinity();
  box.to = -box.from;
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const std::uint32_t v : mesh_.triangles[order_[i]]) {
      const double at = glm::dot(glm::dvec3(box.across), mesh_.points[v]);
      box.from = std::min(box.from, at);
      box.to = std::max(box.to, at);
    }
  }
  box.from -= margin_;
  box.to += margin_;
}

}  // namespace clay::solid
