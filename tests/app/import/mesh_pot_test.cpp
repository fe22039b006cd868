#include "app/import/mesh_pot.hpp"

#include "tests/support/run_program.hpp"

#include "claystack/export/formats.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <random>
#include <tuple>

namespace clay::importing {
namespace {

using solid::TriangleMesh;
using testing::HasSubstr;
constexpr double kToleranceMm = 0.02;  // of an export

/// A sample as the program throws and exports it, to the bytes of its file and back.
struct Exported {
  test::ScratchFolder folder;
  TriangleMesh mesh;
  double volume_mm3 = 0.0;
  std::string stl = folder.file("pot.stl");

  explicit Exported(const std::string& name) {
    const std::string pot = folder.file("pot.pot.cbor");
    EXPECT_EQ(
        test::claystack("throw -q " + test::sample(name + ".scene.json") + " -o " + pot).status, 0);
    EXPECT_EQ(test::claystack("export -q " + pot + " " + stl).status, 0);
    auto read = solid::decode_mesh(test::read_text(stl), solid::MeshFormat::stl_binary, stl);
    EXPECT_TRUE(read) << read.error().message;
    if (read) mesh = std::move(*read);
    volume_mm3 = solid::signed_volume(mesh);
  }
};

/// Turned, scaled and moved, then rounded to float32 as files are.
TriangleMesh placed(TriangleMesh mesh, double tilt, double turn, double scale, glm::dvec3 shift) {
  const double a = std::cos(tilt), b = std::sin(tilt), c = std::cos(turn), d = std::sin(turn);
  const glm::dmat3 lean{a, 0.0, -b, 0.0, 1.0, 0.0, b, 0.0, a},
      spin{c, d, 0.0, -d, c, 0.0, 0.0, 0.0, 1.0};
  for (glm::dvec3& p : mesh.points) p = scale * (spin * lean * p) + shift;
  return solid::rounded_to_float(mesh);
}

/// A box with these corners.
void add_box(TriangleMesh& mesh, glm::dvec3 low, glm::dvec3 high) {
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (int i = 0; i < 8; ++i)
    mesh.points.emplace_back((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                             (i & 4) != 0 ? high.z : low.z);
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : kFaces) {
    mesh.triangles.push_back({first + f[0], first + f[1], first + f[2]});
    mesh.triangles.push_back({first + f[0], first + f[2], first + f[3]});
  }
}

class MeshPots : public testing::TestWithParam<const char*> {};

TEST_P(MeshPots, ExportedSamplesComeBack) {
  const Exported sample(GetParam());
  const auto pot = mesh_pot(sample.mesh, {}, "pot.stl");
  ASSERT_TRUE(pot) << pot.error().message;
  EXPECT_LE(pot->deviation.mm, kToleranceMm + 0.01);
  EXPECT_NEAR(pot->pot.stack.volume_mm3() / sample.volume_mm3, 1.0, 1e-3);
  EXPECT_EQ(pot->noise_mm, 0.0) << "facets are not noise";
  EXPECT_EQ(pot->measured, kMeshCuts);
  EXPECT_TRUE(pot->parts.empty());
  EXPECT_NEAR(glm::length(pot->axis.through), 0.0, 1e-3);
  EXPECT_NEAR(pot->axis.direction.z, 1.0, 1e-9);
}

TEST_P(MeshPots, ComeBackTiltedScaledAndOffTheAxis) {
  const Exported sample(GetParam());
  for (const auto& [tilt, turn, scale] :
       {std::tuple{0.4, 1.1, 0.7}, {0.01, 2.5, 1.3}, {2.9, -0.8, 1.0}, {1.5, 0.3, 1.0}}) {
    const auto pot =
        mesh_pot(placed(sample.mesh, tilt, turn, scale, {120.0, -45.0, 33.0}), {}, "pot.stl");
    ASSERT_TRUE(pot) << pot.error().message;
    EXPECT_LE(pot->deviation.mm, scale * kToleranceMm + 0.01) << tilt;
    EXPECT_NEAR(pot->pot.stack.volume_mm3() / (sample.volume_mm3 * scale * scale * scale), 1.0,
                1e-3)
        << tilt;
    EXPECT_TRUE(pot->parts.empty()) << tilt;
    // The axis of the sample is z through the origin, and it opens upward.
    const glm::dvec3 up{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn),
                        std::cos(tilt)};
    EXPECT_NEAR(glm::dot(pot->axis.direction, up), 1.0, 1e-7) << tilt;
    EXPECT_NEAR(glm::length(pot->axis.through - glm::dvec3(120.0, -45.0, 33.0)), 0.0, 0.01) << tilt;
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, MeshPots, testing::Values("bowl", "vase", "cylinder", "bottle"));

TEST(MeshPot, LeavesAHandleOutAndReportsIt) {
  const Exported sample("cylinder");
  TriangleMesh mug = sample.mesh;
  const double radius = 38.0;
  add_box(mug, {-8.0, radius, 50.0}, {8.0, radius + 30.0, 60.0});
  add_box(mug, {-8.0, radius, 100.0}, {8.0, radius + 30.0, 110.0});
  add_box(mug, {-8.0, radius + 20.0, 60.0}, {8.0, radius + 30.0, 100.0});
  const auto pot = mesh_pot(mug, {}, "mug.stl");
  ASSERT_TRUE(pot) << pot.error().message;
  EXPECT_NEAR(pot->pot.stack.volume_mm3() / sample.volume_mm3, 1.0, 1e-3);
  EXPECT_LE(pot->deviation.mm, kToleranceMm + 0.01);
  ASSERT_EQ(pot->parts.size(), 1u);
  const MeshPart& handle = pot->parts.front();
  EXPECT_NEAR(handle.from_deg, 90.0 - 11.0, 8.0);
  EXPECT_NEAR(handle.to_deg, 90.0 + 11.0, 8.0);
  EXPECT_NEAR(handle.low_mm, 50.0, 1.0);
  EXPECT_NEAR(handle.high_mm, 110.0, 1.0);
  EXPECT_GT(handle.off_mm, 20.0);
}

TEST(MeshPot, RevolvesANoisyScan) {
  const Exported sample("vase");
  TriangleMesh scan = placed(sample.mesh, 0.2, 0.7, 1.0, {30.0, 50.0, -20.0});
  std::mt19937 random(3);
  for (glm::dvec3& p : scan.points)
    for (int i = 0; i < 3; ++i) p[i] += 0.2 * (static_cast<double>(random()) / 4294967296.0 - 0.5);
  const auto pot = mesh_pot(scan, {}, "scan.stl");
  ASSERT_TRUE(pot) << pot.error().message;
  // The noise of 0.1 mm each way moves a point by up to 0.18 mm.
  EXPECT_LE(pot->deviation.mm, 0.4);
  EXPECT_GE(pot->deviation.mm, 0.05);
  EXPECT_NEAR(pot->pot.stack.volume_mm3() / solid::signed_volume(scan), 1.0, 3e-3);
  const glm::dvec3 up{std::sin(0.2) * std::cos(0.7), std::sin(0.2) * std::sin(0.7), std::cos(0.2)};
  EXPECT_NEAR(glm::dot(pot->axis.direction, up), 1.0, 1e-7);
}

/// A cup of radius 40 and height 80 mm with a wall of 3 and a floor of 4 mm: 96 corners around each
/// circle, about 2 mm apart, and normal noise in each coordinate.
TriangleMesh noisy_cup(double noise_mm) {
  std::vector<glm::dvec2> circles;
  for (int r = 2; r < 40; r += 2) circles.emplace_back(r, 0.0);
  for (int z = 0; z < 80; z += 2) circles.emplace_back(40.0, z);
  for (const double r : {40.0, 38.5, 37.0}) circles.emplace_back(r, 80.0);
  for (int z = 78; z > 4; z -= 2) circles.emplace_back(37.0, z);
  circles.emplace_back(37.0, 4.0);
  for (int r = 36; r > 0; r -= 2) circles.emplace_back(r, 4.0);
  constexpr std::uint32_t kAround = 96;
  std::mt19937 random(77);
  std::normal_distribution<double> noise(0.0, noise_mm);
  TriangleMesh mesh;
  for (const glm::dvec2& circle : circles)
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const double azimuth = 2.0 * std::numbers::pi * i / kAround;
      const double x = circle.x * std::cos(azimuth), y = circle.x * std::sin(azimuth);
      mesh.points.emplace_back(x + noise(random), y + noise(random), circle.y + noise(random));
    }
  const auto foot = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.emplace_back(0.0, 0.0, 0.0);
  mesh.points.emplace_back(0.0, 0.0, 4.0);
  const auto last = static_cast<std::uint32_t>(circles.size() - 1) * kAround;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const std::uint32_t k = (i + 1) % kAround;
    mesh.triangles.push_back({foot, k, i});
    mesh.triangles.push_back({foot + 1, last + i, last + k});
    for (std::uint32_t row = 0; row < last; row += kAround) {
      mesh.triangles.push_back({row + i, row + k, row + kAround + k});
      mesh.triangles.push_back({row + i, row + kAround + k, row + kAround + i});
    }
  }
  return mesh;
}

