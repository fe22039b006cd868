#include "export/solid/edge_collapse.hpp"

#include "core/cancel.hpp"

#include <OpenMesh/Core/Geometry/QuadricT.hh>
#include <OpenMesh/Tools/Utils/HeapT.hh>
#include <algorithm>
#include <cfloat>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;
using Quadric = OpenMesh::Geometry::QuadricT<double>;

/// Cosine between the normals of two faces of a regular tetrahedron, -1/3, with a margin. A sharper
/// edge is a fold, unless the mesh had one there.
constexpr double kFoldCosine = -0.34;

/// OpenMesh's decimater tests all edges of a vertex and then takes the one of the smallest error.
/// Here the errors come first, so that mostly one edge is tested; the collapses are the same.
class EdgeCollapse {
 public:
  explicit EdgeCollapse(HalfEdgeMesh& mesh)
      : mesh_(mesh),
        quadrics_(mesh.n_vertices(), Quadric(0.0, 0.0, 0.0, 0.0)),
        ways_(mesh.n_vertices()),
        errors_(mesh.n_vertices(), -1.0F),
        positions_(mesh.n_vertices(), -1),
        heap_(Order{&errors_, &positions_}) {
    mesh_.request_vertex_status();
    mesh_.request_edge_status();
    mesh_.request_face_status();
    mesh_.request_face_normals();
    mesh_.update_face_normals();
  }

  void run(std::size_t max_triangles, const std::function<void(double)>& progress) {
    constexpr std::size_t kReport = 4096;
    add_quadrics();
    heap_.reserve(mesh_.n_vertices());
    for (const VertexHandle v : mesh_.vertices()) enter(v);
    const std::size_t all = mesh_.n_faces();
    std::size_t left = all;
    std::vector<VertexHandle> around;
    for (std::size_t pops = 0; !heap_.empty() && left > max_triangles; ++pops) {
      if (progress && pops % kReport == 0)
        progress(static_cast<double>(all - left) / static_cast<double>(all - max_triangles));
      const VertexHandle next = heap_.front();
      const HalfedgeHandle way = ways_[number(next)];
      heap_.pop_front();
      if (!may_collapse(way)) continue;
      if (!keeps_faces_up(way)) {  // a collapse nearby has changed the faces
        enter(next);
        continue;
      }
      around.clear();
      for_each_way_from(mesh_.from_vertex_handle(way),
                        [&](HalfedgeHandle out) { around.push_back(mesh_.to_vertex_handle(out)); });
      collapse(way);
      left -= 2;
      for (const VertexHandle v : around) enter(v);
    }
  }

 private:
  /// For the heap of OpenMesh.
  struct Order {
    std::vector<float>* errors;
    std::vector<int>* positions;
    bool less(VertexHandle a, VertexHandle b) const {
      return (*errors)[number(a)] < (*errors)[number(b)];
    }
    bool greater(VertexHandle a, VertexHandle b) const { return less(b, a); }
    int get_heap_position(VertexHandle v) const { return (*positions)[number(v)]; }
    void set_heap_position(VertexHandle v, int at) const { (*positions)[number(v)] = at; }
  };

  static std::size_t number(VertexHandle v) { return static_cast<std::size_t>(v.idx()); }

  template <class Visit>
  void for_each_way_from(VertexHandle v, const Visit& visit) const {
    const HalfedgeHandle first = mesh_.halfedge_handle(v);
    HalfedgeHandle way = first;
    do {
      visit(way);
      way = mesh_.cw_rotated_halfedge_handle(way);
    } while (way != first);
  }

  void add_quadrics() {
    for (const FaceHandle face : mesh_.faces()) {
      step_of_loop();
      auto corner = mesh_.cfv_iter(face);
      const VertexHandle a = *corner++, b = *corner++, c = *corner;
      OpenMesh::Vec3d normal =
          (mesh_.point(b) - mesh_.point(a)) % (mesh_.point(c) - mesh_.point(a));
      double area = normal.norm();
      if (area > FLT_MIN) {
        normal /= area;
        area *= 0.5;
      }
      Quadric quadric(normal[0], normal[1], normal[2], -(mesh_.point(a) | normal));
      quadric *= area;
      for (const VertexHandle v : {a, b, c}) quadrics_[number(v)] += quadric;
    }
  }

