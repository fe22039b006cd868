// The outcome for each file of a request, and the file names in errors.

#include "claystack/core/atomic_file.hpp"
#include "claystack/export/job.hpp"
#include "tests/export/formats/refused.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>

#include <stdlib.h>
#include <cmath>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace clay::solid {
namespace {

using samples::refused;
using shapes::pot_of;
using shapes::stack_of;

/// A disk that is full after the first 100 bytes.
class FullStore final : public FileStore {
 public:
  Result<void> write(std::span<const std::byte> bytes) override {
    written_ += bytes.size();
    if (written_ <= 100) return {};
    return failure(ErrorKind::io, "no space left");
  }
  [[nodiscard]] bool rereadable() const noexcept override { return false; }
  Result<void> read_at(std::uint64_t, std::span<std::byte>) const override {
    return failure(ErrorKind::io, "gone");
  }

 private:
  std::size_t written_ = 0;
};

/// A disk that returns one bit changed: in the last byte of each part that is read again.
class FaultyStore final : public FileStore {
 public:
  Result<void> write(std::span<const std::byte> bytes) override { return held_.write(bytes); }
  [[nodiscard]] bool rereadable() const noexcept override { return true; }
  Result<void> read_at(std::uint64_t offset, std::span<std::byte> bytes) const override {
    return held_.read_at(offset, bytes).map([&] { bytes.back() ^= std::byte{1}; });
  }