TEST(MeshPot, LevelsFacesOfAScanWithinItsNoise) {
  const auto clean = mesh_pot(noisy_cup(0.0), {}, "cup.stl");
  ASSERT_TRUE(clean) << clean.error().message;
  EXPECT_EQ(clean->noise_mm, 0.0);
  // The foot, the floor and the rim are at 0, 4 and 80 mm: bounds of 120 rings of 80/120 mm.
  EXPECT_EQ(clean->pot.stack.size(), 120u);
  for (const double noise_mm : {0.005, 0.02, 0.05}) {
    const auto pot = mesh_pot(noisy_cup(noise_mm), {}, "scan.stl");
    ASSERT_TRUE(pot) << pot.error().message;
    EXPECT_GT(pot->noise_mm, 0.5 * noise_mm);
    EXPECT_LT(pot->noise_mm, 1.5 * noise_mm);
    // No point of 12,000 is farther than five standard deviations, or the chord's 0.02 mm.
    EXPECT_LE(pot->deviation.mm, 5.0 * noise_mm + 0.03);
    const ClayStack& stack = pot->pot.stack;
    EXPECT_LE(stack.size(), 1000u) << noise_mm;
    EXPECT_NEAR(stack.height_mm(), 80.0, 2.0 * noise_mm + 0.01);
    std::size_t solid = 0;
    while (stack.rings()[solid].inner2 == 0) ++solid;
    EXPECT_NEAR(static_cast<double>(solid) * stack.ring_height_mm(), 4.0, 3.0 * noise_mm + 0.01);
    for (std::size_t i = solid; i < stack.size(); ++i)
      ASSERT_NEAR(stack.rings()[i].outer_mm() - stack.rings()[i].inner_mm(), 3.0, noise_mm + 0.03)
          << i << " of " << noise_mm;
  }
}