  /// Rounding makes some errors of flat places negative.
  [[nodiscard]] float error_of(HalfedgeHandle way) const {
    const VertexHandle kept = mesh_.to_vertex_handle(way);
    Quadric sum = quadrics_[number(mesh_.from_vertex_handle(way))];
    sum += quadrics_[number(kept)];
    const double error = sum(mesh_.point(kept));
    return error < DBL_MAX ? std::max(static_cast<float>(error), 0.0F) : 0.0F;
  }

  /// The vertex gets its place in the heap by its best collapse, or none.
  void enter(VertexHandle v) {
    step_of_loop();
    candidates_.clear();
    std::uint32_t order = 0;
    for_each_way_from(v, [&](HalfedgeHandle way) {
      candidates_.push_back({error_of(way), order++, way});
    });
    // By error, then in the order around the vertex.
    const auto later = [](const Candidate& a, const Candidate& b) {
      return std::pair(a.error, a.order) > std::pair(b.error, b.order);
    };
    std::make_heap(candidates_.begin(), candidates_.end(), later);
    while (!candidates_.empty()) {
      const Candidate best = candidates_.front();
      if (best.error < FLT_MAX && may_collapse(best.way) && keeps_faces_up(best.way))
        return place(v, best);
      std::pop_heap(candidates_.begin(), candidates_.end(), later);
      candidates_.pop_back();
    }
    if (heap_.is_stored(v)) heap_.remove(v);
  }

  struct Candidate {
    float error;
    std::uint32_t order;
    HalfedgeHandle way;
  };
  void place(VertexHandle v, const Candidate& best) {
    ways_[number(v)] = best.way;
    errors_[number(v)] = best.error;
    if (heap_.is_stored(v))
      heap_.update(v);
    else
      heap_.insert(v);
  }

