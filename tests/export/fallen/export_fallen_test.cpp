#include "claystack/export/check.hpp"
#include "claystack/export/proof.hpp"
#include "tests/export/fallen/collapsed_pots.hpp"
#include "tests/export/formats/refused.hpp"
#include "tests/export/job/exported.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid {
namespace {

using samples::every_format;
using samples::exported;
using samples::refused;
using shapes::pot_of;
using shapes::stack_of;

TEST(ExportFallen, UnitesTheParts) {
  Pot pot = pot_of(shapes::vase(100));
  pot.collapse = Collapse{30, {50, 70, 0}, {0, 0, 1}, 1.0, 12.0};
  ExportOptions options;
  options.tolerance_mm = 0.2;
  std::vector<std::string> reported;
  const auto result = exported(pot, every_format(), options,
                               [&](std::string_view stage) { reported.emplace_back(stage); });
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(reported.at(0), "parts");
  EXPECT_EQ(reported.at(1), "union");
  const ExportReport& report = result->report;
  ASSERT_TRUE(report.collapsed);
  EXPECT_TRUE(report.collapsed->check.sound());
  EXPECT_EQ(report.section.smoothing, Smoothing::fair);
  EXPECT_EQ(report.section.planar.polygons, 2u);
  EXPECT_EQ(report.section.shapes().at(1).first_ring, 31u);
  EXPECT_DOUBLE_EQ(report.prepared.counted_volume_mm3, pot.stack.volume_mm3());
  EXPECT_GT(report.collapsed->overlap_mm3, 0.01 * report.prepared.counted_volume_mm3);
  EXPECT_NEAR(
      (report.volume.solid_mm3 + report.collapsed->overlap_mm3 - report.collapsed->pockets_mm3) /
          report.prepared.counted_volume_mm3,
      1.0, 1e-6);
  EXPECT_LT(report.volume.error_relative, 1e-6);
  for (const SkippedStage& item : report.left_out) EXPECT_NE(item.what, "union");
  for (std::size_t i = 0; i < result->files.size(); ++i) {
    EXPECT_EQ(report.files[i].proof, Proof::exact_test);
    EXPECT_FALSE(report.files[i].certificate);
    const auto decoded = decode_mesh(result->files[i], report.files[i].format, "file");
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_TRUE(check_mesh(*decoded).value().sound());
    EXPECT_EQ(decoded->triangles.size(), report.size.triangles);
  }
}

TEST(ExportFallen, ADecimatedPotStatesTheSizeAndWallOfItsFile) {
  Pot pot = pot_of(shapes::vase(100));
  pot.collapse = Collapse{30, {50, 70, 0}, {0, 0, 1}, 1.0, 12.0};
  ExportOptions options;
  options.tolerance_mm = 0.05;
  options.max_triangles = 4000;
  const auto result = exported(pot, {MeshFormat::stl_binary}, options);
  ASSERT_TRUE(result) << result.error().message;
  const ExportReport& report = result->report;
  ASSERT_LE(report.size.triangles, 4000u);
  const TriangleMesh mesh = decode_mesh(result->files[0], MeshFormat::stl_binary, "file").value();
  const glm::dvec3 size = extent_of(mesh).size();
  EXPECT_NEAR(report.size.height_mm, size.z, 1e-9);
  EXPECT_NEAR(report.size.diameter_mm, std::max(size.x, size.y), 1e-9);
  EXPECT_LE(report.walls.min_wall_mm, sampled_wall(mesh, 20'000).value().least_mm);
}

/// Width and depth of a fallen pot differ. A limit that its file just meets is met by the export.
TEST(ExportFallen, ComparesTheThreeExtentsOfItsFileWithTheLimits) {
  Pot pot = pot_of(shapes::vase(100));
  pot.collapse = Collapse{30, {50, 70, 0}, {0, 0, 1}, 1.0, 12.0};
  ExportOptions options;
  options.tolerance_mm = 0.2;
  const auto plain = exported(pot, {MeshFormat::stl_binary}, options);
  ASSERT_TRUE(plain) << plain.error().message;
  const TriangleMesh mesh = decode_mesh(plain->files[0], MeshFormat::stl_binary, "file").value();
  const glm::dvec3 size = extent_of(mesh).size();
  ASSERT_GT(std::abs(size.x - size.y), 1.0);
  const auto with_size = [&](const SizeLimit& limit) {
    options.walls.process = ProcessLimits{
        "machine", {{size.x + size.y + size.z + 0.1, 0.01, "small", {}}, {1e6, 50.0, "large", {}}},
        false,     {},
        limit,     {}};
    return exported(pot, {}, options).value().report;
  };
  const auto large = [](const ExportReport& report) {
    const std::vector<Problem> problems = problems_of_solid(report);
    return std::ranges::any_of(problems,
                               [](const Problem& p) { return p.kind == ProblemKind::too_large; });
  };
  const ExportReport fits = with_size({size.y + 0.1, size.x + 0.1, size.z + 0.1, "s"});
  EXPECT_FALSE(large(fits));
  EXPECT_EQ(fits.walls.limit.value().min_wall_mm, 0.01);
  EXPECT_TRUE(large(with_size({size.y - 0.3, size.x + 0.1, size.z + 0.1, "s"})));
  EXPECT_TRUE(large(with_size({size.y + 0.1, size.x - 0.3, size.z + 0.1, "s"})));
  EXPECT_TRUE(large(with_size({size.y + 0.1, size.x + 0.1, size.z - 0.3, "s"})));
}

/// The seam and rounding may move both sides of a wall of a part, and make it thinner by twice
/// that.
TEST(ExportFallen, WallOfTheSolidAllowsForWhatMoved) {
  const Pot pot = shapes::fallen(shapes::vase(100), 30, {50, 70, 0}, 1.0);
  ExportOptions options;
  options.smoothing = Smoothing::none;
  const ExportReport report = exported(pot, {}, options).value().report;
  const auto parts = collapsed_parts(pot, Smoothing::none, options.tolerance_mm).value();
  const auto wall_mm = [&](const StackProfile& part) {
    return claims_of(part.profile, report.size.segments, 0.0).wall_lower_mm;
  };
  const double part_mm = std::min(wall_mm(parts.lower), wall_mm(parts.upper));
  ASSERT_GT(report.collapsed->reshaped_mm, 0.0);
  EXPECT_NEAR(report.walls.min_wall_mm, part_mm - 2.0 * report.collapsed->reshaped_mm, 1e-12);
}

/// A rim of 2 mm on a thick wall, slightly lower than wide: between facets it is low enough to
/// count as a wall.
TEST(ExportFallen, TheWallIsThatOfTheFacets) {
  std::vector<Ring> rings(214, {quanta_from_radius(30), quanta_from_radius(20)});
  std::fill_n(rings.begin(), 51, Ring{quanta_from_radius(30), 0});
  std::fill_n(rings.end() - 10, 10, Ring{quanta_from_radius(28), quanta_from_radius(26)});
  const ClayStack stack = ClayStack::from_rings(0.197, rings, 0).value();
  ExportOptions options;
  options.smoothing = Smoothing::none;
  options.segments = 8;
  options.tolerance_mm = 5.0;
  const auto wall_of = [&](const Pot& pot) {
    return exported(pot, {}, options).value().report.walls.min_wall_mm;
  };
  const double standing = wall_of(pot_of(stack));
  EXPECT_LT(standing, 2.0);
  EXPECT_LE(wall_of(shapes::fallen(stack, 100, {0, 20, 0}, 0.0)),
            standing + 1e-5);  // rounded as in a file
}

/// The vertices of a Draco file lie on a grid.
TEST(ExportFallen, TheWallOfAFileOnAGridIsThinner) {
  Pot pot = pot_of(shapes::vase(100));
  pot.collapse = Collapse{30, {50, 70, 0}, {0, 0, 1}, 1.0, 12.0};
  pot.collapse->shift_mm = {400.0, 0.0, 0.0};
  ExportOptions options;
  options.tolerance_mm = 0.2;
  options.allow_pieces = true;
  const auto result = exported(pot, {MeshFormat::drc}, options);
  ASSERT_TRUE(result) << result.error().message;
  const ExportReport& report = result->report;
  ASSERT_GT(report.files[0].max_error_mm, 0.01);
  EXPECT_NEAR(report.thinnest_mm(), report.walls.min_wall_mm - 2.0 * report.files[0].max_error_mm,
              1e-12);
  const TriangleMesh mesh = decode_mesh(result->files[0], MeshFormat::drc, "file").value();
  EXPECT_LE(report.thinnest_mm(), sampled_wall(mesh, 20'000).value().least_mm);
}

/// With a limit that the parts keep, the grid is as fine as it has to be.
TEST(ExportFallen, AGridKeepsAWallAtTheLimit) {
  Pot pot = pot_of(shapes::vase(100));
  pot.collapse = Collapse{30, {50, 70, 0}, {0, 0, 1}, 1.0, 12.0};
  pot.collapse->shift_mm = {400.0, 0.0, 0.0};
  ExportOptions options;
  options.allow_pieces = true;
  options.tolerance_mm = 0.2;
  const auto free = exported(pot, {MeshFormat::drc}, options);
  ASSERT_TRUE(free) << free.error().message;
  options.walls.min_wall_mm = free->report.walls.min_wall_mm;
  const auto result = exported(pot, {MeshFormat::drc}, options);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_FALSE(thin_wall_of(result->report)) << *thin_wall_of(result->report);
  EXPECT_GT(free->report.walls.min_wall_mm, 1.0);
  EXPECT_LT(free->report.thinnest_mm(), result->report.walls.limit->least_mm());
}

TEST(ExportFallen, MeasuresTheFormatsLeftOut) {
  Pot pot = pot_of(shapes::vase(60));
  pot.collapse = Collapse{20, {50, 40, 0}, {0, 0, 1}, 1.0, 12.0};
  ExportOptions options;
  options.tolerance_mm = 0.2;
  options.measure_left_out = true;
  const auto result = exported(pot, {MeshFormat::stl_binary}, options);
  ASSERT_TRUE(result) << result.error().message;
  std::size_t measured = 0;
  for (const SkippedStage& item : result->report.left_out)
    if (mesh_format_named(item.what)) {
      EXPECT_TRUE(item.saved_s) << item.what;
      ++measured;
    }
  EXPECT_EQ(measured, every_format().size() - 1);
}

TEST(ExportFallen, WritesSeparatePiecesOnlyIfAllowed) {
  for (const std::size_t failed : {std::size_t{1}, std::size_t{3}}) {
    Pot pot = pot_of(stack_of(2.0, {{10, 0}, {10, 0}, {10, 0}, {10, 0}, {30, 0}}));
    std::vector<Ring> rings(pot.stack.rings().begin(), pot.stack.rings().end());
    rings[failed == 1 ? 3 : 2] = {quanta_from_radius(30), quanta_from_radius(20)};
    pot.stack = ClayStack::from_rings(2.0, rings, 0).value();
    pot.collapse = Collapse{failed, {50, 4, 0}, {0, 0, 1}, 1.0, 12.0};
    EXPECT_TRUE(refused(exported(pot, {}, {}), ErrorKind::unsound, "that do not touch")) << failed;
    ExportOptions options;
    options.allow_pieces = true;
    const auto result = exported(pot, {}, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_TRUE(result->report.collapsed->check.sound());
  }
}

/// A bell that fell onto a slab: only the union encloses the air between them.
TEST(ExportFallen, FailsForTrappedAirInAFiredProcess) {
  const Pot pot = shapes::fallen(stack_of(8, {{20, 0}, {20, 15}, {20, 0}}), 0, {20, 8, 0}, 0.0);
  ExportOptions options;
  for (const bool fired : {false, true}) {
    options.walls.process = process_named("earthenware").value();
    options.walls.process->fired = fired;
    const auto result = exported(pot, {}, options);
    ASSERT_TRUE(result) << result.error().message;
    std::vector<Problem> cavities = problems_of_solid(result->report);
    std::erase_if(cavities, [](const Problem& p) { return p.kind != ProblemKind::cavity; });
    ASSERT_EQ(cavities.size(), 1U);
    EXPECT_EQ(cavities[0].fails, fired);
    EXPECT_NE(cavities[0].text.find("needs a drain hole"), std::string::npos) << cavities[0].text;
  }
}

}  // namespace
}  // namespace clay::solid
