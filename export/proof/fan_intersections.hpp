#pragma once
// Intersections of triangles about a vertex of high valence. All their boxes overlap there, but
// seen from the vertex each triangle is an arc on a sphere, and two triangles intersect beyond
// their common parts if their arcs do.

#include "export/proof/crossings.hpp"
#include "export/proof/pair_test.hpp"
#include "export/solid/mesh_topology.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace clay::solid::inline proof {

/// A vertex with more triangles is a hub; an edge with more, whose ends are then hubs, is a book.
inline constexpr std::size_t kManyTriangles = 32;

/// The vertices of many triangles, with these triangles.
class HighValenceVertices {
 public:
  HighValenceVertices() = default;
  HighValenceVertices(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles);

  [[nodiscard]] std::size_t size() const noexcept { return vertices_.size(); }
  [[nodiscard]] std::uint32_t vertex(std::size_t hub) const { return vertices_[hub]; }
  [[nodiscard]] std::span<const std::uint32_t> triangles(std::size_t hub) const;  ///< ascending
  [[nodiscard]] bool is_hub(std::uint32_t vertex) const { return is_hub_[vertex]; }

 private:
  std::vector<bool> is_hub_;             ///< by vertex
  std::vector<std::uint32_t> vertices_;  ///< ascending
  std::vector<std::size_t> begins_;      ///< offsets into triangles_, with the end of the last
  std::vector<std::uint32_t> triangles_;
};

/// Finds the pairs of triangles that share this hub, but no earlier one, and intersect elsewhere.
/// Returns false if the sink ended the search.
bool find_crossings_about(const TriangleMesh& mesh, const HighValenceVertices& hubs,
                          std::size_t hub, PairSink& sink);

}  // namespace clay::solid::inline proof
