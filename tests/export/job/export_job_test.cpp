#include "claystack/export/job.hpp"

#include "claystack/engine/clay.hpp"
#include "export/formats/zip_package.hpp"
#include "tests/export/formats/refused.hpp"
#include "tests/export/job/exported.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

using samples::every_format;
using samples::exported;
using samples::Exported;
using samples::refused;
using shapes::pot_of;
using shapes::stack_of;

TEST(RunExport, VaseInEveryFormat) {
  const Pot pot = pot_of(shapes::vase(200));
  const auto result = exported(pot, every_format(), {});
  ASSERT_TRUE(result) << result.error().message;
  const ExportReport& report = result->report;
  EXPECT_EQ(report.size.shells, 1u);
  EXPECT_EQ(report.section.planar.polygons, 1u);
  EXPECT_EQ(report.section.shapes().at(0).topology, Topology::cup);
  EXPECT_LE(report.size.chordal_error_mm, 0.02);
  EXPECT_DOUBLE_EQ(report.prepared.counted_volume_mm3, pot.stack.volume_mm3());
  EXPECT_LT(report.volume.error_relative, 1e-9);
  ASSERT_EQ(report.files.size(), every_format().size());
  for (std::size_t i = 0; i < report.files.size(); ++i) {
    const FileReport& file = report.files[i];
    EXPECT_EQ(file.format, every_format()[i]);
    EXPECT_TRUE(file.read_back);
    EXPECT_EQ(file.proof, Proof::margins);
    EXPECT_EQ(file.bytes, result->files[i].size());
    const auto decoded = decode_mesh(result->files[i], file.format, "file");
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_EQ(decoded->triangles.size(), report.size.triangles);
    const MeshReport check = check_mesh(*decoded).value();
    EXPECT_TRUE(check.sound());
    EXPECT_NEAR(check.volume_mm3, report.volume.solid_mm3, file.certificate->volume_bound_mm3);
    const bool draco = file.format == MeshFormat::drc || file.format == MeshFormat::glb;
    EXPECT_LE(file.max_error_mm, draco ? 0.0201 : 4e-5);
    EXPECT_GT(file.max_error_mm, 0.0);
  }
}

TEST(RunExport, DrawsThePictureOfA3mfAlone) {
  int drawn = 0;
  ExportOptions options;
  options.draw_thumbnail = [&] {
    ++drawn;
    return std::string("png");
  };
  const Pot pot = pot_of(shapes::vase(100));
  const auto others = exported(pot, {MeshFormat::stl_binary, MeshFormat::ply}, options);
  ASSERT_TRUE(others) << others.error().message;
  EXPECT_EQ(drawn, 0);
  const auto made = exported(pot, {MeshFormat::three_mf}, options);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(drawn, 1);
  EXPECT_EQ(ZipPackage::open(made->files[0], "x")->read("Metadata/thumb.png", 10).value(), "png");
}

TEST(RunExport, ReportsItsStagesInOrder) {
  std::vector<std::string> told;
  const auto result = exported(pot_of(shapes::vase(100)), {MeshFormat::obj}, {},
                               [&](std::string_view stage) { told.emplace_back(stage); });
  ASSERT_TRUE(result);
  EXPECT_EQ(told, (std::vector<std::string>{"profile", "smooth", "certificate", "claims", "wall",
                                            "overhang", "tessellate", "encode_obj", "store_obj",
                                            "verify_obj"}));
  ASSERT_EQ(result->report.stages.size(), told.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(result->report.stages[i].name, told[i]);
    EXPECT_GE(result->report.stages[i].seconds, 0.0);
  }
}

TEST(RunExport, ReportsSkippedStages) {
  ExportOptions options;
  options.smoothing = Smoothing::none;
  const auto result = exported(pot_of(stack_of(5.0, {{20, 0}})), {MeshFormat::stl_binary}, options);
  ASSERT_TRUE(result);
  std::vector<std::string> out;
  for (const SkippedStage& item : result->report.left_out) out.push_back(item.what);
  EXPECT_EQ(out, (std::vector<std::string>{"inner shell", "smoothing", "union", "budget",
                                           "mesh in memory", "full verification", "stl_ascii",
                                           "obj", "drc", "ply", "3mf", "glb"}));
  const auto hollow = exported(pot_of(shapes::vase(100)), {}, {});
  EXPECT_EQ(hollow->report.section.smoothing, Smoothing::fair);
  EXPECT_EQ(hollow->report.left_out.front().what, "union");
}