TEST(MeshPot, CommandWarnsOfNoise) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("scan.stl"), pot = folder.file("scan.pot.json");
  test::write_text(file, *solid::encode_mesh(noisy_cup(0.02), solid::MeshFormat::stl_binary, {}));
  const auto run = test::claystack("import --json " + file + " -o " + pot);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("warning: " + file +
                                 ": expected points on a surface of "
                                 "revolution, found noise of about 0.01"));
  ASSERT_EQ(run.json().at("warnings").size(), 1u) << run.out;
  EXPECT_NEAR(run.json().at("noise_mm").get<double>(), 0.02, 0.01);
  // A requested ring height does not bring the noise of the floor back.
  const auto asked = test::claystack("import --json --ring-height 1 " + file + " -o " + pot);
  EXPECT_LE(asked.json().at("deviation_mm").get<double>(), 0.13) << asked.out;
  EXPECT_LE(asked.json().at("rings"), 160) << asked.out;
  const std::string stl = folder.file("again.stl");
  const auto exported = test::claystack("export " + pot + " " + stl + " --min-wall 2.8");
  EXPECT_EQ(exported.status, 0) << exported.out << exported.err;
  EXPECT_EQ(test::claystack("check -q " + stl).status, 0);
}

/// A wall that is missing in some half-planes does not count as a deviation of the rings.
TEST(MeshPot, MeasuresTheDeviationWhereTheMeshHasAWall) {
  TriangleMesh cup = noisy_cup(0.0);
  // A sixth of the outside, from the foot to the rim.
  std::erase_if(cup.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t i) {
      const glm::dvec3& p = cup.points[i];
      return std::hypot(p.x, p.y) > 39.9 && std::abs(std::atan2(p.y, p.x)) < std::numbers::pi / 6;
    });
  });
  const auto pot = mesh_pot(cup, {}, "cup.stl");
  ASSERT_TRUE(pot) << pot.error().message;
  EXPECT_LE(pot->deviation.mm, 0.03);
  EXPECT_NEAR(static_cast<double>(pot->measured), kMeshCuts * 5.0 / 6.0, 2.0);
  const test::ScratchFolder folder;
  const std::string file = folder.file("cup.stl"), out = " -o " + folder.file("cup.pot.json");
  test::write_text(file, *solid::encode_mesh(cup, solid::MeshFormat::stl_binary, {}));
  const auto run = test::claystack("import " + file + out);
  EXPECT_THAT(run.out, HasSubstr("above the foot, in 5")) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr(" of 64 half-planes through the axis"));
}

