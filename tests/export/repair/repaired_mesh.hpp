#pragma once
// A mesh after its repair, and the bounds of its change by rounding to float32.

#include "claystack/export/proof.hpp"
#include "claystack/export/repair.hpp"
#include "tests/export/repair/repair_counts.hpp"
#include "tests/export/solid/mesh_surface.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace clay::solid {

/// The repairs and the remaining faults, for messages.
inline std::string names(const RepairedMesh& result) {
  std::string all;
  for (const Repair& repair : result.repaired)
    all += repair.what + " (" + std::to_string(repair.count) + "); ";
  const MeshReport report = check_mesh(result.mesh).value();
  for (const MeshProblem& p : report.problems) all += "REMAINS " + p.what + " " + p.where + "; ";
  return all;
}

/// The largest size of a coordinate [mm].
inline double reach_of(const TriangleMesh& mesh) {
  double reach = 0.0;
  for (const glm::dvec3& p : mesh.points)
    reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return reach;
}

/// The maximum displacement of a point by float32 [mm]: half a unit of the last place along each
/// axis.
inline double rounding_mm(const TriangleMesh& mesh) {
  return std::sqrt(3.0) * 0x1p-24 * reach_of(mesh);
}

/// Upper bound of the change of volume if every point moves by the rounding (or by `units` of the
/// last place); 1 % more for the area that this adds, and the summation in double.
inline double rounding_mm3(const TriangleMesh& mesh, double units = 0.5) {
  return 1.01 * 2.0 * units * rounding_mm(mesh) * shapes::surface_mm2(mesh) +
         1e-15 * reach_of(mesh) * shapes::surface_mm2(mesh);
}

/// The mesh is sound again with that volume, and only these repairs were made.
inline void expect_repaired(const TriangleMesh& broken, double volume_mm3,
                            const std::vector<Repair>& as) {
  ASSERT_FALSE(check_mesh(broken).value().sound());
  const auto result = repair_mesh(broken);
  ASSERT_TRUE(result) << result.error().message;
  const MeshReport report = check_mesh(result->mesh).value();
  EXPECT_TRUE(report.sound()) << names(*result);
  // Touching parts are pulled apart by 64 units of the last place, rounded once more.
  const double units = times(*result, "vertex pulled apart where surfaces touch") > 0 ? 64.5 : 0.5;
  EXPECT_NEAR(report.volume_mm3, volume_mm3, rounding_mm3(result->mesh, units)) << names(*result);
  EXPECT_EQ(result->repaired.size(), as.size()) << names(*result);
  for (const Repair& expected : as)
    EXPECT_EQ(times(*result, expected.what), expected.count)
        << expected.what << ": " << names(*result);
}

}  // namespace clay::solid