TEST(RunExport, SegmentsFollowTheToleranceUnlessForced) {
  const Pot pot = pot_of(shapes::vase(100));
  ExportOptions options;
  options.tolerance_mm = 0.5;
  const auto coarse = exported(pot, {}, options);
  options.tolerance_mm = 0.005;
  const auto fine = exported(pot, {}, options);
  EXPECT_GT(fine->report.size.segments, 5 * coarse->report.size.segments);
  EXPECT_LE(fine->report.size.chordal_error_mm, 0.005);
  options.segments = 9;
  EXPECT_EQ(exported(pot, {}, options)->report.size.segments, 9u);
}

TEST(RunExport, RefusesOptionsThatCannotBeMet) {
  const Pot pot = pot_of(shapes::vase(100));
  ExportOptions options;
  for (const double tolerance : {0.0, -1.0, std::nan("")}) {
    options.tolerance_mm = tolerance;
    EXPECT_TRUE(refused(exported(pot, {}, options), ErrorKind::bad_input, "tolerance"));
  }
  options.tolerance_mm = 1e-5;
  EXPECT_TRUE(
      refused(exported(pot, {}, options), ErrorKind::bad_input, "tolerance: expected at least"));
  options = {};
  for (const std::size_t segments : {std::size_t{0}, std::size_t{2}, (std::size_t{1} << 20) + 1}) {
    options.segments = segments;
    EXPECT_TRUE(refused(exported(pot, {}, options), ErrorKind::bad_input, "segments: expected 3"));
  }
  options.segments = std::size_t{1} << 20;
  EXPECT_TRUE(
      refused(exported(pot, {MeshFormat::stl_binary}, options), ErrorKind::bad_input, "triangles"));
}

/// The limit that the error states is enough, whatever digits it has.
TEST(RunExport, AcceptsTheToleranceThatTheErrorNames) {
  for (int rings = 60; rings < 90; rings += 4) {
    const Pot pot = pot_of(shapes::vase(static_cast<std::size_t>(rings)));
    ExportOptions options;
    options.tolerance_mm = 1e-5;
    const auto refusal = exported(pot, {}, options);
    ASSERT_FALSE(refusal);
    const std::string expected = "expected at least ", &text = refusal.error().message;
    ASSERT_NE(text.find(expected), text.npos) << text;
    options.tolerance_mm = std::stod(text.substr(text.find(expected) + expected.size()));
    const auto again = exported(pot, {}, options);
    EXPECT_TRUE(again || again.error().message.find("tolerance") == std::string::npos) << text;
  }
}

TEST(RunExport, ThinWallsAreSmoothedNoThinner) {
  // A bulge of 3.9 mm outside may be left out, one of 4.1 mm inside may not: they would cross.
  std::vector<shapes::Radii> radii;
  for (int i = 0; i <= 400; ++i) {
    const double bulge = 1.0 - std::abs(i - 200) / 200.0;
    radii.push_back({40.0 + 3.9 * bulge, 39.7 + 4.1 * bulge});
  }
  const ClayStack stack = stack_of(0.5, radii);
  ExportOptions options;
  options.tolerance_mm = 8.0;
  const auto result = exported(pot_of(stack), {}, options);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->report.section.smoothing, Smoothing::fair);
  const double facets =
      std::cos(std::numbers::pi / static_cast<double>(result->report.size.segments));
  // Of the steps, at the bulge: from the bore of a ring to the outside of its neighbour.
  const double steps = (40.0 + 3.9 * 0.995) - (39.7 + 4.1);
  EXPECT_GE(result->report.walls.min_wall_mm, steps * facets * (1.0 - 1e-9));
}