TEST(MeshPot, ReportsADeviationThatIsNotMeasured) {
  TriangleMesh cup = noisy_cup(0.0);
  // A band of the outside, all the way around.
  std::erase_if(cup.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t i) {
      const glm::dvec3& p = cup.points[i];
      return std::hypot(p.x, p.y) > 39.9 && std::abs(p.z - 40.0) < 2.1;
    });
  });
  const auto pot = mesh_pot(cup, {}, "cup.stl");
  ASSERT_TRUE(pot) << pot.error().message;
  EXPECT_EQ(pot->measured, 0u);
  EXPECT_EQ(pot->deviation.mm, 0.0);
}

/// An edge that meets two edges of half its length is not an opening.
TEST(MeshCuts, AreCompleteAtTJunctions) {
  TriangleMesh mesh = noisy_cup(0.0);
  const std::vector<bool> all(kMeshCuts, true);
  ASSERT_EQ(complete_cuts(mesh, mesh.points), all);
  const auto [a, b, c] = mesh.triangles[500];
  mesh.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
  const auto middle = static_cast<std::uint32_t>(mesh.points.size() - 1);
  mesh.triangles[500] = {a, middle, c};
  mesh.triangles.push_back({middle, b, c});
  EXPECT_EQ(complete_cuts(mesh, mesh.points), all);
  // A hole that is wider than the angle between half-planes.
  std::erase_if(mesh.triangles,
                [last = c](const auto& t) { return std::ranges::count(t, last) > 0; });
  EXPECT_NE(complete_cuts(mesh, mesh.points), all);
}

TEST(MeshPot, RefusesWhatIsNotOfRevolution) {
  TriangleMesh box;
  add_box(box, {0.0, 0.0, 0.0}, {80.0, 50.0, 30.0});
  const auto found = mesh_pot(box, {}, "box.stl");
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().message,
              HasSubstr("box.stl: expected a pot that is nearly of revolution"));
  // Smaller than half a millimetre, as from a file in metres: still not a pot.
  solid::TriangleMesh small = box;
  for (glm::dvec3& p : small.points) p *= 1e-3;
  const auto small_found = mesh_pot(small, {}, "small.stl");
  ASSERT_FALSE(small_found);
  EXPECT_THAT(small_found.error().message, HasSubstr("nearly of revolution"));
  const auto none = mesh_pot({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {}, "face.stl");
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("expected a mesh of a pot"));
}

