#include "claystack/export/proof.hpp"
#include "claystack/export/repair.hpp"
#include "export/formats/file_floats.hpp"
#include "export/solid/surface_distance.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <string>

namespace clay::solid {
namespace {

/// Random faults in sound meshes. CLAYSTACK_PLANTED_FAULTS sets their number.
class FaultPlanter {
 public:
  explicit FaultPlanter(std::uint32_t seed) : random_(seed) {}

  struct Planted {
    std::string kind;
    TriangleMesh mesh;
    double moved_mm = 0.0;     ///< displacement of the surface by the fault
    bool adds_a_body = false;  ///< the result is the union of two bodies
  };

  TriangleMesh sound_mesh() {
    switch (below(3)) {
      case 0:
        return float32(shapes::ball(10.0 + number(20)));
      case 1:
        return float32(revolve(
            {{{{8, 0}, {20, 0}, {26, 12}, {24, 30}, {21, 30}, {22, 12}, {8, 4}}}}, 8 + below(24)));
      default:
        return float32(shapes::moved(shapes::cube(5.0 + number(30)), {number(50), -7.0, 3.0}));
    }
  }

  Planted plant(const TriangleMesh& sound) {
    Planted planted{"", sound};
    switch (below(7)) {
      case 0:
        return hole(std::move(planted));
      case 1:
        return flip(std::move(planted));
      case 2:
        return duplicate(std::move(planted));
      case 3:
        return jitter(std::move(planted));
      case 4:
        return overlap(std::move(planted));
      case 5:
        return t_junction(std::move(planted));
      default:
        return shared_edge(std::move(planted));
    }
  }

 private:
  static TriangleMesh float32(TriangleMesh mesh) {
    round_to_file(mesh.points);
    return mesh;
  }
  std::size_t below(std::size_t n) { return random_() % n; }
  double number(std::size_t n) { return static_cast<double>(below(n)); }
  double unit() { return static_cast<double>(random_()) / 4294967295.0; }
  std::size_t any(const TriangleMesh& mesh) { return below(mesh.triangles.size()); }

  Planted hole(Planted p) {
    p.kind = "hole";
    const std::size_t first = any(p.mesh);
    const auto& [a, b, c] = p.mesh.triangles[first];
    // The hole may have to be filled across the whole triangle.
    p.moved_mm = std::max({glm::distance(p.mesh.points[a], p.mesh.points[b]),
                           glm::distance(p.mesh.points[b], p.mesh.points[c]),
                           glm::distance(p.mesh.points[c], p.mesh.points[a])});
    p.mesh.triangles.erase(p.mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first));
    return p;
  }
  Planted flip(Planted p) {
    p.kind = "flip";
    for (std::size_t i = 0; i <= below(3); ++i) {
      auto& t = p.mesh.triangles[any(p.mesh)];
      std::swap(t[0], t[1]);
    }
    return p;
  }
  Planted duplicate(Planted p) {
    p.kind = "duplicate";
    auto t = p.mesh.triangles[any(p.mesh)];
    std::rotate(t.begin(), t.begin() + 1, t.end());
    p.mesh.triangles.push_back(t);
    return p;
  }
  Planted jitter(Planted p) {
    p.kind = "jitter";
    p.moved_mm = 0.002;
    TriangleMesh soup;
    for (const auto& t : p.mesh.triangles) {
      const auto first = static_cast<std::uint32_t>(soup.points.size());
      for (const std::uint32_t v : t)
        soup.points.push_back(p.mesh.points[v] +
                              0.001 * (glm::dvec3(unit(), unit(), unit()) - 0.5));
      soup.triangles.push_back({first, first + 1, first + 2});
    }
    p.mesh = std::move(soup);
    return p;
  }
  Planted overlap(Planted p) {
    p.kind = "overlap";
    p.adds_a_body = true;
    const TriangleMesh body =
        shapes::moved(shapes::cube(3.0 + 10.0 * unit()),
                      p.mesh.points[below(p.mesh.points.size())] - glm::dvec3(unit(), 1.0, unit()));
    p.mesh = shapes::together(p.mesh, float32(body));
    return p;
  }
  Planted t_junction(Planted p) {
    p.kind = "T-junction";
    p.moved_mm = 0.001 * std::sqrt(3.0);  // 0.001 along each axis
    auto& t = p.mesh.triangles[any(p.mesh)];
    const auto [a, b, c] = t;
    const auto middle = static_cast<std::uint32_t>(p.mesh.points.size());
    p.mesh.points.push_back(
        glm::dvec3(glm::vec3(0.5 * (p.mesh.points[a] + p.mesh.points[b]) + 0.001 * unit())));
    t = {a, middle, c};
    p.mesh.triangles.push_back({middle, b, c});
    return p;
  }
  /// A tetrahedron outside of a cube-like corner shares an edge with the mesh.
  Planted shared_edge(Planted p) {
    p.kind = "shared edge";
    p.adds_a_body = true;
    const auto& [a, b, c] = p.mesh.triangles[any(p.mesh)];
    const glm::dvec3 from = p.mesh.points[a], to = p.mesh.points[b];
    const glm::dvec3 normal = glm::normalize(glm::cross(to - from, p.mesh.points[c] - from));
    const glm::dvec3 side = glm::normalize(glm::cross(to - from, normal));
    TriangleMesh wedge{{from, to, from + 3.0 * normal + side, from + 3.0 * normal - side},
                       {{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {1, 3, 2}}};
    if (signed_volume(wedge) < 0.0) wedge = shapes::inverted(wedge);
    p.mesh = shapes::together(p.mesh, float32(wedge));
    return p;
  }

  std::mt19937 random_;
};

std::size_t planted_count() {
  const char* const text = std::getenv("CLAYSTACK_PLANTED_FAULTS");
  return text == nullptr ? 40 : static_cast<std::size_t>(std::strtoul(text, nullptr, 10));
}

TEST(PlantedFaults, AreRepairedWithinTheStatedDistance) {
  FaultPlanter planter(20260101);
  std::map<std::string, std::pair<std::size_t, std::size_t>> sound_of;  // of each kind
  std::size_t planted = 0, sound = 0;
  for (std::size_t i = 0; i < planted_count(); ++i) {
    const TriangleMesh original = planter.sound_mesh();
    ASSERT_TRUE(check_mesh(original).value().sound());
    const FaultPlanter::Planted fault = planter.plant(original);
    const auto result = repair_mesh(fault.mesh);
    ++planted;
    ++sound_of[fault.kind].second;
    if (!result) {
      std::printf("  %zu %s: %s\n", i, fault.kind.c_str(), result.error().message.c_str());
      continue;
    }
    ASSERT_TRUE(check_mesh(result->mesh).value().sound()) << i << " " << fault.kind;
    ++sound;
    ++sound_of[fault.kind].first;
    // The bounds hold at every vertex, measured apart from the code that states them.
    EXPECT_LE(surface_distance(fault.mesh, result->mesh),
              std::max(result->change.added_mm, result->change.removed_mm) + 1e-6)
        << i << " " << fault.kind;
    if (fault.adds_a_body) {
      EXPECT_GE(signed_volume(result->mesh), 0.999 * signed_volume(original))
          << i << " " << fault.kind;
      continue;
    }
    EXPECT_LE(surface_distance(original, result->mesh), fault.moved_mm + 1e-5)
        << i << " " << fault.kind;
  }
  for (const auto& [kind, of] : sound_of)
    std::printf("  %-12s %zu of %zu sound\n", kind.c_str(), of.first, of.second);
  EXPECT_GE(100 * sound, 99 * planted);
}

}  // namespace
}  // namespace clay::solid