TEST(RunExport, WallsFollowTheToolUnlessALengthIsGiven) {
  Pot pot = pot_of(shapes::vase(200));
  const auto length_mm = [&](std::optional<double> asked_mm, Smoothing smoothing, double shrinkage,
                             double tolerance_mm = 0.02) {
    ExportOptions options;
    options.tolerance_mm = tolerance_mm;
    options.smooth_length_mm = asked_mm;
    options.smoothing = smoothing;
    options.shrinkage = shrinkage;
    return exported(pot, {MeshFormat::stl_binary}, options)
        .value()
        .report.section.smoothed.fairing.length_mm;
  };
  EXPECT_EQ(length_mm({}, Smoothing::fair, 0.0), 0.0);  // not thrown
  pot.thrown_with = ThrowSettings{};
  pot.thrown_with->tool.shape = SphereSpec{7.0};
  EXPECT_EQ(length_mm({}, Smoothing::fair, 0.0), 0.0);  // without clay rules
  pot.thrown_with->clay = ClaySpec{};
  EXPECT_DOUBLE_EQ(length_mm({}, Smoothing::fair, 0.0), 7.0);
  EXPECT_DOUBLE_EQ(length_mm({}, Smoothing::fair, 0.3), 10.0);
  EXPECT_EQ(length_mm(0.0, Smoothing::fair, 0.0), 0.0);
  EXPECT_EQ(length_mm(4.0, Smoothing::fair, 0.0), 4.0);
  EXPECT_EQ(length_mm({}, Smoothing::fair, 0.0, 0.11), 0.0);
  EXPECT_EQ(length_mm(4.0, Smoothing::fair, 0.0, 0.11), 4.0);
  EXPECT_EQ(length_mm({}, Smoothing::exact, 0.0), 0.0);
  EXPECT_EQ(length_mm({}, Smoothing::none, 0.0), 0.0);
  pot.thrown_with->tool = {.shape = SphereSpec{0.5}, .mode = ToolMode::needle};
  pot.shaped_with = ToolSpec{.shape = SphereSpec{7.0}};
  EXPECT_DOUBLE_EQ(length_mm({}, Smoothing::fair, 0.0), 7.0);
}

TEST(RunExport, WallIsThatOfTheFacets) {
  ExportOptions options;
  options.segments = 12;
  const auto result = exported(pot_of(stack_of(30.0, {{40, 0}, {40, 35}})), {}, options);
  // A dodecagon of the area of the unit circle has this radius.
  const double factor = std::sqrt(std::numbers::pi / (6.0 * std::sin(std::numbers::pi / 6)));
  // Less twice the rounding of float32 at 41 mm from the origin, with heights up to 60 mm.
  const double wall = 5.0 * factor * std::cos(std::numbers::pi / 12);
  EXPECT_LT(result->report.walls.min_wall_mm, wall);
  EXPECT_GT(result->report.walls.min_wall_mm, wall - 2.0 * std::ldexp(std::hypot(41.0, 60.0), -24));
}

TEST(RunExport, PiecesOnlyWhenAllowed) {
  const Pot pot = pot_of(stack_of(2.0, {{10, 0}, {10, 0}, {30, 20}}));
  EXPECT_TRUE(refused(exported(pot, {}, {}), ErrorKind::unsound, "rings 1 and 2"));
  ExportOptions options;
  options.allow_pieces = true;
  const auto result = exported(pot, every_format(), options);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->report.size.shells, 2u);
  const auto problems = problems_of(result->report);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_FALSE(problems[0].fails);
  EXPECT_EQ(problems[0].text,
            "2 pieces that do not touch: all but the lowest are in mid-air; ring 2 is the first of "
            "the second");
}

TEST(RunExport, APotInPiecesFailsTheSameCheckWithAndWithoutAFinish) {
  const Pot pot = pot_of(stack_of(2.0, {{10, 0}, {10, 0}, {30, 20}}));
  ExportOptions options;
  options.finish.glaze_mm = 0.5;
  EXPECT_TRUE(refused(exported(pot, {}, options), ErrorKind::unsound, "rings 1 and 2"));
  options.allow_pieces = true;
  EXPECT_TRUE(refused(exported(pot, {}, options), ErrorKind::bad_input,
                      "finish: expected one piece, found 2"));
}

