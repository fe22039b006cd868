#include "export/solid/half_edge_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

using HalfEdge = OpenMesh::HalfedgeHandle;

/// Sides are numbered 3 * triangle + corner, from that corner to the next.
class Builder {
 public:
  explicit Builder(const TriangleMesh& mesh) : mesh_(mesh), half_edges_(3 * mesh.triangles.size()) {
    result_.reserve(mesh.points.size(), half_edges_.size() / 2, mesh.triangles.size());
  }

  HalfEdgeMesh run() {
    add_vertices();
    add_edges(twins());
    add_faces();
    join_borders();
    return std::move(result_);
  }

 private:
  using Vertex = OpenMesh::VertexHandle;

  [[nodiscard]] std::uint32_t begin(std::size_t side) const {
    return mesh_.triangles[side / 3][side % 3];
  }
  [[nodiscard]] std::uint32_t end(std::size_t side) const {
    return mesh_.triangles[side / 3][(side % 3 + 1) % 3];
  }

  void add_vertices() {
    vertices_.resize(mesh_.points.size());
    for (std::size_t side = 0; side < half_edges_.size(); ++side) {
      const glm::dvec3& p = mesh_.points[begin(side)];
      Vertex& vertex = vertices_[begin(side)];
      if (!vertex.is_valid()) vertex = result_.add_vertex({p.x, p.y, p.z});
    }
  }

  /// For each side the opposite one on the same edge, or itself on a border.
  [[nodiscard]] std::vector<std::uint32_t> twins() const {
    // Sorted into buckets by the lower vertex of the edge, then by the higher one.
    std::vector<std::uint32_t> begins(mesh_.points.size() + 1, 0);
    const auto low = [&](std::size_t side) { return std::min(begin(side), end(side)); };
    for (std::size_t side = 0; side < half_edges_.size(); ++side) ++begins[low(side) + 1];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> filed(half_edges_.size());
    std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
    for (std::uint32_t side = 0; side < half_edges_.size(); ++side)
      filed[next[low(side)]++] = {std::max(begin(side), end(side)), side};
    std::vector<std::uint32_t> twins(half_edges_.size());
    std::iota(twins.begin(), twins.end(), std::uint32_t{0});
    for (std::size_t v = 0; v + 1 < begins.size(); ++v) {
      const auto first = filed.begin() + begins[v], last = filed.begin() + begins[v + 1];
      std::sort(first, last);
      for (auto at = first; at != last && at + 1 != last; ++at)
        if (at->first == (at + 1)->first) pair_up(twins, at->second, (at + 1)->second);
    }
    return twins;
  }

  void pair_up(std::vector<std::uint32_t>& twins, std::uint32_t a, std::uint32_t b) const {
    if (twins[a] != a || begin(a) != end(b))
      throw std::logic_error("half-edges: expected two opposite sides to an edge, found others");
    twins[a] = b;
    twins[b] = a;
  }

  void add_edges(const std::vector<std::uint32_t>& twins) {
    for (std::size_t side = 0; side < half_edges_.size(); ++side) {
      if (half_edges_[side].is_valid()) continue;
      half_edges_[side] = result_.new_edge(vertices_[begin(side)], vertices_[end(side)]);
      const HalfEdge other = result_.opposite_halfedge_handle(half_edges_[side]);
      if (twins[side] == side)
        borders_.push_back(other);
      else
        half_edges_[twins[side]] = other;
    }
  }

  void add_faces() {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const OpenMesh::FaceHandle face = result_.new_face();
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const HalfEdge half_edge = half_edges_[3 * t + corner];
        result_.set_face_handle(half_edge, face);
        result_.set_next_halfedge_handle(half_edge, half_edges_[3 * t + (corner + 1) % 3]);
        result_.set_halfedge_handle(vertices_[begin(3 * t + corner)], half_edge);
      }
      result_.set_halfedge_handle(face, half_edges_[3 * t + 2]);
    }
  }

  /// A vertex has at most one border, and OpenMesh requires it to store that.
  void join_borders() {
    for (const HalfEdge border : borders_) {
      const Vertex vertex = result_.from_vertex_handle(border);
      if (result_.is_boundary(result_.halfedge_handle(vertex)))
        throw std::logic_error("half-edges: expected one border at a vertex, found more");
      result_.set_halfedge_handle(vertex, border);
    }
    for (const HalfEdge border : borders_)
      result_.set_next_halfedge_handle(border,
                                       result_.halfedge_handle(result_.to_vertex_handle(border)));
  }

  const TriangleMesh& mesh_;
  HalfEdgeMesh result_;
  std::vector<Vertex> vertices_;      ///< by point
  std::vector<HalfEdge> half_edges_;  ///< by side
  std::vector<HalfEdge> borders_;
};

}  // namespace

HalfEdgeMesh half_edge_mesh(const TriangleMesh& mesh) { return Builder(mesh).run(); }

}  // namespace clay::solid
