#include "export/repair/exact_refinement.hpp"

#include "core/cancel.hpp"
#include "core/parallel_parts.hpp"
#include "export/proof/pair_test.hpp"
#include "export/repair/intersecting_pairs.hpp"
#include "export/repair/sheet_count.hpp"
#include "export/solid/cgal_versions.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/intersections.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace clay::solid::inline repair {
namespace {

using Point2 = ExactKernel::Point_2;
using Number = ExactKernel::FT;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, ExactKernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<ExactKernel>;
using Planar = CGAL::Constrained_Delaunay_triangulation_2<
    ExactKernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::Exact_intersections_tag>;

/// Finds equal exact points.
class PointRegister {
 public:
  explicit PointRegister(ExactSoup& soup) : soup_(soup) {}

  void add_known(std::uint32_t v) { at_[key(soup_.points[v])].push_back(v); }

  std::uint32_t number_of(const ExactPoint& point) {
    const glm::dvec3 near = nearest_double(point);
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

/// What two triangles of different planes have in common: a segment, or a point, twice.
using Common = std::optional<std::pair<ExactPoint, ExactPoint>>;

/// Coplanar triangles that overlap, with everything that cuts them.
struct Sheet {
  std::vector<std::uint32_t> triangles;
  std::vector<std::size_t> cuts;  ///< numbers of pairs
};

class Refinement {
 public:
  explicit Refinement(const TriangleMesh& soup) : mesh_{soup.points, {}} {
    result_.points = soup.points;
    result_.first_new = soup.points.size();
    SheetCount counted = count_sheets(soup);
    mesh_.triangles = std::move(counted.triangles);
    sheets_ = std::move(counted.sheets);
  }

  Result<ExactSoup> run() {
    const std::vector<TrianglePair> pairs = intersecting_pairs(mesh_, kMostCuts);
    if (pairs.size() >= kMostCuts)
      return failure(ErrorKind::unsound,
                     "expected fewer than " + std::to_string(kMostCuts) +
                         " pairs of intersecting triangles, found at least as many");
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
    for (const Sheet& sheet : sheets) cut(sheet, known);
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
    std::map<std::uint32_t, std::uint32_t> parent;
    const auto root = [&](std::uint32_t t) {
      while (parent[t] != t) t = parent[t] = parent[parent[t]];
      return t;
    };
    std::vector<bool> flat(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      step_of_loop();
      const auto& [t, u] = pairs[i];
      for (const std::uint32_t each : {t, u}) {
        touched_[each] = true;
        parent.emplace(each, each);
      }
      flat[i] = coplanar(t, u);
      if (!flat[i]) continue;
      const std::uint32_t a = root(t), b = root(u);
      parent[std::max(a, b)] = std::min(a, b);
    }
    std::map<std::uint32_t, Sheet> by_root;
    for (const auto& entry : parent) by_root[root(entry.first)].triangles.push_back(entry.first);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (flat[i]) continue;
      by_root[root(pairs[i].first)].cuts.push_back(i);
      by_root[root(pairs[i].second)].cuts.push_back(i);
    }
    flat_ = std::move(flat);
    std::vector<Sheet> sheets;
    for (auto& [first, sheet] : by_root) sheets.push_back(std::move(sheet));
    return sheets;
  }

  /// Most of the time goes into these exact points. Pairs that only touch in a shared edge or
  /// vertex are not listed, and need no cut.
  void find_common(const std::vector<TrianglePair>& pairs) {
    constexpr std::size_t kPartPairs = 256;
    common_.resize(pairs.size());
    for_each_part((pairs.size() + kPartPairs - 1) / kPartPairs, [&](std::size_t part) {
      const std::size_t end = std::min(pairs.size(), (part + 1) * kPartPairs);
      for (std::size_t i = part * kPartPairs; i < end; ++i) {
        step_of_loop();
        if (!flat_[i]) common_[i] = common_of(pairs[i].first, pairs[i].second);
      }
    });
  }

  [[nodiscard]] ExactKernel::Triangle_3 exact(std::uint32_t t) const {
    return {corner(t, 0), corner(t, 1), corner(t, 2)};
  }

  void cut(const Sheet& sheet, PointRegister& known) {
    const std::uint32_t first = sheet.triangles.front();
    const Projection projection(corner(first, 0), corner(first, 1), corner(first, 2));
    Planar plane;
    for (const std::uint32_t t : sheet.triangles) {
      std::array<Planar::Vertex_handle, 3> at;
      for (std::size_t c = 0; c < 3; ++c) at.at(c) = plane.insert(projection.flat(corner(t, c)));
      for (std::size_t c = 0; c < 3; ++c) plane.insert_constraint(at.at(c), at.at((c + 1) % 3));
    }
    for (const std::size_t i : sheet.cuts) {
      stop_if_cancelled();
      if (!common_[i]) continue;
      const auto& [from, to] = *common_[i];
      if (from == to)
        plane.insert(projection.flat(from));
      else
        plane.insert_constraint(projection.flat(from), projection.flat(to));
    }
    for (const auto v : plane.finite_vertex_handles())
      v->info() = known.number_of(projection.lifted(v->point()));
    take_faces(plane, projection, sheet);
  }

  [[nodiscard]] Common common_of(std::uint32_t t, std::uint32_t u) const {
    const auto common = CGAL::intersection(exact(t), exact(u));
    if (!common) return std::nullopt;
    if (const auto* point = cgal::get_if<ExactPoint>(*common)) return std::pair(*point, *point);
    if (const auto* segment = cgal::get_if<ExactKernel::Segment_3>(*common))
      return std::pair(segment->source(), segment->target());
    return std::nullopt;
  }

  void take_faces(const Planar& plane, const Projection& projection, const Sheet& sheet) {
    struct Member {
      std::array<Point2, 3> corners;
      CGAL::Orientation turn;
      int sheets;
      CGAL::Bbox_2 box;
    };
    std::vector<Member> members;
    for (const std::uint32_t t : sheet.triangles) {
      std::array<Point2, 3> at{projection.flat(corner(t, 0)), projection.flat(corner(t, 1)),
                               projection.flat(corner(t, 2))};
      members.push_back({at, CGAL::orientation(at[0], at[1], at[2]), sheets_[t],
                         at[0].bbox() + at[1].bbox() + at[2].bbox()});
    }
    for (const auto face : plane.finite_face_handles()) {
      const Point2 middle = CGAL::centroid(face->vertex(0)->point(), face->vertex(1)->point(),
                                           face->vertex(2)->point());
      const CGAL::Bbox_2 near = middle.bbox();
      int sheets = 0;
      for (const Member& m : members) {
        bool inside = members.size() == 1 || CGAL::do_overlap(near, m.box);
        for (std::size_t c = 0; c < 3 && inside && members.size() > 1; ++c)
          inside = CGAL::orientation(m.corners.at(c), m.corners.at((c + 1) % 3), middle) == m.turn;
        if (inside) sheets += m.turn == CGAL::LEFT_TURN ? m.sheets : -m.sheets;
      }
      if (sheets == 0) continue;
      Triangle triangle{face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
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
  std::vector<int> sheets_;
  std::vector<bool> touched_;
  std::vector<bool> flat_;      ///< by pair: both lie in one plane
  std::vector<Common> common_;  ///< by pair; empty in one plane
  ExactSoup result_;
};

}  // namespace

Result<ExactSoup> refine(const TriangleMesh& soup) { return Refinement(soup).run(); }

}  // namespace clay::solid::inline repair