  /// The mesh stays a closed manifold: the ends of the edge have no common neighbours but the tips
  /// of its two triangles, which differ, and no tetrahedron is left flat.
  [[nodiscard]] bool may_collapse(HalfedgeHandle way) const {
    const HalfedgeHandle back = mesh_.opposite_halfedge_handle(way);
    const VertexHandle gone = mesh_.from_vertex_handle(way), kept = mesh_.to_vertex_handle(way);
    if (mesh_.status(mesh_.edge_handle(way)).deleted() || mesh_.status(gone).deleted() ||
        mesh_.status(kept).deleted())
      return false;
    const VertexHandle left = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(way));
    const VertexHandle right = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(back));
    if (left == right) return false;
    bool alone = true;
    for_each_way_from(gone, [&](HalfedgeHandle at_gone) {
      const VertexHandle a = mesh_.to_vertex_handle(at_gone);
      if (a == kept || a == left || a == right) return;
      for_each_way_from(kept, [&](HalfedgeHandle at_kept) {
        alone = alone && mesh_.to_vertex_handle(at_kept) != a;
      });
    });
    if (!alone) return false;
    const bool tetrahedron = mesh_.valence(left) == 3 && mesh_.valence(right) == 3 &&
                             mesh_.find_halfedge(left, right).is_valid();
    // At least two triangles at the vertex that goes.
    return !tetrahedron &&
           mesh_.cw_rotated_halfedge_handle(mesh_.cw_rotated_halfedge_handle(way)) != way;
  }

  /// No triangle that stays turns by 90 degrees or more when the start of `way` moves to its end,
  /// and none folds over its neighbour. Small turns alone may add up to a fold.
  [[nodiscard]] bool keeps_faces_up(HalfedgeHandle way) {
    const VertexHandle gone = mesh_.from_vertex_handle(way);
    const FaceHandle left = mesh_.face_handle(way);
    const FaceHandle right = mesh_.face_handle(mesh_.opposite_halfedge_handle(way));
    const OpenMesh::Vec3d before = mesh_.point(gone);
    mesh_.set_point(gone, mesh_.point(mesh_.to_vertex_handle(way)));
    bool up = true;
    double sharpest = 1.0;
    for_each_way_from(gone, [&](HalfedgeHandle out) {
      const FaceHandle face = mesh_.face_handle(out);
      if (!up || face == left || face == right) return;
      const OpenMesh::Vec3d normal = mesh_.calc_face_normal(face);
      up = dot(mesh_.normal(face), normal) > 0.0;
      sharpest = std::min(sharpest, least_cosine_beside(out, normal, way));
    });
    mesh_.set_point(gone, before);
    return up && (sharpest >= kFoldCosine || sharpest >= sharpest_around(gone));
  }

  /// The face beyond an edge, after the collapse of `way`: its two triangles are gone.
  [[nodiscard]] FaceHandle face_beyond(HalfedgeHandle edge, HalfedgeHandle way) const {
    const auto across = [&](HalfedgeHandle h) {
      return mesh_.face_handle(mesh_.opposite_halfedge_handle(h));
    };
    const HalfedgeHandle back = mesh_.opposite_halfedge_handle(way);
    const FaceHandle face = across(edge);
    if (face == mesh_.face_handle(way)) return across(mesh_.next_halfedge_handle(way));
    if (face == mesh_.face_handle(back)) return across(mesh_.prev_halfedge_handle(back));
    return face;
  }

  /// The least cosine between the normal of the triangle of `out` and its neighbours, whose points
  /// are where the collapse of `way` leaves them.
  [[nodiscard]] double least_cosine_beside(HalfedgeHandle out, const OpenMesh::Vec3d& normal,
                                           HalfedgeHandle way) const {
    double least = 1.0;
    for (const HalfedgeHandle edge :
         {out, mesh_.next_halfedge_handle(out), mesh_.prev_halfedge_handle(out)})
      least = std::min(least, dot(normal, mesh_.calc_face_normal(face_beyond(edge, way))));
    return least;
  }

  /// The least cosine between neighbours around a vertex as it is.
  [[nodiscard]] double sharpest_around(VertexHandle v) const {
    double least = 1.0;
    for_each_way_from(v, [&](HalfedgeHandle out) {
      const auto& normal = mesh_.normal(mesh_.face_handle(out));
      for (const HalfedgeHandle edge : {out, mesh_.next_halfedge_handle(out)}) {
        const FaceHandle beyond = mesh_.face_handle(mesh_.opposite_halfedge_handle(edge));
        least = std::min(least, dot(normal, mesh_.normal(beyond)));
      }
    });
    return least;
  }

  void collapse(HalfedgeHandle way) {
    const VertexHandle gone = mesh_.from_vertex_handle(way), kept = mesh_.to_vertex_handle(way);
    mesh_.collapse(way);
    for_each_way_from(kept, [&](HalfedgeHandle out) {
      const FaceHandle face = mesh_.face_handle(out);
      mesh_.set_normal(face, mesh_.calc_face_normal(face));
    });
    quadrics_[number(kept)] += quadrics_[number(gone)];
  }

  HalfEdgeMesh& mesh_;
  std::vector<Quadric> quadrics_;      ///< by vertex
  std::vector<HalfedgeHandle> ways_;   ///< by vertex in the heap: its best collapse
  std::vector<float> errors_;          ///< of that collapse
  std::vector<int> positions_;         ///< in the heap; -1: not in it
  std::vector<Candidate> candidates_;  ///< of one vertex
  OpenMesh::Utils::HeapT<VertexHandle, Order> heap_;
};

}  // namespace

void collapse_edges(HalfEdgeMesh& mesh, std::size_t max_triangles,
                    const std::function<void(double)>& progress) {
  EdgeCollapse(mesh).run(max_triangles, progress);
}

}  // namespace clay::solid
