#include "claystack/export/formats.hpp"
#include "core/cancel.hpp"
#include "tests/export/fallen/peer_program.hpp"
#include "tests/export/solid/mesh_generators.hpp"
#include "tests/fuzz/sample_meshes.hpp"

#include <draco/compression/encode.h>
#include <draco/compression/expert_encode.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace clay::solid {
namespace {

using samples::largest_move;
using samples::tetrahedron;
using samples::torus;

/// An exception in the middle of the work, as Draco may throw one, is no fault of the mesh.
TEST(Drc, ReportsAFailureOfTheLibraryAsIo) {
  const CancelScope::Question odd = []() -> bool { throw std::runtime_error("odd"); };
  const CancelScope scope(&odd);
  const auto bytes = encode_drc(torus(60, 60), {});
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().kind, ErrorKind::io);
  EXPECT_EQ(bytes.error().message, "cannot write .drc: odd");
}

RC_GTEST_PROP(Drc, KeepsTheErrorLimit, ()) {
  TriangleMesh mesh = torus(*rc::gen::inRange(3u, 12u), *rc::gen::inRange(3u, 8u));
  const double scale = std::exp2(*rc::gen::inRange(-8, 9));
  const auto shift = [] { return 1000.0 * *rc::gen::inRange(-100, 101); };
  const glm::dvec3 move =
      *rc::gen::arbitrary<bool>() ? glm::dvec3(shift(), shift(), shift()) : glm::dvec3(0);
  for (glm::dvec3& point : mesh.points) point = point * scale + move;
  const DracoSettings settings{.max_error_mm = scale * std::exp2(-*rc::gen::inRange(0, 18)),
                               .min_bits = *rc::gen::inRange(1, 13),
                               .speed = *rc::gen::inRange(0, 11)};
  const auto bytes = encode_drc(mesh, settings);
  if (!bytes) {
    RC_ASSERT(bytes.error().message.find("more than 30 bits") != std::string::npos);
    RC_DISCARD("float32 is too coarse there");
  }
  const TriangleMesh read = decode_drc(*bytes, "x").value();
  RC_ASSERT(read.triangles.size() == mesh.triangles.size());
  RC_ASSERT(read.points.size() == mesh.points.size());
  RC_ASSERT(largest_move(mesh, read) <= settings.max_error_mm);
  RC_ASSERT(largest_move(read, mesh) <= settings.max_error_mm);
}

/// A soup that is not a solid: Draco may split its vertices, but every triangle keeps its place.
RC_GTEST_PROP(Drc, KeepsEveryTriangleOfASoup, ()) {
  const auto millimetre = rc::gen::map(rc::gen::inRange(-5, 6), [](int x) { return double(x); });
  TriangleMesh mesh = *samples::any_mesh(millimetre);
  const auto spare = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), {{7, 0, 0}, {0, 7, 0}});
  for (auto& [a, b, c] : mesh.triangles) {
    if (a == b || a == c) a = spare;
    if (b == c) b = spare + 1;
  }
  const TriangleMesh read = decode_drc(encode_drc(mesh, {}).value(), "x").value();
  RC_ASSERT(read.triangles.size() == mesh.triangles.size());
  RC_ASSERT(largest_move(mesh, read) <= 0.01);
  RC_ASSERT(largest_move(read, mesh) <= 0.01);
}

TEST(Drc, UsesTheAllowedError) {
  const TriangleMesh mesh = torus(40, 20);
  for (const double error_mm : {0.17, 0.1, 0.071, 0.05, 0.01, 0.007, 0.0055, 0.001}) {
    const std::string bytes = encode_drc(mesh, {.max_error_mm = error_mm}).value();
    // Of 800 vertices, one lies near the corner of its cell.
    EXPECT_GT(largest_move(mesh, decode_drc(bytes, "x").value()), 0.7 * error_mm) << error_mm;
  }
}

TEST(Drc, KeepsPotsSymmetricAboutTheirAxis) {
  const TriangleMesh mesh = torus(40, 20);
  TriangleMesh turned = decode_drc(encode_drc(mesh, {.max_error_mm = 0.1}).value(), "x").value();
  const TriangleMesh read = turned;
  for (glm::dvec3& point : turned.points) point = {-point.x, -point.y, point.z};
  EXPECT_LT(largest_move(read, turned), 1e-4);
}

TEST(Drc, UsesEdgebreakerAtEverySpeed) {
  for (int speed = 0; speed <= 10; ++speed) {
    EXPECT_EQ(encode_drc(tetrahedron(), {.speed = speed}).value()[8],
              draco::MESH_EDGEBREAKER_ENCODING);
  }
}

