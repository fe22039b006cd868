#include "export/repair/exact_refinement.hpp"

#include "core/cancel.hpp"
#include "core/parallel_parts.hpp"
#include "export/proof/intersecting_pairs.hpp"
#include "export/proof/pair_test.hpp"
#include "export/repair/sheet_count.hpp"
#include "export/repair/triangle_crossing.hpp"
#include "export/solid/disjoint_sets.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace clay::solid::inline repair {
namespace {

using Point2 = ExactKernel::Point_2;
using Number = ExactKernel::FT;
constexpr std::uint32_t kUnknown = UINT32_MAX;
/// The vertex of the soup at a vertex of the triangulation.
struct SoupVertex {
  std::uint32_t number = kUnknown;
};
/// The sheets that cover a face.
struct Cover {
  int sheets = 0;
  bool known = false;
  std::array<int, 3> steps{};  ///< increase of their number across each edge
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<SoupVertex, ExactKernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<
    Cover, ExactKernel, CGAL::Constrained_triangulation_face_base_2<ExactKernel>>;
using Planar = CGAL::Constrained_Delaunay_triangulation_2<
    ExactKernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::Exact_intersections_tag>;
using PlanarVertex = Planar::Vertex_handle;
using PlanarFace = Planar::Face_handle;

/// Finds equal exact points.
class PointRegister {
 public:
  explicit PointRegister(ExactSoup& soup) : soup_(soup) {}

  void add_known(std::uint32_t v) { at_[key(soup_.points[v])].push_back(v); }

  std::uint32_t number_of(const ExactPoint& point) {
    const glm::dvec3 near = cgal::doubles_of(point);
    auto& same = at_[key(near)];
    for (const std::uint32_t v : same)
      if (soup_.point(v) == point) return v;
    const auto fresh = static_cast<std::uint32_t>(soup_.points.size());
    soup_.points.push_back(near);
    soup_.exact.push_back(point);
    same.push_back(fresh);
    return fresh;
  }

 private:
  using Key = std::tuple<double, double, double>;
  static Key key(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

  ExactSoup& soup_;
  std::map<Key, std::vector<std::uint32_t>> at_;
};

/// A plane seen along the axis that its normal is nearest to.
class Projection {
 public:
  Projection(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c)
      : origin_(a), normal_(CGAL::normal(a, b, c)) {
    double longest = -1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double length = std::abs(CGAL::to_double(normal_[axis]));
      if (length > longest && normal_[axis] != 0) {
        longest = length;
        axis_ = axis;
      }
    }
  }
  [[nodiscard]] Point2 flat(const ExactPoint& p) const {
    return {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3]};
  }
  [[nodiscard]] ExactPoint lifted(const Point2& p) const {
    const int u = (axis_ + 1) % 3, v = (axis_ + 2) % 3;
    std::array<Number, 3> at;
    at.at(static_cast<std::size_t>(u)) = p.x();
    at.at(static_cast<std::size_t>(v)) = p.y();
    at.at(static_cast<std::size_t>(axis_)) =
        origin_[axis_] -
        (normal_[u] * (p.x() - origin_[u]) + normal_[v] * (p.y() - origin_[v])) / normal_[axis_];
    return {at[0], at[1], at[2]};
  }

 private:
  ExactPoint origin_;
  ExactKernel::Vector_3 normal_;
  int axis_ = 0;
};

/// Coplanar triangles that overlap, with everything that cuts them.
struct Sheet {
  std::vector<std::uint32_t> triangles;
  std::vector<std::size_t> cuts;  ///< numbers of pairs
};

class Refinement {
 public:
  Refinement(const TriangleMesh& soup, StageReport& stage) : mesh_{soup.points, {}}, stage_(stage) {
    result_.points = soup.points;
    result_.first_new = soup.points.size();
    SheetCount counted = count_sheets(soup);
    mesh_.triangles = std::move(counted.triangles);
    sheets_ = std::move(counted.sheets);
  }

  Result<ExactSoup> run() {
    stage_.begin("finding intersections");
    const std::vector<TrianglePair> pairs = intersecting_pairs(mesh_, kMostCuts);
    if (pairs.size() >= kMostCuts)
      return failure(ErrorKind::unsound,
                     "expected fewer than " + std::to_string(kMostCuts) +
                         " pairs of intersecting triangles, found at least as many");
    stage_.begin("cutting triangles");
    const std::vector<Sheet> sheets = sheets_of(pairs);
    find_common(pairs);
    PointRegister known(result_);
    result_.at_cut.assign(result_.first_new, false);
    for (const Sheet& sheet : sheets)
      for (const std::uint32_t t : sheet.triangles)
        for (const std::uint32_t v : mesh_.triangles[t]) {
          if (!result_.at_cut[v]) known.add_known(v);
          result_.at_cut[v] = true;
        }
    find_inner_sides();
    std::size_t cuts = 0;  // each pair cuts two sheets
    for (const Sheet& sheet : sheets) {
      cut(sheet, known);
      stage_.done(cuts += sheet.cuts.size(), 2 * pairs.size());
    }
    keep_untouched();
    return std::move(result_);
  }