/// Heights count from the lowest clay, which is not the foot of the pot here.
TEST(MeshPot, NamesAGapAboveAPartBelowThePot) {
  TriangleMesh mesh = Exported("bowl").mesh;
  add_box(mesh, {-3.0, -3.0, -9.0}, {3.0, 3.0, -2.0});
  const auto made = mesh_pot(mesh, {}, "bowl.stl");
  ASSERT_FALSE(made);
  EXPECT_THAT(made.error().message,
              HasSubstr("found none from 7.000 to 9.000 mm above the lowest clay; remove the part "
                        "below or above this gap"));
}

TEST(MeshPot, CommandReportsAxisAndDeviationAndRefusesOptionsOfDrawings) {
  const Exported sample("bowl");
  const std::string pot = sample.folder.file("again.pot.json");
  const auto run = test::claystack("import --json --height 50 " + sample.stl + " -o " + pot);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(run.json().at("height_mm").get<double>(), 50.0, 0.01);
  EXPECT_LE(run.json().at("deviation_mm").get<double>(), kToleranceMm + 0.01);
  EXPECT_EQ(run.json().at("not_of_revolution").size(), 0u);
  EXPECT_EQ(test::claystack("export -q " + pot + " " + sample.folder.file("b.stl")).status, 0);
  const auto small = test::claystack("import --height 0.1 " + sample.stl + " -o " + pot);
  EXPECT_EQ(small.status, 0) << small.err;
  EXPECT_THAT(small.err, HasSubstr("--height: the pot is only 0.1 mm high"));
  for (const char* option : {"--wall 5", "--axis left", "--layer a"}) {
    const auto refused = test::claystack("import " + sample.stl + " -o " + pot + " " + option);
    EXPECT_EQ(refused.status, 2) << option;
    EXPECT_THAT(refused.err, HasSubstr("expected a drawing, found the mesh"));
  }
}

TEST(MeshPot, CommandScalesAMeshInMetresAndItsVolume) {
  const Exported sample("vase");
  solid::TriangleMesh metres = sample.mesh;
  for (glm::dvec3& p : metres.points) p *= 1e-3;
  const std::string file = sample.folder.file("metres.stl"),
                    pot = " -o " + sample.folder.file("again.pot.json");
  test::write_text(file, *solid::encode_mesh(metres, solid::MeshFormat::stl_binary, {}));
  const auto unscaled = test::claystack("import " + file + pot);
  EXPECT_THAT(unscaled.err, HasSubstr("this one may be in metres or inches; --height MM scales"));
  EXPECT_THAT(test::claystack("check " + file).out, HasSubstr("this one may be in metres"));
  double height_mm = 0.0;
  for (const glm::dvec3& p : sample.mesh.points) height_mm = std::max(height_mm, p.z);
  const auto run =
      test::claystack("import --json --height " + std::to_string(height_mm) + " " + file + pot);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, testing::Not(HasSubstr("metres")));
  EXPECT_NEAR(run.json().at("height_mm").get<double>(), height_mm, 0.02);
  // Coordinates in float32, read with an absolute tolerance of about 1 um: 0.1 % of 1 mm.
  const double mm3 = sample.volume_mm3;
  EXPECT_NEAR(run.json().at("mesh_mm3").get<double>(), mm3, 2e-3 * mm3);
  EXPECT_NEAR(run.json().at("volume_mm3").get<double>(), mm3, 2e-3 * mm3);
}

