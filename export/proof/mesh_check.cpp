#include "claystack/export/proof.hpp"

#include "core/compensated_sum.hpp"
#include "core/parallel_parts.hpp"
#include "core/text.hpp"
#include "export/proof/soup_intersections.hpp"
#include "export/solid/bounded_volume.hpp"
#include "export/solid/mesh_geometry.hpp"
#include "export/solid/mesh_topology.hpp"
#include "export/solid/shell_volumes.hpp"

#include <array>
#include <cmath>
#include <exception>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <new>
#include <optional>
#include <string>
#include <string_view>

namespace clay::solid::inline proof {
namespace {

/// Numbers count from 1 in the order of the file, as those of its readers do.
std::string numbered(std::string_view noun, const std::vector<std::uint32_t>& numbers) {
  std::string text(noun);
  if (numbers.size() > 1) text += "s";
  for (std::size_t i = 0; i < numbers.size(); ++i)
    text += (i == 0 ? " " : ", ") + std::to_string(numbers[i] + 1);
  return text;
}

std::string coordinates(const glm::dvec3& place) {
  return std::string("(") + nine_digit_text(place.x) + ", " + nine_digit_text(place.y) + ", " +
         nine_digit_text(place.z) + ") mm";
}

/// The middle of the faulty vertices; if none are listed, of the first triangle.
std::string coordinates(const TriangleMesh& mesh, const Fault& fault) {
  const Triangle& triangle = mesh.triangles[fault.triangles.front()];
  const std::vector<std::uint32_t> corners(triangle.begin(), triangle.end());
  const std::vector<std::uint32_t>& vertices = fault.vertices.empty() ? corners : fault.vertices;
  glm::dvec3 middle{0.0};
  for (const std::uint32_t v : vertices)
    middle += mesh.points[v] / static_cast<double>(vertices.size());
  return coordinates(middle);
}

using Corners = std::array<glm::dvec3, 3>;

/// The point at which a segment passes through a triangle; empty if the segment lies in the
/// triangle's plane.
std::optional<glm::dvec3> pierced(const glm::dvec3& from, const glm::dvec3& to, const Corners& t) {
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double a = glm::dot(normal, from - t[0]), b = glm::dot(normal, to - t[0]);
  if (a == b || a * b > 0.0) return std::nullopt;
  const glm::dvec3 at = from + a / (a - b) * (to - from);
  const double least = -1e-9 * glm::dot(normal, normal);
  for (std::size_t i = 0; i < 3; ++i)
    if (glm::dot(normal, glm::cross(t[(i + 1) % 3] - t[i], at - t[i])) < least) return std::nullopt;
  return at;
}

/// The middle of the points where the edges of either triangle pass through the other. Of triangles
/// in one plane: the place in the box of the second that is nearest to the middle of the first.
glm::dvec3 crossing_place(const Corners& a, const Corners& b) {
  glm::dvec3 sum{0.0};
  int found = 0;
  const auto add = [&](const Corners& edges, const Corners& triangle) {
    for (std::size_t i = 0; i < 3; ++i)
      if (const auto at = pierced(edges[i], edges[(i + 1) % 3], triangle)) sum += *at, ++found;
  };
  add(a, b);
  add(b, a);
  if (found > 0) return sum / static_cast<double>(found);
  return glm::clamp((a[0] + a[1] + a[2]) / 3.0, glm::min(glm::min(b[0], b[1]), b[2]),
                    glm::max(glm::max(b[0], b[1]), b[2]));
}

class Inspection {
 public:
  explicit Inspection(const TriangleMesh& mesh) : mesh_(mesh) {
    report_.triangles = mesh.triangles.size();
  }

  MeshReport run() {
    if (mesh_.triangles.empty() || mesh_.triangles.size() > kMaxTriangles) {
      problem("mesh size", "expected 1 to " + std::to_string(kMaxTriangles) + " triangles, found " +
                               std::to_string(mesh_.triangles.size()));
      return std::move(report_);
    }
    const bool finite = check_points();
    if (!check_indices()) return std::move(report_);
    MeshTopology topology;
    if (!finite) {
      check_topology(topology_of(mesh_.points.size(), mesh_.triangles));
      return std::move(report_);
    }
    SoupIntersections intersections(mesh_);
    for_each_part(1 + intersections.parts(), [&](std::size_t part) {
      if (part == 0)
        topology = topology_of(mesh_.points.size(), mesh_.triangles);
      else
        intersections.search(part - 1);
    });
    check_topology(topology);
    check_geometry(topology, intersections);
    return std::move(report_);
  }

 private:
  bool check_points() {
    Fault fault;
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v) {
      const glm::dvec3& p = mesh_.points[v];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) note(fault, {}, {v});
    }
    if (fault.found()) problem("non-finite point", numbered("point", fault.vertices), fault.count);
    return !fault.found();
  }

  bool check_indices() {
    const Fault fault = indices_out_of_range(mesh_.points.size(), mesh_.triangles);
    if (fault.found())
      problem("index out of range", numbered("triangle", fault.triangles), fault.count);
    return !fault.found();
  }

