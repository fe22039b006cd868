#include "export/solid/mesh_geometry.hpp"

#include "core/parallel_parts.hpp"
#include "export/solid/ray_upward.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace clay::solid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr std::uint32_t kNoShell = UINT32_MAX;

struct NestedShell {
  std::uint32_t triangle = 0;  ///< the first of it
  std::uint32_t top = 0;       ///< the first vertex of the largest z
  bool outward = false;
  std::uint32_t around = kNoShell;  ///< the shell that it lies in
  bool inner = false;               ///< it lies in an odd number of shells
  bool misplaced = false;
};

/// Whether a shell is oriented outward, from the triangles at its top, each rotated to begin there.
/// No part of the shell lies above the flattest edge at the top, so the upper of its two triangles
/// faces out.
class TopFan {
 public:
  TopFan(const TriangleMesh& mesh, std::span<const Triangle> fan) : mesh_(mesh), fan_(fan) {}

  [[nodiscard]] bool outward() const {
    const Triangle& left =
        *std::min_element(fan_.begin(), fan_.end(), [&](const Triangle& a, const Triangle& b) {
          return Kernel().compare_slope_3_object()(point(a[2]), point(a[0]), point(b[2]),
                                                   point(b[0])) == CGAL::SMALLER;
        });
    const Triangle& right =
        *std::find_if(fan_.begin(), fan_.end(), [&](const Triangle& t) { return t[1] == left[2]; });
    const CGAL::Sign seen_left = from_above(left), seen_right = from_above(right);
    if (seen_left == CGAL::ZERO) return seen_right == CGAL::POSITIVE;
    if (seen_right == CGAL::ZERO || seen_left == seen_right) return seen_left == CGAL::POSITIVE;
    // One above the other: the lower one is behind the upper one if that faces up.
    const Triangle& up = seen_left == CGAL::POSITIVE ? left : right;
    const Triangle& down = seen_left == CGAL::POSITIVE ? right : left;
    const std::uint32_t apex = down[1] == up[2] ? down[2] : down[1];
    return CGAL::orientation(point(up[0]), point(up[1]), point(up[2]), point(apex)) ==
           CGAL::NEGATIVE;
  }

 private:
  [[nodiscard]] Kernel::Point_3 point(std::uint32_t v) const {
    const glm::dvec3& p = mesh_.points[v];
    return {p.x, p.y, p.z};
  }
  [[nodiscard]] Kernel::Point_2 shadow(std::uint32_t v) const {
    return {mesh_.points[v].x, mesh_.points[v].y};
  }
  [[nodiscard]] CGAL::Sign from_above(const Triangle& t) const {
    return CGAL::orientation(shadow(t[0]), shadow(t[1]), shadow(t[2]));
  }

  const TriangleMesh& mesh_;
  std::span<const Triangle> fan_;
};

class Nest {
 public:
  Nest(const TriangleMesh& mesh, const MeshTopology& topology)
      : mesh_(mesh), shell_of_(mesh.triangles.size(), 0) {
    find_shells(topology.component_of);
    find_tops();
    orient();
  }

  ShellGeometry run() {
    if (shells_.size() > 1) {
      shoot();
      settle();
    }
    ShellGeometry geometry;
    geometry.steps = steps_;
    geometry.outward = shells_[highest_].outward;
    geometry.only_filled = geometry.outward;
    for (const NestedShell& shell : shells_) {
      if (shell.misplaced && !(shell.outward && shell.around != kNoShell))
        geometry.only_filled = false;
      if (shell.misplaced) note(geometry.misplaced_shells, {shell.triangle}, {});
      if (shell.around != kNoShell) geometry.enclosed.push_back(shell.triangle);
    }
    geometry.bounds_volume = !geometry.misplaced_shells.found();
    return geometry;
  }

 private:
  void find_shells(std::span<const std::uint32_t> component_of) {
    if (component_of.empty()) {
      shells_.emplace_back();
      return;
    }
    for (std::uint32_t t = 0; t < component_of.size(); ++t) {
      if (component_of[t] == t) {
        shell_of_[t] = static_cast<std::uint32_t>(shells_.size());
        shells_.emplace_back().triangle = t;
      } else {
        shell_of_[t] = shell_of_[component_of[t]];
      }
    }
  }

