#include "app/studio/exporter.hpp"

#include "tests/app/history/strokes.hpp"
#include "tests/support/run_program.hpp"

#include "claystack/engine/files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <utility>
#include <vector>

namespace clay::studio {
namespace {

using test::claystack;
using test::read_text;
using test::ScratchFolder;
using test::write_text;

/// The pot of a work of two strokes.
history::SharedPot thrown() {
  auto work = history::Work::begin(test::small_scene()).value();
  for (const std::uint64_t seed : {3u, 4u})
    EXPECT_TRUE(work.add(test::small_scene(), test::press_stroke(seed)));
  return work.pot().value();
}

/// A cup with a wall of 8 mm on a floor of 10 mm. `step_mm`: its upper half is wider by as much.
history::SharedPot standing_cup(double step_mm = 0.0) {
  constexpr double kRingMm = 0.5;
  std::vector<Ring> rings;
  for (double up = 0.5 * kRingMm; up < 60.0; up += kRingMm)
    rings.push_back({quanta_from_radius(up < 30.0 ? 40.0 : 40.0 + step_mm),
                     up < 10.0 ? 0 : quanta_from_radius(32.0)});
  Pot pot;
  pot.stack = ClayStack::from_rings(kRingMm, rings, 0, rings.size()).value();
  pot.ledger.initial = pot.stack.volume();
  return std::make_shared<const Pot>(std::move(pot));
}

class Exporting : public ::testing::Test {
 protected:
  Exporter::Outcome outcome() {
    exporter.wait();
    auto taken = exporter.take();
    EXPECT_TRUE(taken);
    return std::move(*taken);
  }
  std::size_t files() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      (void)entry;
      ++count;
    }
    return count;
  }
  ScratchFolder folder;
  history::SharedPot pot = thrown();
  ExportChoices choices{.meshes = {solid::MeshFormat::stl_binary, solid::MeshFormat::obj,
                                   solid::MeshFormat::three_mf, solid::MeshFormat::glb},
                        .step = true,
                        .section = true,
                        .dxf = true,
                        .pdf = true,
                        .report = true,
                        .pot = true,
                        .folder = folder.path().string(),
                        .name = "two",
                        .tolerance_mm = 0.05,
                        .smoothing = solid::Smoothing::fair,
                        .process = "porcelain",
                        .min_wall_mm = 0.0,
                        .shrinkage_percent = 12.0,
                        .material = "celadon"};
  Exporter exporter;
};

TEST_F(Exporting, WritesTheBytesOfTheCommand) {
  exporter.write(pot, choices);
  const auto done = outcome();
  ASSERT_TRUE(done.done) << done.done.error().message;
  EXPECT_EQ(done.paths.size(), 10u);
  std::filesystem::create_directory(folder.path() / "command");
  std::filesystem::create_directory(folder.path() / "given");
  const std::string pot_path = folder.file("given/two.pot.json");
  write_text(pot_path, write_pot(*pot, PotEncoding::json));
  const std::string base = folder.file("command/two");
  const auto ran = claystack(
      "export -q " + pot_path + " " + base + ".stl " + base + ".obj " + base + ".3mf " + base +
      ".glb " + base + ".step " + base + ".svg " + base + ".dxf " + base + ".pdf " + base +
      ".pot.json --report " + base +
      ".report.html --material celadon --tolerance 0.05 --process porcelain --shrinkage 12%");
  // Its wall is too thin for porcelain: the command writes the files and reports the fault.
  ASSERT_EQ(ran.status, 1) << ran.err;
  ASSERT_EQ(done.done->problems.size(), 3u) << "the wall, the lip fillet and the overhang";
  EXPECT_NE(ran.err.find(done.done->problems[0]), std::string::npos);
  for (const char* ending :
       {".stl", ".obj", ".3mf", ".step", ".svg", ".dxf", ".pdf", ".pot.json", ".glb"})
    EXPECT_EQ(read_text(folder.file("two") + ending), read_text(base + ending)) << ending;
  const auto page = [&](const std::string& path) {
    static const std::regex times(R"(\d+\.\d+ ms)");
    std::string text = std::regex_replace(read_text(path), times, "");
    for (const std::string& place : {folder.file("command/"), folder.file("")})
      for (std::size_t at = 0; (at = text.find(place, at)) != text.npos;)
        text.erase(at, place.size());
    return text;
  };
  EXPECT_EQ(page(folder.file("two.report.html")), page(base + ".report.html"));
  EXPECT_NE(page(base + ".report.html").find("Size, weight, capacity and surface"),
            std::string::npos);
  EXPECT_EQ(claystack("check " + folder.file("two.stl")).status, 0);
}

