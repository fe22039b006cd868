#include "export/repair/order_keeping.hpp"

#include "core/cancel.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/vec3.hpp>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

namespace clay::solid::inline repair {
namespace {

struct PlaceHash {
  std::size_t operator()(const glm::dvec3& p) const noexcept {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = p[axis] + 0.0;  // without -0
      std::uint64_t bits = 0;
      std::memcpy(&bits, &x, sizeof bits);
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 32U;
    }
    return hash;
  }
};
struct CornersHash {
  std::size_t operator()(const Triangle& t) const noexcept {
    std::uint64_t hash = 0;
    for (const std::uint32_t v : t) hash = (hash ^ v) * 0x9E3779B97F4A7C15U;
    return hash ^ (hash >> 32U);
  }
};

/// The same orientation, from the smallest number on.
Triangle turned_to_least(const Triangle& t) {
  Triangle turned = t;
  std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
  return turned;
}

/// For each point of the result, a number that grows in the order of the input. Points of one place
/// have one number, except new points.
std::vector<std::uint32_t> ranks(const TriangleMesh& before, const TriangleMesh& result,
                                 std::vector<std::uint32_t>& rank_of_input) {
  std::unordered_map<glm::dvec3, std::uint32_t, PlaceHash> first;
  first.reserve(before.points.size());
  rank_of_input.resize(before.points.size());
  for (std::uint32_t v = 0; v < before.points.size(); ++v)
    rank_of_input[v] = first.try_emplace(before.points[v], v).first->second;
  std::vector<std::uint32_t> rank(result.points.size());
  for (std::uint32_t v = 0; v < result.points.size(); ++v) {
    const auto known = first.find(result.points[v]);
    rank[v] =
        known != first.end() ? known->second : static_cast<std::uint32_t>(before.points.size()) + v;
  }
  return rank;
}

using Numbers = std::vector<std::uint32_t>;

Triangle numbered(const Triangle& t, const Numbers& number) {
  return {number[t[0]], number[t[1]], number[t[2]]};
}

/// The triangles of the result in the order of the input, with its first corners; then new ones.
std::vector<Triangle> ordered_triangles(const TriangleMesh& before, const TriangleMesh& result,
                                        const Numbers& rank_of_input, const Numbers& rank) {
  std::unordered_map<Triangle, std::uint32_t, CornersHash> number;
  number.reserve(before.triangles.size());
  for (std::uint32_t t = 0; t < before.triangles.size(); ++t) {
    step_of_loop();
    number.try_emplace(turned_to_least(numbered(before.triangles[t], rank_of_input)), t);
  }
  std::vector<std::pair<std::uint32_t, Triangle>> ordered;
  ordered.reserve(result.triangles.size());
  for (Triangle corners : result.triangles) {
    step_of_loop();
    const auto known = number.find(turned_to_least(numbered(corners, rank)));
    if (known != number.end()) {
      const std::uint32_t start = rank_of_input[before.triangles[known->second][0]];
      while (rank[corners[0]] != start)
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    }
    ordered.emplace_back(known != number.end() ? known->second : UINT32_MAX, corners);
  }
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Triangle> triangles;
  triangles.reserve(ordered.size());
  for (const auto& entry : ordered) triangles.push_back(entry.second);
  return triangles;
}

}  // namespace

TriangleMesh in_order_of(const TriangleMesh& before, TriangleMesh result) {
  Numbers rank_of_input;
  const Numbers rank = ranks(before, result, rank_of_input);
  TriangleMesh sorted;
  sorted.triangles = ordered_triangles(before, result, rank_of_input, rank);
  Numbers order(result.points.size()), place(result.points.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return rank[a] < rank[b]; });
  sorted.points.reserve(order.size());
  for (const std::uint32_t v : order) {
    place[v] = static_cast<std::uint32_t>(sorted.points.size());
    sorted.points.push_back(result.points[v]);
  }
  for (Triangle& t : sorted.triangles) t = numbered(t, place);
  return sorted;
}

}  // namespace clay::solid::inline repair