 private:
  MemoryStore held_;
};

/// Also where the bytes were decoded and proved before they were written.
TEST(ExportErrors, ReportBytesThatADiskHasChanged) {
  Pot fallen = pot_of(shapes::vase(50));
  fallen.collapse = Collapse{20, {50, 40, 0}, {0, 0, 1}, 1.0, 12.0};
  const auto expect_found = [](const Pot& pot, MeshFormat format) {
    FaultyStore store;
    const auto done = run_export(pot, {{format, &store, "out"}}, {});
    ASSERT_FALSE(done) << name_of(format);
    EXPECT_EQ(done.error().kind, ErrorKind::io);
    EXPECT_EQ(done.error().message,
              "out: " + std::string(name_of(format)) +
                  " as written: the bytes read back differ from those written");
  };
  expect_found(pot_of(shapes::vase(50)), MeshFormat::three_mf);
  for (const MeshFormat format : {MeshFormat::stl_binary, MeshFormat::obj})
    expect_found(fallen, format);
}

/// The ending selects the kind of drawing: standard output has none.
TEST(ExportErrors, ADrawingWithoutItsEndingIsRefused) {
  for (const FileKind kind : {FileKind::section, FileKind::wall_table, FileKind::step})
    for (const char* path : {"-", "pot", "pot.stl"}) {
      ExportRequest request;
      request.files.push_back({path, kind});
      const auto done = export_files(pot_of(shapes::vase(50)), request);
      ASSERT_FALSE(done) << path;
      EXPECT_EQ(done.error().kind, ErrorKind::bad_input);
      EXPECT_NE(done.error().message.find("expected a name that ends in"), std::string::npos)
          << done.error().message;
    }
}

TEST(ExportErrors, NameTheFileOrThePot) {
  ExportOptions options;
  options.source = "p.pot.json";
  FullStore full;
  for (const MeshFormat format : {MeshFormat::stl_binary, MeshFormat::obj}) {
    const auto unwritten =
        run_export(pot_of(shapes::vase(50)), {{format, &full, "out.mesh"}}, options);
    ASSERT_FALSE(unwritten);
    EXPECT_EQ(unwritten.error().message, "out.mesh: no space left");
  }
  MemoryStore store;
  const auto no_solid = run_export(pot_of(stack_of(2.0, {{5, 0}, {9, 5}})),
                                   {{MeshFormat::stl_binary, &store, "out.stl"}}, options);
  ASSERT_FALSE(no_solid);
  EXPECT_EQ(no_solid.error().message.find("p.pot.json: rings 0 and 1"), 0u)
      << no_solid.error().message;
}

class ExportFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = testing::TempDir() + "export_files_XXXXXX";
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

TEST_F(ExportFiles, AreListedInTheOrderOfTheRequest) {
  ExportRequest request;
  request.files.push_back(file_request(path("a.svg")).value());
  request.files.push_back(file_request(path("a.obj")).value());
  request.files.push_back({.path = path("note"), .kind = FileKind::given, .bytes = "clay"});
  request.files.push_back(file_request(path("a.csv")).value());
  request.files.push_back(file_request(path("a.stl")).value());
  request.certificates = true;
  request.report_path = path("report");
  request.report_text = [](const ExportReport& report) {
    return std::to_string(report.files.size());
  };
  const auto report = export_files(pot_of(shapes::vase(50)), request);
  ASSERT_TRUE(report) << report.error().message;
  ASSERT_EQ(report->files.size(), request.files.size());
  for (std::size_t i = 0; i < request.files.size(); ++i) {
    EXPECT_EQ(report->files[i].path, request.files[i].path);
    EXPECT_EQ(report->files[i].kind, request.files[i].kind);
    EXPECT_EQ(report->files[i].bytes, std::filesystem::file_size(request.files[i].path));
  }
  EXPECT_EQ(read_file(path("note")).value(), "clay");
  EXPECT_EQ(read_file(path("report")).value(), "5");
  const auto certificate =
      parse_certificate(read_file(path("a.stl.certificate.json")).value(), "certificate").value();
  EXPECT_TRUE(verify_certificate(certificate, read_file(path("a.stl")).value(), "a.stl"));
  EXPECT_EQ(certificate, *report->files[4].certificate);
}

TEST_F(ExportFiles, StraightWallsForCadAreExact) {
  std::vector<shapes::Radii> rings(20, {30.0, 29.0});
  rings.front() = {30.0, 0.0};
  ExportRequest request;
  request.files.push_back(file_request(path("a.step")).value());
  request.options.walls.min_wall_mm = 1.0;
  for (const StepWalls walls : {StepWalls::spline, StepWalls::lines}) {
    request.options.step_walls = walls;
    const auto report = export_files(pot_of(stack_of(1.0, rings)), request);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_NEAR(report->files.at(0).step->min_wall_mm, 1.0, 1e-8);
    EXPECT_FALSE(thin_wall_of(*report)) << *thin_wall_of(*report);
  }
}

/// Curves lie within the tolerance of the walls, which they may thin on both sides.
TEST_F(ExportFiles, CurvesForCadKeepAWallAtTheLimit) {
  std::vector<shapes::Radii> rings;
  for (int i = 0; i < 200; ++i) {
    const double outside = 30.0 + 3.0 * std::sin(0.05 * i);
    rings.push_back({outside, i < 5 ? 0.0 : outside - 1.5});
  }
  const Pot pot = pot_of(stack_of(0.5, rings));
  ExportRequest request;
  request.files.push_back(file_request(path("a.step")).value());
  request.options.tolerance_mm = 0.3;
  request.options.segments = 4096;  // facets that take little off a wall
  const auto coarse = export_files(pot, request);
  ASSERT_TRUE(coarse) << coarse.error().message;
  request.options.walls.min_wall_mm = coarse->walls.min_wall_mm;
  const auto report = export_files(pot, request);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_FALSE(thin_wall_of(*report)) << *thin_wall_of(*report);
  EXPECT_GE(report->files.at(0).step->min_wall_mm, report->walls.limit->least_mm());
  // Only the limit asks for that.
  EXPECT_LT(coarse->files.at(0).step->min_wall_mm, report->walls.limit->least_mm());
}

/// A smooth outside and a rough bore, so that their curves differ: walls from `thinnest_mm` to
/// `swing_mm` more, in pieces.
Pot rough_bore(double thinnest_mm, double swing_mm) {
  std::vector<shapes::Radii> rings(4, {20.0, 0.0});
  for (int i = 0; i < 40; ++i) {
    const double outside = 20.0 + swing_mm * std::sin(0.25 * i);
    rings.push_back({outside, outside - thinnest_mm - swing_mm * std::fmod(0.37 * i * i, 1.0)});
  }
  return pot_of(stack_of(0.5, rings));
}

TEST_F(ExportFiles, CurvesForCadThatCrossGetCloser) {
  ExportRequest request;
  request.files.push_back(file_request(path("a.step")).value());
  request.options.allow_pieces = true;
  const auto report = export_files(rough_bore(0.007, 0.05), request);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_LE(report->files.at(0).max_error_mm, 0.25 * request.options.tolerance_mm);
  EXPECT_GT(report->files.at(0).step->min_wall_mm, 0.0);
}

TEST_F(ExportFiles, CurvesForCadHaveABoundOfTheirWallHoweverThin) {
  ExportRequest request;
  request.files.push_back(file_request(path("a.step")).value());
  request.options.allow_pieces = true;
  const auto report = export_files(rough_bore(1e-4, 0.05), request);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_GT(report->files.at(0).step->min_wall_mm, 0.5e-4);
  EXPECT_LE(report->files.at(0).step->min_wall_mm, 1e-4);
}

TEST_F(ExportFiles, CurvesForCadThatAlwaysCrossAreRefusedWithRemedies) {
  ExportRequest request;
  request.files.push_back(file_request(path("a.step")).value());
  request.options.allow_pieces = true;
  EXPECT_TRUE(refused(export_files(rough_bore(1e-6, 2.0), request), ErrorKind::unsound,
                      "straight lines instead of curves are exact"));
  EXPECT_FALSE(std::filesystem::exists(path("a.step")));
  request.options.step_walls = StepWalls::lines;
  const auto lines = export_files(rough_bore(1e-6, 2.0), request);
  EXPECT_TRUE(lines) << lines.error().message;
}

TEST_F(ExportFiles, ADrawingShowsTheDrain) {
  // A cavity of 4 mm between a solid foot and a lid.
  const Pot pot = pot_of(stack_of(2.0, {{30, 0}, {30, 20}, {30, 20}, {30, 0}}));
  ExportRequest request;
  request.files.push_back(file_request(path("a.svg")).value());
  request.files.push_back(file_request(path("a.stl")).value());
  request.options.drain_mm = 8.0;
  const auto report = export_files(pot, request);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_GT(report->prepared.drilled_mm3, 0.0);
  EXPECT_TRUE(report->section.shapes()[0].cavities.empty());
  Pot drained = pot;
  drained.stack = stack_of(2.0, {{30, 4}, {30, 20}, {30, 20}, {30, 0}});
  ExportRequest again;
  again.files.push_back(file_request(path("b.svg")).value());
  ASSERT_TRUE(export_files(drained, again));
  EXPECT_EQ(read_file(path("a.svg")).value(), read_file(path("b.svg")).value());
}

TEST_F(ExportFiles, WritesNoneIfOneCannotBeWritten) {
  ExportRequest request;
  request.files.push_back(file_request(path("a.stl")).value());
  request.files.push_back(file_request(path("nowhere/a.obj")).value());
  request.options.source = "p.pot.json";
  const auto failed = export_files(pot_of(shapes::vase(20)), request);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().kind, ErrorKind::io);
  EXPECT_EQ(failed.error().message.find("p.pot.json"), std::string::npos);
  EXPECT_NE(failed.error().message.find("a.obj"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path("a.stl")));
}