TEST(RunExport, WallsLostInFloat32AreRefusedWithThePlace) {
  // Half an ulp of float32 at 73 mm is 3.8e-6 mm; the doubles still differ.
  const Pot pot = pot_of(stack_of(5.0, {{73.0, 73.0 - 1e-6}}));
  ASSERT_TRUE(certify(profile_of(pot.stack)->profile));
  EXPECT_TRUE(refused(exported(pot, {MeshFormat::stl_binary}, {}), ErrorKind::unsound,
                      "the wall of 1e-06 mm at a height of"));
}

TEST(RunExport, StepsBelowFloat32AreLevelledAndKeepTheVolume) {
  // A tool's reach fades out: neighbouring rings differ by a few quanta, as in every real session.
  const Quanta outer2 = quanta_from_radius(60.0), inner2 = quanta_from_radius(56.0);
  std::vector<Ring> rings;
  for (Quanta i = 0; i < 40; ++i)
    rings.push_back({outer2 + (Quanta{1} << i), i < 2 ? 0 : inner2 - (Quanta{1} << (i / 2))});
  const Pot pot = pot_of(ClayStack::from_rings(1.0, rings, 0).value());
  const auto result = exported(pot, every_format(), {});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_LT(result->report.volume.error_relative, 1e-9);
}

TEST(RunExport, TouchingRingsAreRefused) {
  EXPECT_TRUE(refused(exported(pot_of(stack_of(2.0, {{5, 0}, {9, 5}})), {}, {}), ErrorKind::unsound,
                      "rings 0 and 1"));
}

#ifdef CLAYSTACK_DRACO
/// Walls of about 0.01 mm: on a coarse grid that is sound by itself, close vertices change places.
TEST(RunExport, DracoKeepsCloseVerticesApartAtAnyTolerance) {
  const std::vector<Quanta> outer{
      147430380349435, 147404164000399, 147400449700457, 147446888952018, 147437476531061,
      147429127346929, 147456287535456, 147470348455588, 147479649958966, 147490328509038,
      147468197132087, 147475779650955, 147460562502399, 147441945765534, 147449191789362,
      147457599638561, 147463629653818, 147466382206144, 147487042255806, 147532739521461,
      147498180515924, 147495270215485, 147476919738964, 147496273260245, 147455149978504,
      147459389089327, 147454207262492};
  const std::vector<Quanta> inner{
      147374135700739, 147323990706571, 147364163805288, 147381915529716, 147365447402062,
      147356866340634, 147410701771551, 147390199103246, 147389548411650, 147440387585819,
      147372842715362, 147382435327887, 147428160182607, 147351168746891, 147383773244437,
      147409739370327, 147405844223245, 147409599223567, 147422974692513, 147472562267298,
      147407951551034, 147447873905946, 147396982637925, 147455224121571, 147388929933452,
      147379857223735, 147384889521256};
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < outer.size(); ++i) rings.push_back({outer[i], inner[i]});
  const ClayStack stack = ClayStack::from_rings(0.05, std::move(rings), 0).value();
  for (const double tolerance : {0.005, 0.02}) {
    ExportOptions options;
    options.tolerance_mm = tolerance;
    options.allow_pieces = true;
    for (const GlbMesh glb : {GlbMesh::draco, GlbMesh::core}) {
      options.glb = glb;
      const auto result = exported(
          pot_of(stack), {MeshFormat::stl_binary, MeshFormat::drc, MeshFormat::glb}, options);
      ASSERT_TRUE(result) << result.error().message;
      EXPECT_TRUE(
          check_mesh(*decode_mesh(result->files[2], MeshFormat::glb, "pot")).value().sound());
    }
  }
}

