#include "export/formats/draco_mesh.hpp"

#include "tests/fuzz/sample_meshes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clay::solid {
namespace {

using draco::AttributeValueIndex;
using draco::FaceIndex;
using draco::PointIndex;

/// A Draco tetrahedron, damaged in ways that no Draco encoder produces.
class DracoMesh : public testing::Test {
 protected:
  [[nodiscard]] std::string message() const {
    const auto read = from_draco(*mesh_, "pot.drc");
    return read ? "no error" : read.error().message;
  }
  [[nodiscard]] draco::PointAttribute& positions() { return *mesh_->attribute(0); }

  const TriangleMesh tetrahedron_ = samples::tetrahedron();
  std::unique_ptr<draco::Mesh> mesh_ =
      to_draco(tetrahedron_, {tetrahedron_.points.begin(), tetrahedron_.points.end()});
};

TEST_F(DracoMesh, RoundTrips) { EXPECT_EQ(from_draco(*mesh_, "x").value(), tetrahedron_); }

TEST_F(DracoMesh, SharesPointsOfEqualPosition) {
  // Points 0 to 5 on positions 0 to 3: faces may name twins.
  mesh_->set_num_points(6);
  positions().SetExplicitMapping(6);
  for (std::uint32_t i = 0; i < 6; ++i) {
    positions().SetPointMapEntry(PointIndex(i), AttributeValueIndex(i % 4));
  }
  mesh_->SetFace(FaceIndex(0), {PointIndex(4), PointIndex(2), PointIndex(5)});
  EXPECT_EQ(from_draco(*mesh_, "x").value(), tetrahedron_);
}

TEST_F(DracoMesh, ReadsNegativeZeroAsZero) {
  const float corner[3] = {-0.0F, -0.0F, -0.0F};
  positions().SetAttributeValue(AttributeValueIndex(0), corner);
  EXPECT_FALSE(std::signbit(from_draco(*mesh_, "x").value().points[0].x));
}

TEST_F(DracoMesh, RefusesFacesOfMissingPoints) {
  mesh_->SetFace(FaceIndex(2), {PointIndex(1), PointIndex(4), PointIndex(3)});
  EXPECT_EQ(message(), "pot.drc: face 3: expected the number of a point, from 0 to 3, found 4");
}

TEST_F(DracoMesh, RefusesFacesOutsideThePointMap) {
  positions().SetExplicitMapping(4);
  for (std::uint32_t i = 0; i < 4; ++i) {
    positions().SetPointMapEntry(PointIndex(i), AttributeValueIndex(i));
  }
  mesh_->SetFace(FaceIndex(0), {PointIndex(0), PointIndex(1), PointIndex(1u << 30)});
  EXPECT_EQ(message(),
            "pot.drc: face 1: expected the number of a point, from 0 to 3, found 1073741824");
}

TEST_F(DracoMesh, RefusesMissingPositions) {
  positions().SetExplicitMapping(4);
  for (std::uint32_t i = 0; i < 4; ++i) {
    positions().SetPointMapEntry(PointIndex(i), AttributeValueIndex(i + 1));
  }
  EXPECT_EQ(message(), "pot.drc: face 2: expected the number of a position, from 0 to 3, found 4");
}

TEST_F(DracoMesh, RefusesTruncatedMapsAndBuffers) {
  positions().SetExplicitMapping(3);
  EXPECT_EQ(message(), "pot.drc: the position attribute is not whole");
  positions().SetIdentityMapping();
  EXPECT_EQ(message(), "no error");
  positions().buffer()->Resize(4 * sizeof(glm::vec3) - 1);
  EXPECT_EQ(message(), "pot.drc: the position attribute is not whole");
}

TEST_F(DracoMesh, RefusesEmptyMeshes) {
  mesh_->SetNumFaces(0);
  EXPECT_EQ(message(), "pot.drc: expected 1 to 20000000 triangles, found 0");
}

}  // namespace
}  // namespace clay::solid
