#pragma once
// Random meshes for RapidCheck, and the equivalence of meshes.

#include "claystack/export/formats.hpp"

#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace clay::solid::samples {

/// Any float32 bits that are a coordinate: denormals, -0, 1e-30 and 999999.9 alike.
inline rc::Gen<double> any_coordinate() {
  return rc::gen::map(
      rc::gen::suchThat(rc::gen::map(rc::gen::arbitrary<std::uint32_t>(),
                                     [](std::uint32_t bits) { return std::bit_cast<float>(bits); }),
                        [](float x) { return std::abs(x) <= 1e6F; }),
      [](float x) { return static_cast<double>(x); });
}

/// Soups of any points and indices: files must store broken meshes as exactly as sound ones.
inline rc::Gen<TriangleMesh> any_mesh(const rc::Gen<double>& coordinate = any_coordinate()) {
  const auto point = rc::gen::construct<glm::dvec3>(coordinate, coordinate, coordinate);
  const auto points = rc::gen::nonEmpty(rc::gen::container<std::vector<glm::dvec3>>(point));
  return rc::gen::mapcat(points, [](const std::vector<glm::dvec3>& all) {
    const auto index = rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(all.size()));
    const auto triangle = rc::gen::container<std::array<std::uint32_t, 3>>(index);
    const auto triangles =
        rc::gen::nonEmpty(rc::gen::container<std::vector<std::array<std::uint32_t, 3>>>(triangle));
    return rc::gen::map(triangles, [all](const auto& some) { return TriangleMesh{all, some}; });
  });
}

using Corners = std::array<glm::dvec3, 3>;

/// The corners of a mesh, independent of the numbering of its points.
inline std::vector<Corners> corners_of(const TriangleMesh& mesh) {
  std::vector<Corners> all;
  for (const auto& [a, b, c] : mesh.triangles) {
    all.push_back({mesh.points[a], mesh.points[b], mesh.points[c]});
  }
  return all;
}

/// The largest displacement of a corner between two triangles, for any rotation.
inline double distance(const Corners& from, const Corners& to) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t turn = 0; turn < 3; ++turn) {
    double farthest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      farthest = std::max(farthest, glm::distance(from[i], to[(i + turn) % 3]));
    }
    least = std::min(least, farthest);
  }
  return least;
}

/// The largest distance from a triangle to its nearest in the other mesh.
inline double largest_move(const TriangleMesh& mesh, const TriangleMesh& other) {
  const std::vector<Corners> candidates = corners_of(other);
  double largest = 0.0;
  for (const Corners& triangle : corners_of(mesh)) {
    double least = std::numeric_limits<double>::infinity();
    for (const Corners& candidate : candidates) {
      least = std::min(least, distance(triangle, candidate));
    }
    largest = std::max(largest, least);
  }
  return largest;
}

inline bool has_negative_zero(const TriangleMesh& mesh) {
  for (const glm::dvec3& point : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) {
      if (point[axis] == 0.0 && std::signbit(point[axis])) return true;
    }
  }
  return false;
}

/// Distinct points, numbered in the order of first use.
inline bool is_welded(const TriangleMesh& mesh) {
  std::uint32_t known = 0;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t index : triangle) {
      if (index > known) return false;
      if (index == known) ++known;
    }
  }
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (mesh.points[i] == mesh.points[j]) return false;
    }
  }
  return known == mesh.points.size();
}

}  // namespace clay::solid::samples