TEST_F(Exporting, WritesTheFinishOfTheCommand) {
  pot = standing_cup();
  choices = {};
  choices.meshes = {solid::MeshFormat::stl_binary};
  choices.folder = folder.path().string();
  choices.name = "cup";
  choices.foot_width_mm = 6.0;
  choices.foot_depth_mm = 2.5;
  choices.floor_fillet_mm = 3.0;
  choices.lip_fillet_mm = 1.5;
  choices.glaze_mm = 0.3;
  choices.shrinkage_percent = 20.0;
  exporter.write(pot, choices);
  const auto done = outcome();
  ASSERT_TRUE(done.done) << done.done.error().message;
  const std::string pot_path = folder.file("given.pot.json"), stl = folder.file("command.stl");
  write_text(pot_path, write_pot(*pot, PotEncoding::json));
  const auto ran = claystack("export -q " + pot_path + " " + stl +
                             " --foot 6x2.5 --floor-fillet 3 --lip-fillet 1.5 --glaze-allowance 0.3"
                             " --shrinkage 20%");
  ASSERT_LE(ran.status, 1) << ran.err;
  EXPECT_EQ(read_text(folder.file("cup.stl")), read_text(stl));
}

TEST_F(Exporting, OpensAClosedCavity) {
  auto closed = std::make_shared<Pot>(*standing_cup());
  std::vector<Ring> rings(closed->stack.rings().begin(), closed->stack.rings().end());
  for (std::size_t i = rings.size() - 10; i < rings.size(); ++i) rings[i].inner2 = 0;
  closed->stack =
      ClayStack::from_rings(closed->stack.ring_height_mm(), rings, 0, rings.size()).value();
  choices = {};
  exporter.preview(closed, choices);
  const auto before = outcome();
  ASSERT_TRUE(before.done);
  EXPECT_EQ(before.done->problems.size(), 1u);
  EXPECT_TRUE(before.done->closed_cavity);
  choices.drain_mm = 5.0;
  exporter.preview(closed, choices);
  const auto after = outcome();
  ASSERT_TRUE(after.done) << after.done.error().message;
  EXPECT_TRUE(after.done->problems.empty()) << after.done->problems[0];
  EXPECT_FALSE(after.done->closed_cavity);
  // The hole of 5 mm through the floor of 10 mm.
  EXPECT_NEAR(before.done->weight_g - after.done->weight_g,
              1e-3 * closed->density_g_cm3 * std::numbers::pi * 2.5 * 2.5 * 10.0, 2e-3);
}

TEST_F(Exporting, WritesTheSizeOfTheCommand) {
  pot = standing_cup();
  choices = {};
  choices.meshes = {solid::MeshFormat::stl_binary, solid::MeshFormat::three_mf};
  choices.pot = true;
  choices.folder = folder.path().string();
  choices.holds_ml = 123.0;
  choices.weighs_g = 345.0;
  choices.height_mm = 61.0;
  choices.diameter_mm = 47.0;
  for (const char* sub : {"command", "given"})
    std::filesystem::create_directory(folder.path() / sub);
  struct Case {
    ExportSize size;
    double shrinkage_percent;
    std::string options;
  };
  for (const Case& c : {Case{ExportSize::capacity, 12.0, "--holds 123ml --fired --shrinkage 12%"},
                        Case{ExportSize::weight, 9.0, "--weighs 345g --fired --shrinkage 9%"},
                        Case{ExportSize::height, 0.0, "--height 61mm"},
                        Case{ExportSize::diameter, 0.0, "--diameter 47mm"}}) {
    choices.name = "cup" + std::to_string(static_cast<int>(c.size));
    choices.size = c.size;
    choices.shrinkage_percent = c.shrinkage_percent;
    exporter.write(pot, choices);
    const auto done = outcome();
    ASSERT_TRUE(done.done) << done.done.error().message;
    if (c.size == ExportSize::capacity) {
      EXPECT_NEAR(done.done->capacity_ml, 123.0, 1e-3);
    }
    if (c.size == ExportSize::weight) {
      EXPECT_NEAR(done.done->weight_g, 345.0, 1e-3);
    }
    const std::string pot_path = folder.file("given/" + choices.name + ".pot.json");
    write_text(pot_path, write_pot(*pot, PotEncoding::json));
    const std::string base = folder.file("command/" + choices.name);
    const auto ran = claystack("export -q " + pot_path + " " + base + ".stl " + base + ".3mf " +
                               base + ".pot.json " + c.options);
    ASSERT_LE(ran.status, 1) << ran.err;
    for (const char* ending : {".stl", ".3mf", ".pot.json"})
      EXPECT_TRUE(read_text(folder.file(choices.name) + ending) == read_text(base + ending))
          << choices.name << ending;
  }
}

