#include "app/cli/pot_input.hpp"

#include <gtest/gtest.h>

namespace clay::cli {
namespace {

/// A box of this width and height [mm], somewhere on a plate.
solid::TriangleMesh box(double width, double height) {
  return {{{100, 50, 0}, {100 + width, 50 + 0.9 * width, height}, {100, 50, height}}, {{0, 1, 2}}};
}

TEST(MeshDiffers, FromThePotInAnotherSizeOrShape) {
  Pot pot;
  pot.stack = ClayStack::cylinder(50, 1.0, 40.0, 30.0, 50).value();  // 80 mm wide, 50 mm high
  EXPECT_FALSE(mesh_differs(box(80, 50), pot));
  EXPECT_FALSE(mesh_differs(box(79.5, 50), pot)) << "facets";
  EXPECT_FALSE(mesh_differs(box(80 / 0.88, 50 / 0.88), pot)) << "enlarged for a shrinkage";
  EXPECT_FALSE(mesh_differs(box(100, 62.5), pot)) << "a shrinkage of 20 %";
  EXPECT_TRUE(mesh_differs(box(40, 25), pot)) << "scaled";
  EXPECT_TRUE(mesh_differs(box(80, 45), pot)) << "cut";
  EXPECT_TRUE(mesh_differs(box(180, 50), pot)) << "two pots on a plate";
  EXPECT_EQ(
      mesh_differs(box(40, 25), pot),
      "the mesh is 40.0 mm wide and 25.0 mm high, the pot inside 80.0 mm and 50.0 mm: another "
      "program changed the mesh");
  EXPECT_EQ(
      mesh_differs(box(144, 90), pot),
      "the mesh is 144.0 mm wide and 90.0 mm high, the pot inside 80.0 mm and 50.0 mm: 1.80 times "
      "the size is more than the shrinkage of a clay needs, so another program may have scaled the "
      "mesh");
  EXPECT_EQ(other_size(box(100, 60), pot),
            "80.0 mm wide and 50.0 mm high; the mesh is 100.0 mm wide and 60.0 mm high, 1.25 "
            "and 1.20 times as much");
  EXPECT_EQ(other_size(box(80.1, 49.9), pot), std::nullopt);
}

}  // namespace
}  // namespace clay::cli