TEST(MeshPot, CommandWarnsOfMeshesThatEncloseNoVolume) {
  const Exported sample("vase");
  const std::string pot = " -o " + sample.folder.file("again.pot.json");
  const auto imported = [&](const TriangleMesh& mesh, const char* name) {
    const std::string file = sample.folder.file(name);
    test::write_text(file, *solid::encode_mesh(mesh, solid::MeshFormat::stl_binary, {}));
    return std::pair(test::claystack("import --json " + file + pot),
                     test::claystack("import " + file + pot));
  };
  // Without a triangle, each of its three edges has one triangle only.
  TriangleMesh open = sample.mesh;
  open.triangles.erase(open.triangles.begin() + 50);
  const auto [open_json, open_text] = imported(open, "open.stl");
  EXPECT_EQ(open_json.status, 0) << open_json.err;
  EXPECT_THAT(open_json.err, HasSubstr("open.stl: expected a closed mesh, found 3 open edges"));
  EXPECT_TRUE(open_json.json().at("mesh_mm3").is_null());
  EXPECT_THAT(open_text.out, testing::Not(HasSubstr("in the mesh")));

  TriangleMesh inverted = sample.mesh;
  for (auto& [a, b, c] : inverted.triangles) std::swap(b, c);
  const auto [inverted_json, inverted_text] = imported(inverted, "inverted.stl");
  EXPECT_THAT(inverted_json.err, HasSubstr("inverted.stl: expected triangles that face outward"));
  EXPECT_NEAR(inverted_json.json().at("mesh_mm3").get<double>() / sample.volume_mm3, 1.0, 1e-3);

  TriangleMesh mixed = sample.mesh;
  std::swap(mixed.triangles[70][1], mixed.triangles[70][2]);
  const auto [mixed_json, mixed_text] = imported(mixed, "mixed.stl");
  EXPECT_THAT(mixed_json.err, HasSubstr("found 3 edges between triangles of opposite orientation"));
  EXPECT_TRUE(mixed_json.json().at("mesh_mm3").is_null());

  TriangleMesh partly = sample.mesh;
  partly.triangles.insert(partly.triangles.end(), sample.mesh.triangles.begin(),
                          sample.mesh.triangles.begin() + 20);
  const auto [partly_json, partly_text] = imported(partly, "partly.stl");
  EXPECT_EQ(partly_json.status, 0);
  EXPECT_THAT(partly_json.err, HasSubstr("expected two triangles at each edge"));
  EXPECT_TRUE(partly_json.json().at("mesh_mm3").is_null());

  TriangleMesh twice = sample.mesh;
  twice.triangles.insert(twice.triangles.end(), sample.mesh.triangles.begin(),
                         sample.mesh.triangles.end());
  const auto [twice_json, twice_text] = imported(twice, "twice.stl");
  EXPECT_EQ(twice_json.status, 2);
  EXPECT_THAT(twice_json.err, testing::ContainsRegex("around none; claystack check .*twice.stl"));

  const auto [sound_json, sound_text] = imported(sample.mesh, "sound.stl");
  EXPECT_EQ(sound_json.err, "");
}

TEST(MeshPot, CommandWritesDirectionsFrom0To359DegreesAndNoNegativeZero) {
  const Exported sample("cylinder");
  TriangleMesh mug = sample.mesh;
  add_box(mug, {38.0, -6.0, 50.0}, {68.0, 8.0, 110.0});  // on both sides of azimuth 0
  const std::string file = sample.folder.file("mug.stl");
  test::write_text(file, *solid::encode_mesh(mug, solid::MeshFormat::stl_binary, {}));
  const auto run =
      test::claystack("import " + file + " -o " + sample.folder.file("again.pot.json"));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, testing::ContainsRegex("azimuth 3[0-9]+ to [0-9]+ degrees")) << run.out;
  EXPECT_THAT(run.out, testing::Not(testing::ContainsRegex("to 3[0-9]+ degrees"))) << run.out;
  EXPECT_EQ(text_of({0.01, 3.0, -1e-9}, "mesh"),
            "largest deviation from the mesh: 0.010 mm, 3.00 mm from the axis and 0.00 mm above "
            "the foot");
}

}  // namespace
}  // namespace clay::importing
