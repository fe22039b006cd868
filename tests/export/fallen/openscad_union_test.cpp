// An independent program: OpenSCAD unites the same two parts by Nef polyhedra.

#include "claystack/export/fallen.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/solid.hpp"
#include "tests/export/fallen/collapsed_pots.hpp"
#include "tests/export/fallen/peer_program.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

namespace clay::solid {
namespace {

using samples::output_of;
using samples::ScratchFile;

/// The upper part at its resting place, rotated by quaternions; z up.
TriangleMesh fallen_part(const CollapsedParts& parts, const Collapse& fall, std::size_t segments) {
  TriangleMesh mesh = revolve(parts.upper.profile, segments);
  for (glm::dvec3& p : mesh.points) {
    const glm::dvec3 q = shapes::fallen_point(fall, {p.x, p.z, -p.y});
    p = {q.x, -q.z, q.y};
  }
  return mesh;
}

double volume_by_openscad(const TriangleMesh& lower, const TriangleMesh& upper) {
  const ScratchFile a(".stl", encode_stl_binary(lower)), b(".stl", encode_stl_binary(upper));
  const ScratchFile program(
      ".scad", "union() { import(\"" + a.path() + "\"); import(\"" + b.path() + "\"); }\n");
  const ScratchFile result(".stl");
  const std::string output = output_of("openscad -o " + result.path() + " " + program.path());
  EXPECT_NE(output.find("Simple:        yes"), std::string::npos) << output;
  std::ifstream file(result.path(), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const auto mesh = decode_stl(bytes, "openscad's");
  EXPECT_TRUE(mesh);
  return mesh ? signed_volume(*mesh) : 0.0;
}

TEST(OpenScad, AgreesOnTheUnion) {
  for (const double angle : {0.4, 1.3, 2.2}) {
    const Pot pot =
        shapes::fallen(shapes::stack_of(12, {{20, 0}, {24, 18}, {20, 15}, {16, 11}, {20, 14}}), 1,
                       {21 * std::cos(0.7), 25, 21 * std::sin(0.7)}, angle, 0.7);
    const auto parts = collapsed_parts(pot, Smoothing::none, 0.02);
    ASSERT_TRUE(parts);
    const auto solid = collapsed_solid(*parts, *pot.collapse, 24, 0.02);
    ASSERT_TRUE(solid) << solid.error().message;
    EXPECT_GT(solid->overlap_mm3, 100.0);
    const double theirs = volume_by_openscad(revolve(parts->lower.profile, 24),
                                             fallen_part(*parts, *pot.collapse, 24));
    // OpenSCAD writes six digits.
    EXPECT_NEAR(theirs / solid->union_mm3, 1.0, 1e-5) << angle;
  }
}

}  // namespace
}  // namespace clay::solid
