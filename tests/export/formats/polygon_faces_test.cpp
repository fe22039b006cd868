// Faces of more than three corners: prisms whose volume is the area of their section times their
// height.

#include "claystack/export/formats.hpp"
#include "claystack/export/proof.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clay::solid {
namespace {

struct Corner {
  double x = 0.0, y = 0.0;
};
using Section = std::vector<Corner>;

double area_of(const Section& section) {
  double twice = 0.0;
  for (std::size_t i = 0; i < section.size(); ++i) {
    const Corner &a = section[i], &b = section[(i + 1) % section.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return 0.5 * twice;
}

struct PolygonMesh {
  std::vector<glm::dvec3> points;
  std::vector<std::vector<std::size_t>> faces;
};

constexpr double kHeight = 5.0;

/// A bottom, a top, and a side for each edge. Counterclockwise sections give outward faces.
PolygonMesh prism(const Section& section, std::size_t first_corner = 0) {
  PolygonMesh mesh;
  const std::size_t n = section.size();
  for (const double z : {0.0, kHeight})
    for (const Corner& c : section) mesh.points.emplace_back(c.x, c.y, z);
  std::vector<std::size_t> top;
  for (std::size_t i = 0; i < n; ++i) top.push_back(n + (i + first_corner) % n);
  std::vector<std::size_t> bottom;
  for (std::size_t i = n; i-- > 0;) bottom.push_back((i + first_corner) % n);
  mesh.faces = {bottom, top};
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    mesh.faces.push_back({i, next, n + next, n + i});
  }
  return mesh;
}

std::string number(double value) { return std::to_string(static_cast<float>(value)); }

std::string points_text(const PolygonMesh& mesh, const std::string& keyword) {
  std::string text;
  for (const auto& p : mesh.points)
    text += keyword + number(p.x) + ' ' + number(p.y) + ' ' + number(p.z) + '\n';
  return text;
}

std::string obj_of(const PolygonMesh& mesh) {
  std::string faces;  // before the points, as the format permits
  for (const auto& face : mesh.faces) {
    faces += 'f';
    for (const std::size_t i : face) faces += ' ' + std::to_string(i + 1);
    faces += '\n';
  }
  return faces + points_text(mesh, "v ");
}

std::string counted_faces(const PolygonMesh& mesh) {
  std::string text;
  for (const auto& face : mesh.faces) {
    text += std::to_string(face.size());
    for (const std::size_t i : face) text += ' ' + std::to_string(i);
    text += '\n';
  }
  return text;
}

std::string off_of(const PolygonMesh& mesh) {
  return "OFF\n" + std::to_string(mesh.points.size()) + ' ' + std::to_string(mesh.faces.size()) +
         " 0\n" + points_text(mesh, "") + counted_faces(mesh);
}

std::string ply_of(const PolygonMesh& mesh) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(mesh.points.size()) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
         std::to_string(mesh.faces.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n" + points_text(mesh, "") +
         counted_faces(mesh);
}

struct Read {
  TriangleMesh mesh;
  std::vector<std::string> notes;
};

/// Requires that the three formats agree.
Read read(const PolygonMesh& mesh) {
  Read obj, off, ply;
  obj.mesh = decode_obj(obj_of(mesh), "a.obj", {.notes = &obj.notes}).value();
  off.mesh = decode_off(off_of(mesh), "a.off", {.notes = &off.notes}).value();
  ply.mesh = decode_ply(ply_of(mesh), "a.ply", {.notes = &ply.notes}).value();
  EXPECT_EQ(obj.mesh, off.mesh);
  EXPECT_EQ(obj.mesh, ply.mesh);
  EXPECT_EQ(off.notes, ply.notes);
  return off;
}

void expect_solid(const PolygonMesh& polygons, double volume_mm3) {
  const Read found = read(polygons);
  const MeshReport report = check_mesh(found.mesh).value();
  EXPECT_TRUE(report.sound()) << report.problems.front().what << ' '
                              << report.problems.front().where;
  EXPECT_NEAR(report.volume_mm3, volume_mm3, 1e-5 * volume_mm3);
  EXPECT_TRUE(found.notes.empty()) << found.notes.front();
}

/// In each direction of space, beginning at each corner.
void expect_prisms(const Section& section) {
  for (std::size_t first = 0; first < section.size(); ++first)
    for (int turn = 0; turn < 3; ++turn) {
      PolygonMesh mesh = prism(section, first);
      for (glm::dvec3& p : mesh.points)
        for (int k = 0; k < turn; ++k) p = {p.y, p.z, p.x};
      expect_solid(mesh, area_of(section) * kHeight);
    }
}

TEST(PolygonFaces, SplitsConcaveFaces) {
  expect_prisms({{0, 0}, {10, 0}, {10, 10}, {5, 3}, {0, 10}});           // a notch
  expect_prisms({{10, 0}, {10, 3}, {3, 3}, {3, 10}, {0, 10}, {0, 0}});   // an L
  expect_prisms({{0, 0}, {4, 0}, {1, 1}, {0, 4}});                       // of four corners
  expect_prisms({{0, 0}, {5, 0}, {10, 0}, {10, 5}, {10, 10}, {0, 10}});  // straight corners
  expect_prisms({{0, 0},
                 {9, 0},
                 {9, 9},
                 {1, 9},
                 {1, 2},
                 {7, 2},
                 {7, 7},
                 {3, 7},  // a spiral
                 {3, 4},
                 {5, 4},
                 {5, 6},
                 {6, 6},
                 {6, 3},
                 {2, 3},
                 {2, 8},
                 {8, 8},
                 {8, 1},
                 {0, 1}});
}

RC_GTEST_PROP(PolygonFaces, SplitsAnyStar, ()) {
  const auto corners = *rc::gen::inRange<std::size_t>(5, 40);
  Section section;
  for (std::size_t i = 0; i < corners; ++i) {
    const double radius = *rc::gen::inRange(10, 200);
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
    section.push_back({std::round(radius * std::cos(angle) * 64.0) / 64.0,
                       std::round(radius * std::sin(angle) * 64.0) / 64.0});
  }
  const auto first = *rc::gen::inRange<std::size_t>(0, corners);
  expect_solid(prism(section, first), area_of(section) * kHeight);
}

TEST(PolygonFaces, SplitsAFaceWithAHoleThatIsReachedByAnEdgeThereAndBack) {
  // Squares of 10 and 4 mm: 84 mm2 between them.
  const Section outer{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, inner{{3, 3}, {3, 7}, {7, 7}, {7, 3}};
  PolygonMesh mesh;
  for (const double z : {0.0, kHeight})
    for (const Section& ring : {outer, inner})
      for (const Corner& c : ring) mesh.points.emplace_back(c.x, c.y, z);
  mesh.faces = {{8, 9, 10, 11, 8, 12, 13, 14, 15, 12}, {0, 4, 7, 6, 5, 4, 0, 3, 2, 1}};
  for (const std::size_t begin : {0u, 4u})
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t a = begin + i, b = begin + (i + 1) % 4;
      mesh.faces.push_back({a, b, b + 8, a + 8});
    }
  expect_solid(mesh, 84.0 * kHeight);
}

TEST(PolygonFaces, KeepsTheFanOfAFaceThatCrossesItselfWithANote) {
  const Read found =
      read({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 3, 0}}, {{0, 1, 2, 3}, {4, 3, 1}}});
  EXPECT_EQ(found.mesh.triangles,
            (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {4, 3, 1}}));
  EXPECT_EQ(found.notes, (std::vector<std::string>{
                             "1 face of more than 3 corners crosses or touches itself, the "
                             "first at (0, 0, 0) mm: split as a fan from its first "
                             "corner"}));
  // A corner on another edge, and one that is there twice.
  EXPECT_EQ(read({{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}}, {{0, 1, 2, 3, 4}}})
                .notes.size(),
            1u);
  EXPECT_EQ(read({{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}}, {{0, 1, 1, 2}}}).notes.size(), 1u);
  EXPECT_EQ(read({{{0, 0, 0}, {4, 0, 0}, {8, 0, 0}, {2, 0, 0}}, {{0, 1, 2, 3}}}).notes.size(), 1u);
}

TEST(PolygonFaces, NotesFacesThatAreNotFlat) {
  // A corner 1/25 of the side above the plane of the others, and one 1/200: half as far from the
  // mean plane, up and down together.
  const Read found = read({{{0, 0, 0},
                            {10, 0, 0},
                            {10, 10, 0.4},
                            {0, 10, 0},
                            {20, 0, 0},
                            {30, 0, 0},
                            {30, 10, 0.05},
                            {20, 10, 0}},
                           {{4, 5, 6, 7}, {0, 1, 2, 3}}});
  EXPECT_EQ(found.mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{
                                      {4, 5, 6}, {4, 6, 7}, {0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(found.notes,
            (std::vector<std::string>{"1 face of more than 3 corners is not flat, the first at (0, "
                                      "0, 0) mm: other programs may split it differently"}));
}

}  // namespace
}  // namespace clay::solid