TEST_F(Exporting, MarksPlacesOnThePotAsItIsOnTheWheel) {
  pot = standing_cup(20.0);
  choices = {};
  choices.process = "fdm";
  choices.size = ExportSize::height;
  choices.height_mm = 90.0;
  choices.shrinkage_percent = 10.0;
  exporter.preview(pot, choices);
  const auto scaled = outcome();
  ASSERT_TRUE(scaled.done) << scaled.done.error().message;
  EXPECT_NEAR(scaled.done->height_mm, 100.0, 1e-3);
  ASSERT_EQ(scaled.done->marks.size(), 1u) << "the overhang";
  EXPECT_NEAR(scaled.done->marks[0].place_mm.y, 30.0, 0.5);
  EXPECT_GT(scaled.done->marks[0].place_mm.x, 40.0);
  EXPECT_LT(scaled.done->marks[0].place_mm.x, 60.0);
}

TEST_F(Exporting, ReportsASizeThatThePotCannotHave) {
  choices = {};
  choices.size = ExportSize::capacity;
  exporter.preview(pot, choices);  // two parts, with nothing that holds water
  const auto failed = outcome();
  ASSERT_FALSE(failed.done);
  EXPECT_NE(failed.done.error().message.find("capacity"), std::string::npos)
      << failed.done.error().message;
}

TEST_F(Exporting, PreviewReportsTheFilesInAdvance) {
  choices.section = choices.dxf = choices.pdf = choices.report = choices.pot = false;
  exporter.preview(pot, choices);
  const auto previewed = outcome();
  ASSERT_TRUE(previewed.done) << previewed.done.error().message;
  EXPECT_EQ(files(), 0u);
  exporter.write(pot, choices);
  ASSERT_TRUE(outcome().done);
  const auto& meshes = previewed.done->meshes;
  ASSERT_EQ(meshes.size(), 4u);
  EXPECT_EQ(meshes[0].bytes, std::filesystem::file_size(folder.file("two.stl")));
  EXPECT_EQ(meshes[1].bytes, std::filesystem::file_size(folder.file("two.obj")));
  EXPECT_EQ(meshes[2].bytes, std::filesystem::file_size(folder.file("two.3mf")));
  EXPECT_EQ(meshes[3].bytes, std::filesystem::file_size(folder.file("two.glb")));
}

TEST_F(Exporting, NewestPreviewWins) {
  for (int i = 1; i <= 20; ++i) {
    choices.tolerance_mm = 0.01 * i;
    exporter.preview(pot, choices);
  }
  EXPECT_EQ(outcome().choices.tolerance_mm, choices.tolerance_mm);
  EXPECT_FALSE(exporter.take());
}

TEST_F(Exporting, APreviewDoesNotDropTheOutcomeOfFiles) {
  exporter.write(pot, choices);
  exporter.wait();
  EXPECT_EQ(exporter.running(), Exporter::Kind::files) << "its outcome has not been taken";
  exporter.preview(pot, choices);
  EXPECT_EQ(outcome().kind, Exporter::Kind::files);
  EXPECT_FALSE(exporter.running());
}

TEST_F(Exporting, APreviewDoesNotReplaceFilesThatWait) {
  choices.tolerance_mm = 0.001;
  exporter.preview(pot, choices);
  while (exporter.stage().empty() && exporter.busy()) std::this_thread::yield();
  exporter.write(pot, choices);
  EXPECT_EQ(exporter.running(), Exporter::Kind::files);
  exporter.preview(pot, choices);
  EXPECT_EQ(outcome().kind, Exporter::Kind::files);
  EXPECT_EQ(files(), 10u);
}

TEST_F(Exporting, CancelledExportLeavesNoFile) {
  choices.tolerance_mm = 0.001;
  exporter.write(pot, choices);
  // The first stage shows that the export runs; its files are open but not yet named.
  while (exporter.stage().empty() && exporter.busy()) std::this_thread::yield();
  exporter.cancel();
  const auto cancelled = outcome();
  EXPECT_TRUE(cancelled.cancelled);
  EXPECT_FALSE(cancelled.done);
  EXPECT_EQ(files(), 0u);
}