TEST(RunExport, DracoGetsTheBitsThatThinWallsNeed) {
  // No edge is shorter than the grid of 0.5 mm that would do for the tolerance, but the neck
  // between the two rings is 0.01 mm wide.
  ExportOptions options;
  options.tolerance_mm = 0.5;
  options.smoothing = Smoothing::none;
  const auto result =
      exported(pot_of(stack_of(9.0, {{40, 30}, {50, 39.99}})), {MeshFormat::drc}, options);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->report.files[0].proof, Proof::margins);
  EXPECT_LT(result->report.files[0].max_error_mm, 0.01 / 8);
  EXPECT_TRUE(check_mesh(*decode_mesh(result->files[0], MeshFormat::drc, "pot")).value().sound());
}

TEST(RunExport, WithoutMarginsDracoGetsBitsUntilTheExactTestPasses) {
  // Seven segments have no margins; the neck asks for more than the 10 bits of the tolerance.
  ExportOptions options;
  options.tolerance_mm = 0.5;
  options.segments = 7;
  options.smoothing = Smoothing::none;
  int attempts = 0;
  const auto result =
      exported(pot_of(stack_of(9.0, {{40, 30}, {50, 39.99}})), {MeshFormat::drc}, options,
               [&](std::string_view stage) { attempts += stage == "encode_drc" ? 1 : 0; });
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_GT(attempts, 2);
  EXPECT_EQ(result->report.files[0].proof, Proof::exact_test);
  // As measured by the test that passed: a grid moves vertices, within the tolerance.
  EXPECT_GT(result->report.files[0].max_error_mm, 0.0);
  EXPECT_LE(result->report.files[0].max_error_mm, options.tolerance_mm);
  EXPECT_TRUE(check_mesh(*decode_mesh(result->files[0], MeshFormat::drc, "pot")).value().sound());
}

/// A wall of 2.2e-6 mm is two steps of float32 thick, less than the rounding of Draco's grid, which
/// is in float32 too.
TEST(RunExport, AWallBelowEveryDracoGridIsRefusedWithTheRemedy) {
  std::vector<shapes::Radii> radii(81, {8.797671115784807, 8.79766887984723});
  for (std::size_t i = 0; i < 18; ++i) radii[i].inner_mm = 0.0;
  const Pot pot = pot_of(stack_of(0.15, radii));
  EXPECT_TRUE(exported(pot, {MeshFormat::stl_binary}, {}));
  EXPECT_TRUE(refused(exported(pot, {MeshFormat::drc}, {}), ErrorKind::unsound,
                      "write it in another format, such as .stl: "));
}
#endif

RC_GTEST_PROP(RunExport, WhatIsWrittenIsSoundOrRefused, (const ClayStack& stack)) {
  ExportOptions options;
  options.smoothing = *rc::gen::element(Smoothing::none, Smoothing::fair);
  options.tolerance_mm = 0.3;
  options.allow_pieces = true;
  const auto result = exported(pot_of(stack), every_format(), options);
  if (!result) {
    RC_ASSERT(result.error().kind == ErrorKind::unsound);
    return;
  }
  RC_ASSERT(result->report.volume.error_relative * stack.volume_mm3() <=
            shapes::volume_rounding(stack, 1e-6 * 20.0));
  for (std::size_t i = 0; i < result->files.size(); ++i) {
    const auto decoded = decode_mesh(result->files[i], every_format()[i], "pot");
    RC_ASSERT(decoded.has_value());
    RC_ASSERT(check_mesh(*decoded).value().sound());
  }
}

TEST(RunExport, FinishIsInTheLedgerOfEveryMesh) {
  const Pot pot = shapes::pot_of(shapes::vase(200));
  ExportOptions plain;
  plain.full_verification = true;
  ExportOptions options = plain;
  options.finish = {FootRing{5, 2, {}}, 4.0, 0.4};
  options.walls.min_wall_mm = 0.5;
  const auto before = samples::exported(pot, {}, plain);
  const auto after = samples::exported(pot, samples::every_format(), options);
  ASSERT_TRUE(before && after) << (after ? "" : after.error().message);
  const ExportReport& report = after->report;
  const FinishLedger& ledger = report.section.finish;
  EXPECT_GT(ledger.foot_trimmed_mm3, 0.0);
  EXPECT_GT(ledger.glaze_trimmed_mm3, 0.0);
  EXPECT_GT(ledger.floor_added_mm3, 0.0);
  EXPECT_NEAR(
      report.prepared.counted_volume_mm3,
      before->report.prepared.counted_volume_mm3 - ledger.trimmed_mm3() + ledger.floor_added_mm3,
      1e-6);
  EXPECT_LT(report.volume.error_relative, 1e-12);
  EXPECT_NEAR(report.size.height_mm, 199.6, 1e-9);
  for (const FileReport& file : report.files) {
    EXPECT_TRUE(file.full_verification->sound()) << name_of(file.format);
    EXPECT_NEAR(file.full_verification->volume_mm3 / report.prepared.counted_volume_mm3, 1.0, 5e-4);
  }
}

