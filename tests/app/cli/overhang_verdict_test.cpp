// One overhang for one pot: of the pot, of its export and of the exported mesh.

#include "claystack/engine/files.hpp"
#include "tests/export/solid/shapes.hpp"
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <regex>
#include <utility>
#include <vector>

namespace clay::test {
namespace {

struct Found {
  double angle_deg = -1.0;
  bool passes = false;
};

std::ostream& operator<<(std::ostream& out, const Found& found) {
  return out << found.angle_deg << (found.passes ? " passes" : " does not pass");
}

Found exported(const std::string& pot, const std::string& stl, const std::string& options) {
  const Ran ran = claystack("export --json --process fdm " + options + ' ' + pot + ' ' + stl);
  const auto json = ran.json();
  if (!json.contains("overhang")) return {};
  const auto& overhang = json.at("overhang");
  return {overhang.at("angle_deg"), overhang.at("passes")};
}

/// Empty if the file has no check of the process.
std::optional<Found> checked(const std::string& file) {
  const Ran ran = claystack("check --json --process fdm " + file);
  const auto json = ran.json();
  for (const auto& check : json.at("checks")) {
    if (check.at("check") != "process") continue;
    const std::string text = check.at("text");
    std::smatch angle;
    if (!std::regex_search(text, angle, std::regex("overhang (?:of )?([0-9.]+) degrees"))) continue;
    return Found{std::stod(angle[1]), check.at("verdict") == "pass"};
  }
  return std::nullopt;
}

/// Angles of passing files are printed as whole degrees; facets change them a little.
void expect_same(const Found& a, const std::optional<Found>& b, const std::string& what) {
  ASSERT_TRUE(b) << what;
  EXPECT_EQ(a.passes, b->passes) << what << ": " << a << ", " << *b;
  EXPECT_NEAR(a.angle_deg, b->angle_deg, 1.2) << what;
}

/// Returns the overhang.
Found expect_one_overhang(const std::string& pot, const std::string& options = {}) {
  const std::string stl = pot + ".stl";
  const Found found = exported(pot, stl, options);
  expect_same(found, checked(stl), pot + options + ": mesh");
  // A pot is checked with the options that export has by default.
  if (const auto whole = checked(pot); whole && options.empty())
    expect_same(found, whole, pot + ": pot");
  return found;
}

std::string write(const ScratchFolder& folder, ClayStack stack) {
  std::string path = folder.file("made.pot.json");
  Pot pot = solid::shapes::pot_of(std::move(stack));
  pot.ledger.initial = pot.stack.volume();
  write_text(path, write_pot(pot, PotEncoding::json));
  return path;
}

TEST(OverhangVerdict, OfSamplePotsIsThatOfTheirMeshes) {
  for (const std::string name : {"bowl", "bottle", "collapse", "cylinder", "vase"}) {
    const ScratchFolder folder;
    const std::string pot = folder.file("thrown.pot.json");
    ASSERT_EQ(claystack("throw -q " + sample(name + ".scene.json") + " -s " +
                        sample(name + ".session") + " -o " + pot)
                  .status,
              0);
    const Found found = expect_one_overhang(pot);
    if (name == "collapse") {
      EXPECT_FALSE(found.passes) << "a wall on its side";
      EXPECT_FALSE(checked(pot)) << "a pot that fell is not examined";
    }
    expect_one_overhang(pot, "--smooth none --segments 32");
  }
}

TEST(OverhangVerdict, OfDrawnPotsIsThatOfTheirMeshes) {
  for (const std::string drawing : {"jug.svg", "bowl.dxf", "tumbler.csv --wall 6"}) {
    const ScratchFolder folder;
    const std::string pot = folder.file("drawn.pot.json");
    ASSERT_EQ(claystack("import -q " + sample("drawings/" + drawing) + " -o " + pot).status, 0);
    expect_one_overhang(pot);
  }
}

TEST(OverhangVerdict, OfStepsIsTheirLean) {
  for (const double lean_deg : {30.0, 60.0, 70.0, 80.0}) {
    const ScratchFolder folder;
    std::vector<solid::shapes::Radii> rings;
    const double aside = 0.25 * std::tan(lean_deg * std::numbers::pi / 180.0);
    for (int i = 0; i < 160; ++i)
      rings.push_back({30.0 + i * aside, i < 12 ? 0.0 : 18.0 + i * aside});
    const std::string pot = write(folder, solid::shapes::stack_of(0.25, rings));
    for (const std::string options : {"", "--smooth none --segments 32"}) {
      const Found found = expect_one_overhang(pot, options);
      // Smoothing rounds the ends of the wall.
      EXPECT_GT(found.angle_deg, lean_deg - 0.3) << options;
      EXPECT_LT(found.angle_deg, lean_deg + (options.empty() ? 5.0 : 0.3)) << options;
      EXPECT_EQ(found.passes, lean_deg < 45.0);
    }
  }
}

TEST(OverhangVerdict, OfALedgeIsThatOfItsMesh) {
  for (const double width_mm : {0.1, 0.5, 1.0, 1.5, 1.7, 1.79, 1.9, 2.5}) {
    const ScratchFolder folder;
    std::vector<solid::shapes::Radii> rings;
    for (int i = 0; i < 40; ++i)
      rings.push_back({i < 20 ? 40.0 : 40.0 + width_mm, i < 5 ? 0.0 : 34.0});
    const std::string pot = write(folder, solid::shapes::stack_of(1.0, rings));
    const Found stepped = expect_one_overhang(pot, "--smooth none");
    EXPECT_EQ(stepped.passes, width_mm <= 0.5) << width_mm << ": " << stepped;
    expect_one_overhang(pot);
  }
}

TEST(OverhangVerdict, OfAWallWithFineStepsPasses) {
  const ScratchFolder folder;
  std::vector<solid::shapes::Radii> rings;
  for (int i = 0; i < 400; ++i) {
    const double ripple = 0.04 * (i % 3);
    rings.push_back({40.0 + ripple, i < 40 ? 0.0 : 34.0});
  }
  const std::string pot = write(folder, solid::shapes::stack_of(0.1, rings));
  EXPECT_TRUE(expect_one_overhang(pot, "--smooth none --segments 32").passes);
}

}  // namespace
}  // namespace clay::test