  void find_tops() {
    for (NestedShell& shell : shells_) shell.top = mesh_.triangles[shell.triangle][0];
    std::uint32_t highest = shells_.front().top;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh_.triangles[t]) {
        if (height(v) > height(shells_[shell_of_[t]].top)) shells_[shell_of_[t]].top = v;
        if (!(height(v) > height(highest))) continue;
        highest = v;
        highest_ = shell_of_[t];
      }
    }
  }

  void orient() {
    std::vector<std::size_t> begins(shells_.size() + 1, 0);
    const auto for_each_at_top = [&](const auto& visit) {
      for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
        Triangle turned = mesh_.triangles[t];
        const auto top = std::find(turned.begin(), turned.end(), shells_[shell_of_[t]].top);
        if (top == turned.end()) continue;
        std::rotate(turned.begin(), top, turned.end());
        visit(shell_of_[t], turned);
      }
    };
    for_each_at_top([&](std::uint32_t shell, const Triangle&) { ++begins[shell + 1]; });
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<Triangle> fans(begins.back());
    std::vector<std::size_t> next(begins.begin(), begins.end() - 1);
    for_each_at_top(
        [&](std::uint32_t shell, const Triangle& turned) { fans[next[shell]++] = turned; });
    for (std::size_t s = 0; s < shells_.size(); ++s)
      shells_[s].outward =
          TopFan(mesh_, std::span(fans).subspan(begins[s], begins[s + 1] - begins[s])).outward();
  }

  void shoot() {
    constexpr std::size_t kPartShells = 256;
    const BoxTree tree(mesh_);
    hits_.resize(shells_.size());
    std::vector<std::size_t> steps((shells_.size() + kPartShells - 1) / kPartShells);
    for_each_part(steps.size(), [&](std::size_t part) {
      const std::size_t end = std::min(shells_.size(), (part + 1) * kPartShells);
      for (std::size_t s = part * kPartShells; s < end; ++s) {
        RayUpward ray(mesh_, shells_[s].top);
        hits_[s] = ray.first_hit(tree, [&](std::uint32_t t) { return shell_of_[t] == s; });
        steps[part] += ray.steps();
      }
    });
    steps_ = std::accumulate(steps.begin(), steps.end(), std::size_t{0});
  }

  /// From the highest shell down: everything above a shell's top is decided before.
  void settle() {
    std::vector<std::uint32_t> order(shells_.size());
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return height(shells_[a].top) > height(shells_[b].top);
    });
    std::optional<bool> outermost;  // orientation of the outermost shells
    bool alike = true;
    for (const std::uint32_t s : order) {
      NestedShell& shell = shells_[s];
      if (const auto& hit = hits_[s]) {
        const NestedShell& other = shells_[shell_of_[hit->triangle]];
        const bool within = hit->from_back == other.outward;
        shell.around = within ? shell_of_[hit->triangle] : other.around;
      }
      if (shell.around == kNoShell) {
        alike = alike && shell.outward == outermost.value_or(shell.outward);
        outermost = shell.outward;
        continue;
      }
      const NestedShell& around = shells_[shell.around];
      shell.inner = !around.inner;
      shell.misplaced = around.misplaced || shell.outward != (*outermost != shell.inner);
    }
    // If the outermost shells contradict each other, the fault cannot be assigned to one.
    if (!alike)
      for (NestedShell& shell : shells_) shell.misplaced = true;
  }

  [[nodiscard]] double height(std::uint32_t v) const { return mesh_.points[v].z; }

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> shell_of_;  ///< by triangle
  std::vector<NestedShell> shells_;      ///< in the order of their first triangles
  std::uint32_t highest_ = 0;            ///< shell
  std::vector<std::optional<RayUpward::Hit>> hits_;
  std::size_t steps_ = 0;
};

}  // namespace

ShellGeometry shell_geometry(const TriangleMesh& mesh, const MeshTopology& topology) {
  return Nest(mesh, topology).run();
}

}  // namespace clay::solid