TEST(Drc, UsesAtLeastTheRequestedBits) {
  const TriangleMesh mesh = torus(12, 8);
  for (const int bits : {1, 4, 10, 20, 24, 30}) {
    const std::string bytes = encode_drc(mesh, {.max_error_mm = 1e3, .min_bits = bits}).value();
    const double half_step_mm = 0.5 * 110.0 / (std::exp2(bits) - 1.0);
    const double float32_mm = 110.0 * 0x1p-20;
    EXPECT_LE(largest_move(mesh, decode_drc(bytes, "x").value()),
              std::sqrt(3.0) * half_step_mm + float32_mm)
        << bits;
  }
}

TEST(Drc, IsDeterministic) {
  EXPECT_EQ(encode_drc(torus(30, 20), {}).value(), encode_drc(torus(30, 20), {}).value());
}

TEST(Drc, EncodesMeshesWithoutExtent) {
  const TriangleMesh dot{{{7, 7, 7}, {7, 7, 7}, {7, 7, 7}}, {{0, 1, 2}}};
  const TriangleMesh read = decode_drc(encode_drc(dot, {}).value(), "x").value();
  EXPECT_EQ(read.points, dot.points);
  EXPECT_EQ(read.triangles.size(), 1u);
}

TEST(Drc, KeepsTheErrorLimitFarFromTheOrigin) {
  TriangleMesh mesh = tetrahedron();
  for (glm::dvec3& point : mesh.points) point += glm::dvec3(999'980.0, -999'990.0, 0.0);
  const TriangleMesh read =
      decode_drc(encode_drc(mesh, {.max_error_mm = 0.3}).value(), "x").value();
  EXPECT_LE(largest_move(mesh, read), 0.3);
}

TEST(Drc, RefusesUnreachableErrorLimits) {
  const auto message = [](const DracoSettings& settings) {
    return encode_drc(tetrahedron(), settings).error().message;
  };
  EXPECT_EQ(message({.max_error_mm = 1e-9})
                .rfind("cannot write .drc: a vertex error of 1e-09 mm needs more than 30 bits; "
                       "the smallest possible is 1.",
                       0),
            0u)
      << message({.max_error_mm = 1e-9});
  const std::string settings =
      "cannot write .drc: expected an error above 0 mm, 1 to 30 bits, speed 0 to 10";
  for (const DracoSettings& bad : {DracoSettings{.max_error_mm = 0.0},
                                   {.max_error_mm = -1.0},
                                   {.max_error_mm = std::nan("")},
                                   {.min_bits = 0},
                                   {.min_bits = 31},
                                   {.speed = -1},
                                   {.speed = 11}}) {
    EXPECT_EQ(message(bad), settings);
  }
}

TEST(Drc, RefusesMeshesThatDracoWouldDamage) {
  const auto message = [](const TriangleMesh& mesh) {
    return encode_drc(mesh, {}).error().message;
  };
  TriangleMesh mesh = tetrahedron();
  mesh.triangles.push_back({1, 1, 2});
  mesh.triangles.push_back({3, 0, 3});
  EXPECT_EQ(message(mesh), "cannot write .drc: 2 triangles use a vertex twice");
  mesh.triangles = {{0, 1, 2}, {0, 1, 4}};
  EXPECT_EQ(message(mesh), "cannot write .drc: triangle 2 names point 4 of 4");
  mesh.triangles = {};
  EXPECT_EQ(message(mesh), "cannot write .drc: the mesh has no triangles");
  EXPECT_EQ(message({}), "cannot write .drc: the mesh has no triangles");
  mesh = tetrahedron();
  mesh.points[3].y = std::nan("");
  EXPECT_EQ(message(mesh), "cannot write .drc: expected a coordinate within +-1e6 mm, found nan");
  mesh.points[3].y = 1e60;
  EXPECT_EQ(message(mesh), "cannot write .drc: expected a coordinate within +-1e6 mm, found inf");
}

TEST(Drc, DracosOwnDecoderAgrees) {
  const TriangleMesh mesh = torus(20, 10);
  const samples::ScratchFile packed(".drc", encode_drc(mesh, {}).value());
  const samples::ScratchFile unpacked(".obj");
  samples::output_of("draco_decoder -i " + packed.path() + " -o " + unpacked.path());
  std::ostringstream text;
  text << std::ifstream(unpacked.path()).rdbuf();
  const TriangleMesh read = decode_obj(text.str(), "draco_decoder").value();
  EXPECT_EQ(read.triangles.size(), mesh.triangles.size());
  EXPECT_LE(largest_move(mesh, read), 0.01 + 1e-6);  // the program prints six decimals
}

}  // namespace
}  // namespace clay::solid