 private:
  [[nodiscard]] ExactPoint corner(std::uint32_t t, std::size_t c) const {
    return exact_point(mesh_.points[mesh_.triangles[t].at(c)]);
  }

  [[nodiscard]] bool coplanar(std::uint32_t t, std::uint32_t u) const {
    for (std::size_t c = 0; c < 3; ++c)
      if (!CGAL::coplanar(corner(t, 0), corner(t, 1), corner(t, 2), corner(u, c))) return false;
    return true;
  }

  std::vector<Sheet> sheets_of(const std::vector<TrianglePair>& pairs) {
    touched_.assign(mesh_.triangles.size(), false);
    DisjointSets planes(mesh_.triangles.size());
    std::vector<bool> flat(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      step_of_loop();
      const auto& [t, u] = pairs[i];
      touched_[t] = touched_[u] = true;
      flat[i] = coplanar(t, u);
      if (flat[i]) planes.unite(t, u);
    }
    std::map<std::uint32_t, Sheet> by_root;
    plane_of_.assign(mesh_.triangles.size(), kNoPart);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!touched_[t]) continue;
      plane_of_[t] = planes.of(t);
      by_root[plane_of_[t]].triangles.push_back(t);
    }
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (flat[i]) continue;
      by_root[planes.of(pairs[i].first)].cuts.push_back(i);
      by_root[planes.of(pairs[i].second)].cuts.push_back(i);
    }
    flat_ = std::move(flat);
    std::vector<Sheet> sheets;
    for (auto& [first, sheet] : by_root) sheets.push_back(std::move(sheet));
    return sheets;
  }

  /// Pairs that only touch in a shared edge or vertex are not listed, and need no cut.
  void find_common(const std::vector<TrianglePair>& pairs) {
    constexpr std::size_t kPartPairs = 256;
    common_.resize(pairs.size());
    for_each_part((pairs.size() + kPartPairs - 1) / kPartPairs, [&](std::size_t part) {
      const std::size_t end = std::min(pairs.size(), (part + 1) * kPartPairs);
      for (std::size_t i = part * kPartPairs; i < end; ++i) {
        step_of_loop();
        const auto& [t, u] = pairs[i];
        if (!flat_[i]) common_[i] = common_of(mesh_, t, u, plane_of_[t], plane_of_[u]);
      }
    });
  }

  [[nodiscard]] std::uint32_t number_of(const CrossingPoint& point, PointRegister& known) {
    if (point.is_vertex()) return point.name[0];
    const auto [at, fresh] = number_of_.try_emplace(point.name, 0U);
    if (!fresh) return at->second;
    const ExactPoint from = exact_point(mesh_.points[point.from]);
    const ExactPoint origin = corner(point.triangle, 0);
    const ExactKernel::Vector_3 way = exact_point(mesh_.points[point.to]) - from;
    const ExactKernel::Vector_3 normal =
        CGAL::normal(origin, corner(point.triangle, 1), corner(point.triangle, 2));
    return at->second = known.number_of(from + ((origin - from) * normal) / (way * normal) * way);
  }

  void cut(const Sheet& sheet, PointRegister& known) {
    const std::uint32_t first = sheet.triangles.front();
    const Projection projection(corner(first, 0), corner(first, 1), corner(first, 2));
    const SheetLines drawn = lines_on(sheet, known);
    std::vector<std::pair<Point2, SoupVertex>> points;
    for (const std::uint32_t v : drawn.vertices)
      points.emplace_back(projection.flat(result_.point(v)), SoupVertex{v});
    Planar plane;
    plane.insert(points.begin(), points.end());
    std::unordered_map<std::uint32_t, PlanarVertex> at;
    for (const auto v : plane.finite_vertex_handles()) at.emplace(v->info().number, v);
    for (const auto& [a, b] : drawn.lines) {
      stop_if_cancelled();
      plane.insert_constraint(at.at(a), at.at(b));
    }
    for (const auto v : plane.finite_vertex_handles())
      if (v->info().number == kUnknown)
        v->info().number = known.number_of(projection.lifted(v->point()));
    for (const Side& side : outer_sides(sheet))
      note_side(plane, at.at(side.low), at.at(side.high), side.sheets);
    cover_faces(plane);
    take_faces(plane);
  }

  struct SheetLines {
    std::vector<std::uint32_t> vertices;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> lines;  ///< low vertex first
  };

  /// The border of a sheet, and where other triangles cross it.
  SheetLines lines_on(const Sheet& sheet, PointRegister& known) {
    SheetLines drawn;
    for (const std::uint32_t t : sheet.triangles)
      drawn.vertices.insert(drawn.vertices.end(), mesh_.triangles[t].begin(),
                            mesh_.triangles[t].end());
    for (const Side& side : outer_sides(sheet)) drawn.lines.emplace_back(side.low, side.high);
    for (const std::size_t i : sheet.cuts) {
      stop_if_cancelled();
      if (common_[i].points == 0) continue;
      const std::uint32_t from = number_of(common_[i].ends[0], known);
      const std::uint32_t to = common_[i].points == 1 ? from : number_of(common_[i].ends[1], known);
      drawn.vertices.insert(drawn.vertices.end(), {from, to});
      if (from != to) drawn.lines.push_back(std::minmax(from, to));
    }
    sort_and_drop_equal(drawn.vertices);
    sort_and_drop_equal(drawn.lines);
    return drawn;
  }

  template <class Item>
  static void sort_and_drop_equal(std::vector<Item>& items) {
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
  }

  struct Side {
    std::uint32_t low, high;
    int sheets;  ///< those left of it minus those right of it, from low to high
  };
  [[nodiscard]] Side side_of(std::uint32_t t, std::size_t c) const {
    const std::uint32_t a = mesh_.triangles[t].at(c), b = mesh_.triangles[t].at((c + 1) % 3);
    return a < b ? Side{a, b, sheets_[t]} : Side{b, a, -sheets_[t]};
  }

  [[nodiscard]] std::vector<Side> outer_sides(const Sheet& sheet) const {
    std::vector<Side> sides;
    for (const std::uint32_t t : sheet.triangles)
      for (std::size_t c = 0; c < 3; ++c)
        if (const Side side = side_of(t, c); !inner_.contains({side.low, side.high}))
          sides.push_back(side);
    return sides;
  }

  /// Sides between triangles of one sheet that cancel bound nothing. Without them, the many
  /// overlapping triangles of a flat face are cut only where its border is.
  void find_inner_sides() {
    struct Users {
      std::uint32_t plane;
      int sheets;
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, Users> users;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) {
        const Side side = side_of(t, c);
        if (!result_.at_cut[side.low] || !result_.at_cut[side.high]) continue;
        auto& [plane, sheets] =
            users.try_emplace({side.low, side.high}, Users{plane_of_[t], 0}).first->second;
        if (plane != plane_of_[t]) plane = kNoPart;
        sheets += side.sheets;
      }
    for (const auto& [ends, of_side] : users)
      if (of_side.plane != kNoPart && of_side.sheets == 0) inner_.insert(ends);
  }

  /// Left of a line through the vertices from a to b there are `sheets` more than right of it.
  static void note_side(Planar& plane, PlanarVertex a, PlanarVertex b, int sheets) {
    PlanarVertex next;
    for (PlanarVertex v = a; v != b; v = next) {
      PlanarFace face;
      int edge = 0;
      if (!plane.includes_edge(v, b, next, face, edge)) throw std::logic_error("lost edge");
      const int more = face->vertex(Planar::ccw(edge)) == v ? -sheets : sheets;
      const auto across = static_cast<std::size_t>(plane.mirror_index(face, edge));
      face->info().steps.at(static_cast<std::size_t>(edge)) += more;
      face->neighbor(edge)->info().steps.at(across) -= more;
    }
  }

  /// From the outside, which no sheet covers.
  static void cover_faces(Planar& plane) {
    std::vector<PlanarFace> open{plane.infinite_face()};
    open.back()->info().known = true;
    while (!open.empty()) {
      const PlanarFace face = open.back();
      open.pop_back();
      for (int edge = 0; edge < 3; ++edge) {
        const PlanarFace next = face->neighbor(edge);
        if (next->info().known) continue;
        next->info().known = true;
        next->info().sheets =
            face->info().sheets + face->info().steps.at(static_cast<std::size_t>(edge));
        open.push_back(next);
      }
    }
  }

  void take_faces(const Planar& plane) {
    for (const auto face : plane.finite_face_handles()) {
      const int sheets = face->info().sheets;
      if (sheets == 0) continue;
      Triangle triangle{face->vertex(0)->info().number, face->vertex(1)->info().number,
                        face->vertex(2)->info().number};
      if (sheets < 0) std::swap(triangle[1], triangle[2]);
      result_.triangles.push_back(triangle);
      result_.sheets.push_back(std::abs(sheets));
    }
  }

  void keep_untouched() {
    std::vector<Triangle> triangles;
    std::vector<int> sheets;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (touched_[t]) continue;
      triangles.push_back(mesh_.triangles[t]);
      sheets.push_back(sheets_[t]);
    }
    triangles.insert(triangles.end(), result_.triangles.begin(), result_.triangles.end());
    sheets.insert(sheets.end(), result_.sheets.begin(), result_.sheets.end());
    result_.triangles = std::move(triangles);
    result_.sheets = std::move(sheets);
  }

  TriangleMesh mesh_;
  StageReport& stage_;
  std::vector<int> sheets_;
  std::vector<bool> touched_;
  std::vector<bool> flat_;               ///< by pair: both lie in one plane
  std::vector<std::uint32_t> plane_of_;  ///< by triangle that is cut: the first of its sheet
  std::vector<Common> common_;           ///< by pair; empty in one plane
  std::set<std::pair<std::uint32_t, std::uint32_t>> inner_;          ///< sides, low vertex first
  std::map<std::array<std::uint32_t, 4>, std::uint32_t> number_of_;  ///< by name of a crossing
  ExactSoup result_;
};

}  // namespace

Result<ExactSoup> refine(const TriangleMesh& soup, StageReport& stage) {
  return Refinement(soup, stage).run();
}

}  // namespace clay::solid::inline repair
