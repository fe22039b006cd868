#pragma once
// Triangles about a vertex of many: all their boxes overlap there, but seen from the vertex each
// is an arc on a sphere, and two of them meet beyond what they share where their arcs do.

#include "export/proof/crossings.hpp"
#include "export/proof/pair_test.hpp"
#include "export/solid/mesh_topology.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace clay::solid::inline proof {

/// A vertex of more is a hub; an edge of more, whose ends are then hubs too, is a book of its own.
inline constexpr std::size_t kManyTriangles = 32;

/// The vertices with many triangles, and which.
class HighValenceVertices {
 public:
  HighValenceVertices() = default;
  HighValenceVertices(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles);

  [[nodiscard]] std::size_t size() const noexcept { return vertices_.size(); }
  [[nodiscard]] std::uint32_t vertex(std::size_t hub) const { return vertices_[hub]; }
  [[nodiscard]] std::span<const std::uint32_t> triangles(std::size_t hub) const;  ///< rising
  [[nodiscard]] bool is_hub(std::uint32_t vertex) const { return is_hub_[vertex]; }

 private:
  std::vector<bool> is_hub_;             ///< by vertex
  std::vector<std::uint32_t> vertices_;  ///< rising
  std::vector<std::size_t> begins_;      ///< in triangles_, and the end of the last
  std::vector<std::uint32_t> triangles_;
};

/// The pairs of triangles that share this hub, and none before it, and meet elsewhere.
Crossings crossings_about(const TriangleMesh& mesh, const HighValenceVertices& hubs,
                          std::size_t hub);

}  // namespace clay::solid::inline proof