  void check_topology(const MeshTopology& topology) {
    report_.closed = topology.closed();
    report_.manifold = topology.manifold();
    report_.oriented = topology.oriented();
    report_.components = topology.components;
    report_.degenerate = topology.collapsed.count;
    problem("duplicate triangle", topology.duplicates);
    problem("open edge", topology.open_edges);
    problem("non-manifold edge", topology.crowded_edges);
    problem("edge between faces of opposite orientation", topology.flipped_edges);
    problem("non-manifold vertex", topology.split_vertices);
  }

  void check_geometry(const MeshTopology& topology, const SoupIntersections& intersections) {
    const SignedVolume volume = bounded_volume(mesh_);
    report_.volume_mm3 = volume.mm3;
    report_.has_volume = topology.balanced;
    measure();
    const Fault crossings = intersections.found();
    report_.degenerate = intersections.degenerate().count;
    report_.self_intersections = crossings.count;
    problem("degenerate triangle", intersections.degenerate());
    if (crossings.found()) problem_at_crossing(crossings);
    if (!topology.balanced) return;
    if (topology.manifold() && !intersections.degenerate().found() && !crossings.found())
      return check_outward(check_shells(topology, volume), volume);
    if (volume.sign_is_certain()) return check_outward(volume.mm3 > 0.0, volume);
    problem("no volume", "the triangles enclose 0 mm^3");
  }

  void measure() {
    CompensatedSum doubled_area;
    for (const auto& [a, b, c] : mesh_.triangles) {
      const glm::dvec3 &p = mesh_.points[a], &q = mesh_.points[b], &r = mesh_.points[c];
      doubled_area.add(glm::length(glm::cross(q - p, r - p)));
    }
    report_.area_mm2 = 0.5 * doubled_area.value();
    report_.size_mm = extent_of(mesh_).size();
  }

  void count_cavities(const MeshTopology& topology, const std::vector<std::uint32_t>& enclosed) {
    const auto volumes_mm3 = volumes_of_shells(
        mesh_, mesh_.triangles.size(), [&](std::size_t t) { return topology.component_of[t]; });
    // A cavity has a negative volume, and a body in it a positive one.
    for (const std::uint32_t shell : enclosed) {
      if (volumes_mm3[shell] < 0.0) ++report_.cavities;
      report_.trapped_mm3 -= volumes_mm3[shell];
    }
  }

  /// Returns true if the outermost shell is oriented outward.
  bool check_shells(const MeshTopology& topology, const SignedVolume& volume) {
    // One embedded shell always bounds a volume, and the sign of that volume is its orientation.
    if (topology.components == 1 && volume.sign_is_certain()) {
      report_.bounds_volume = true;
      return volume.mm3 > 0.0;
    }
    const ShellGeometry geometry = shell_geometry(mesh_, topology);
    report_.bounds_volume = geometry.bounds_volume;
    problem(geometry.only_filled
                ? "closed shell inside another one that faces outward; a slicer fills it"
                : "shell turned against its neighbours",
            geometry.misplaced_shells);
    contradicting_ = geometry.misplaced_shells.found() && !geometry.only_filled;
    if (geometry.bounds_volume && geometry.outward && topology.components > 1)
      count_cavities(topology, geometry.enclosed);
    return geometry.outward;
  }

  /// Contradicting shells are a problem already; then the sign of the sum has no meaning.
  void check_outward(bool outward, const SignedVolume& volume) {
    report_.oriented = outward && !contradicting_;
    if (outward || (!report_.bounds_volume && !volume.sign_is_certain())) return;
    problem("inside out",
            "normals point into the clay, volume " + nine_digit_text(report_.volume_mm3) + " mm^3");
  }

  void problem(std::string what, std::string where, std::size_t count = 1) {
    report_.problems.push_back({std::move(what), std::move(where), count, false});
  }
  void problem_at_crossing(const Fault& crossings) {
    const auto corners = [&](std::size_t which) {
      const Triangle& t = mesh_.triangles[crossings.triangles[which]];
      return Corners{mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]};
    };
    problem("self-intersection",
            numbered("triangle", crossings.triangles) + " at " +
                coordinates(crossing_place(corners(0), corners(1))),
            crossings.count);
    report_.problems.back().at_least = crossings.count == kMaxSelfIntersections;
  }
  void problem(std::string what, const Fault& fault) {
    if (fault.found())
      problem(std::move(what),
              numbered("triangle", fault.triangles) + " at " + coordinates(mesh_, fault),
              fault.count);
  }

  const TriangleMesh& mesh_;
  MeshReport report_;
  bool contradicting_ = false;  ///< some shells face outward and others inward
};

}  // namespace

MeshReport inspect_mesh(const TriangleMesh& mesh) { return Inspection(mesh).run(); }

Result<MeshReport> check_mesh(const TriangleMesh& mesh) try {
  return inspect_mesh(mesh);
} catch (const std::bad_alloc&) {
  return failure(ErrorKind::io, "check stopped: not enough memory");
} catch (const std::exception& e) {
  return failure(ErrorKind::io, std::string("check failed: ") + e.what());
}

}  // namespace clay::solid::inline proof