TEST_F(Exporting, CancellingFilesThatWaitIsReported) {
  choices.tolerance_mm = 0.001;
  exporter.preview(pot, choices);
  while (exporter.stage().empty() && exporter.busy()) std::this_thread::yield();
  exporter.write(pot, choices);
  exporter.cancel();
  const auto cancelled = outcome();
  EXPECT_EQ(cancelled.kind, Exporter::Kind::files);
  EXPECT_TRUE(cancelled.cancelled);
  EXPECT_EQ(files(), 0u);
}

TEST_F(Exporting, LeavesAllFilesOrNoneAtEveryCancellationPoint) {
  choices.step = choices.dxf = choices.pdf = choices.report = false;
  solid::ExportRequest request = job_of(choices, *pot).value().request;
  std::size_t checks = 0, all = 0;
  std::mutex mutex;
  for (std::size_t limit = 0; all == 0; ++limit) {
    checks = 0;
    request.options.cancelled = [&] {
      const std::lock_guard lock(mutex);
      return ++checks > limit;
    };
    const auto done = solid::export_files(*pot, request);
    EXPECT_EQ(files(), done ? 6u : 0u) << limit;
    if (done) all = checks;
  }
  EXPECT_GT(all, 10u);
}

TEST_F(Exporting, ScalingToASizeCanBeCancelled) {
  choices.size = ExportSize::height;
  choices.height_mm = 80.0;
  ASSERT_TRUE(job_of(choices, *pot));
  const auto cancelled = job_of(choices, *pot, [] { return true; });
  ASSERT_FALSE(cancelled);
  EXPECT_NE(cancelled.error().message.find("cancelled"), std::string::npos)
      << cancelled.error().message;
}

TEST_F(Exporting, ReportsAnUnwritableFile) {
  choices.folder = folder.file("nowhere");
  exporter.write(pot, choices);
  const auto failed = outcome();
  ASSERT_FALSE(failed.done);
  EXPECT_FALSE(failed.cancelled);
  EXPECT_EQ(failed.done.error().kind, ErrorKind::io);
  EXPECT_NE(failed.done.error().message.find("nowhere"), std::string::npos);
}

TEST_F(Exporting, ReportsAThinWallWithItsPlace) {
  choices.min_wall_mm = 500.0;
  choices.shrinkage_percent = 0.0;
  exporter.preview(pot, choices);
  const auto previewed = outcome();
  ASSERT_TRUE(previewed.done) << previewed.done.error().message;
  ASSERT_FALSE(previewed.done->marks.empty());
  const Mark& mark = previewed.done->marks[0];
  EXPECT_EQ(mark.text, previewed.done->problems.at(0));
  EXPECT_NE(mark.text.find("thin wall"), std::string::npos);
  EXPECT_GE(mark.place_mm.y, 0.0);
  EXPECT_LE(mark.place_mm.y, pot->stack.height_mm() + 1e-9);
}

TEST_F(Exporting, CountsTheLimitsThatFailAndListsThemFirst) {
  exporter.preview(pot, choices);
  const auto previewed = outcome();
  ASSERT_TRUE(previewed.done) << previewed.done.error().message;
  EXPECT_EQ(previewed.done->failed, 1u) << "the wall; lip and overhang are warnings";
  ASSERT_FALSE(previewed.done->problems.empty());
  EXPECT_NE(previewed.done->problems[0].find("thin wall"), std::string::npos);
  EXPECT_EQ(failed_text(1), "1 limit failed");
  EXPECT_EQ(failed_text(2), "2 limits failed");
}

TEST_F(Exporting, StatesTheWidthOfTheCommand) {
  choices.shrinkage_percent = 0.0;
  exporter.preview(pot, choices);
  const auto previewed = outcome();
  ASSERT_TRUE(previewed.done) << previewed.done.error().message;
  write_text(folder.file("two.pot.json"), write_pot(*pot, PotEncoding::json));
  const auto ran = claystack("export --json " + folder.file("two.pot.json") + " " +
                             folder.file("two.stl") + " --tolerance 0.05 --process porcelain");
  const auto numbers = nlohmann::json::parse(ran.out).at("maker").at("thrown");
  EXPECT_DOUBLE_EQ(previewed.done->diameter_mm, numbers.at("diameter_mm").get<double>());
  EXPECT_DOUBLE_EQ(previewed.done->height_mm, numbers.at("height_mm").get<double>());
}

TEST_F(Exporting, ListsExistingFiles) {
  EXPECT_TRUE(standing_files(choices).empty());
  write_text(folder.file("two.obj"), "old");
  EXPECT_EQ(standing_files(choices), std::vector{folder.file("two.obj")});
}

}  // namespace
}  // namespace clay::studio