TEST_F(ExportFiles, AFallenPotHasNoCertificateAndNoDrain) {
  Pot pot = pot_of(shapes::vase(60));
  pot.collapse = Collapse{20, {50, 70, 0}, {0, 0, 1}, 1.0, 12.0};
  ExportRequest request;
  request.files.push_back(file_request(path("a.stl")).value());
  request.certificates = true;
  EXPECT_TRUE(refused(export_files(pot, request), ErrorKind::bad_input, "certificate: "));
  request.certificates = false;
  request.options.drain_mm = 5.0;
  EXPECT_TRUE(refused(export_files(pot, request), ErrorKind::bad_input, "drain"));
  EXPECT_FALSE(std::filesystem::exists(path("a.stl")));
}

/// Before any work: its cancel function, called in each stage, would end the job with another
/// error.
TEST_F(ExportFiles, AFallenPotHasNoSheetAndNoWalls) {
  Pot pot = pot_of(shapes::vase(60));
  pot.collapse = Collapse{20, {50, 70, 0}, {0, 0, 1}, 1.0, 12.0};
  for (const char* name : {"a.pdf", "a.dxf", "a.csv", "a.step"}) {
    ExportRequest request;
    request.files.push_back(file_request(path("a.stl")).value());
    request.files.push_back(file_request(path(name)).value());
    request.options.cancelled = [] { return true; };
    EXPECT_TRUE(refused(export_files(pot, request), ErrorKind::bad_input,
                        path(name) + ": expected a standing pot"));
  }
}

TEST_F(ExportFiles, RefusesTwoRequestsForOneFile) {
  ExportRequest request;
  request.files.push_back(file_request(path("a.stl")).value());
  request.files.push_back({path("./a.stl"), FileKind::mesh, MeshFormat::obj});
  EXPECT_TRUE(refused(export_files(pot_of(shapes::vase(20)), request), ErrorKind::bad_input,
                      "expected one request for each file, found two"));
  EXPECT_FALSE(std::filesystem::exists(path("a.stl")));
}

/// The certificate and the report are outputs too.
TEST_F(ExportFiles, RefusesAnOutputThatWouldReplaceAnotherOne) {
  ExportRequest request;
  request.files.push_back(file_request(path("a.stl")).value());
  const auto expect_refused = [&](const std::string& name) {
    EXPECT_TRUE(refused(export_files(pot_of(shapes::vase(20)), request), ErrorKind::bad_input,
                        name + ": expected one request for each file, found two"));
    EXPECT_FALSE(std::filesystem::exists(path("a.stl")));
  };
  request.report_text = [](const ExportReport&) { return std::string("report"); };
  request.report_path = path("a.stl");
  expect_refused(request.report_path);
  request.certificates = true;
  request.report_path = path("a.stl.certificate.json");
  expect_refused(request.report_path);
  request.report_path.clear();
  request.files.push_back({path("a.stl.certificate.json"), FileKind::given});
  expect_refused(path("a.stl.certificate.json"));
}

TEST_F(ExportFiles, RefusesAReportWithoutItsText) {
  ExportRequest request;
  request.report_path = path("a.html");
  EXPECT_TRUE(refused(export_files(pot_of(shapes::vase(20)), request), ErrorKind::bad_input,
                      "expected a function for the text, found none"));
}

TEST(FileRequests, FollowTheExtension) {
  EXPECT_EQ(file_request("a.drc")->format, MeshFormat::drc);
  EXPECT_EQ(file_request("a.svg")->kind, FileKind::section);
  EXPECT_EQ(file_request("a.csv")->kind, FileKind::wall_table);
  EXPECT_EQ(file_request("a.PLY")->format, MeshFormat::ply);
  for (const char* path : {"a.off", "a.blend"})
    EXPECT_TRUE(refused(file_request(path), ErrorKind::bad_input, ".svg"));
}

}  // namespace
}  // namespace clay::solid