/// The grid of a DRC or a GLB takes up to twice the tolerance off a wall.
TEST(RunExport, AWallDrawnAtTheLimitKeepsItInEveryFormat) {
  for (const double wall_mm : {0.5, 1.0, 3.0}) {
    // A cup whose walls and floor have this thickness.
    std::vector<shapes::Radii> rings(20, {30.0, 30.0 - wall_mm});
    rings.front() = {30.0, 0.0};
    ExportOptions options;
    options.walls.min_wall_mm = wall_mm;
    const auto result = exported(pot_of(stack_of(wall_mm, rings)), every_format(), options);
    ASSERT_TRUE(result) << result.error().message;
    const ExportReport& report = result->report;
    EXPECT_FALSE(thin_wall_of(report)) << *thin_wall_of(report);
    EXPECT_GE(report.thinnest_mm(), report.walls.limit->least_mm());
    for (const FileReport& file : report.files) EXPECT_LE(file.max_error_mm, options.tolerance_mm);
    // A limit that the pot does not keep changes no file.
    const auto plain = exported(pot_of(stack_of(wall_mm, rings)), every_format(), {});
    options.walls.min_wall_mm = 1.1 * wall_mm;
    const auto thin = exported(pot_of(stack_of(wall_mm, rings)), every_format(), options);
    ASSERT_TRUE(plain && thin);
    EXPECT_TRUE(thin_wall_of(thin->report));
    for (std::size_t i = 0; i < plain->files.size(); ++i)
      EXPECT_TRUE(plain->files[i] == thin->files[i]) << i;
  }
}

TEST(RunExport, OnlyAMeshIsRefusedForItsTriangles) {
  // Some 600 edges off the axis, two triangles each, in 20,000 segments.
  std::vector<shapes::Radii> rings;
  for (std::size_t i = 0; i < 300; ++i) rings.push_back({i % 2 == 0 ? 2000.0 : 1999.0, 1900.0});
  const Pot pot = pot_of(stack_of(1.0, rings));
  ExportOptions options;
  options.smoothing = Smoothing::none;
  options.segments = 20'000;
  EXPECT_TRUE(refused(exported(pot, {MeshFormat::stl_binary}, options), ErrorKind::bad_input,
                      "at most 20000000 triangles"));
  const auto drawn = run_export(pot, {}, options);
  ASSERT_TRUE(drawn) << drawn.error().message;
  EXPECT_GT(drawn->size.triangles, kMaxTriangles);
  EXPECT_FALSE(drawing_svg(*drawn, options).empty());
}

TEST(RunExport, RefusesAMeshThatNoReaderAccepts) {
  // Readers accept coordinates within 1 km.
  ExportOptions options;
  options.segments = 8;
  const auto needle = [](std::size_t rings) {
    return pot_of(stack_of(1000.0, std::vector<shapes::Radii>(rings, {5000.0, 0.0})));
  };
  for (const MeshFormat format : {MeshFormat::stl_binary, MeshFormat::obj}) {
    const auto highest = exported(needle(1000), {format}, options);
    ASSERT_TRUE(highest) << highest.error().message;
    EXPECT_TRUE(decode_mesh(highest->files[0], format, "file"));
    EXPECT_TRUE(refused(exported(needle(1001), {format}, options), ErrorKind::bad_input,
                        "height: expected at most 1000000 mm for a mesh, found 1001000 mm"));
  }
  EXPECT_TRUE(run_export(needle(1001), {}, options));
}

}  // namespace
}  // namespace clay::solid
