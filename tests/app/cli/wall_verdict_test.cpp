// All commands state the same wall for one pot. CLAYSTACK_WALL_POTS=500 throws 500 pots.

#include "claystack/engine/files.hpp"
#include "claystack/export/walls.hpp"
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iomanip>
#include <random>
#include <sstream>
#include <utility>
#include <vector>

namespace clay::test {
namespace {

std::size_t pots() {
  const char* const text = std::getenv("CLAYSTACK_WALL_POTS");
  return text ? std::strtoul(text, nullptr, 10) : 8;
}

/// A hollow lump and one press of a ball against it, from outside or from inside, upwards or
/// downwards.
void throw_at_random(std::mt19937_64& random, const std::string& scene_path,
                     const std::string& session_path) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  SceneSpec scene;
  scene.name = "pot";
  scene.lump.rings = static_cast<std::size_t>(uniform(40, 160));
  scene.lump.max_rings = 2 * scene.lump.rings;
  scene.lump.ring_height_mm = uniform(0.3, 1.0);
  scene.lump.outer_radius_mm = uniform(25, 60);
  const double wall = uniform(3, 15);
  scene.lump.inner_radius_mm = scene.lump.outer_radius_mm - wall;
  const double ball = uniform(3, 12);
  scene.tool.shape = SphereSpec{ball};
  if (uniform(0, 1) < 0.7) scene.clay = ClaySpec{};
  const bool inside = uniform(0, 1) < 0.4 && scene.lump.inner_radius_mm > ball + 1.0;
  const double depth = uniform(0.2, 0.9) * wall;
  const double height = static_cast<double>(scene.lump.rings) * scene.lump.ring_height_mm;
  const double from = uniform(0, height), to = uniform(0, 1.2 * height);
  Session session{scene.name, hash_of(scene), {}, false};
  for (int k = 0; k <= 400; ++k) {
    const double part = k / 400.0, in = depth * std::min(1.0, 2.0 * part);
    const double d =
        inside ? scene.lump.inner_radius_mm - ball + in : scene.lump.outer_radius_mm + ball - in;
    session.poses.push_back(quantized({1000 * k, {d, from + part * (to - from), 0.0}}));
  }
  write_text(scene_path, write_scene(scene));
  write_text(session_path, write_session(session));
}

/// The smallest limit that such a wall does not meet, for walls above 0.1 mm.
double just_above(double wall_mm) {
  return std::max(wall_mm / 0.999, std::min(wall_mm, 1.0) + 1e-3) * (1.0 + 1e-9);
}

TEST(WallVerdict, IsTheSameOfThrowExportCheckAndCertificate) {
  std::mt19937_64 random(20'261'123);
  std::size_t passed = 0, failed = 0;
  for (std::size_t k = 0; k < pots(); ++k) {
    const ScratchFolder folder;
    const std::string scene = folder.file("p.scene.json"), pot = folder.file("p.pot.json"),
                      stl = folder.file("p.stl");
    throw_at_random(random, scene, folder.file("p.session"));
    const Ran thrown = claystack("throw --json " + scene + " -o " + pot);
    ASSERT_EQ(thrown.status, 0) << thrown.err;
    if (thrown.json().at("min_wall_mm").is_null()) continue;
    const double wall = thrown.json().at("min_wall_mm");
    const Ran plain = claystack("export --json " + pot + " " + stl);
    EXPECT_EQ(plain.json().at("min_wall_mm"), wall);
    EXPECT_EQ(claystack("check --json " + pot).json().at("min_wall_mm"), wall);
    // Rays see no wall that is thinner, apart from rounding to float32. In a lump as low as it is
    // thick, no disc has three diameters of boundary: there the wall is the largest disc, and a ray
    // may be shorter.
    const auto lump = nlohmann::json::parse(read_text(scene)).at("lump");
    const double height = lump.at("rings").get<double>() * lump.at("ring_height_mm").get<double>();
    const auto sampled = claystack("check --json --min-wall 0.001 " + stl).json();
    if (const auto least = sampled.at("wall_sampled").at("least_mm");
        !least.is_null() && 3.0 * wall < height) {
      EXPECT_GE(least, wall - 1e-4) << read_text(scene);
    }
    // A limit that the pot meets anyway, or cannot meet, changes nothing. Between these, the pot
    // meets the limit with less smoothing.
    const std::string unlimited = read_text(stl);
    for (const double asked : {wall, just_above(wall)}) {
      std::ostringstream limit_text;
      limit_text << " --min-wall " << std::setprecision(17) << asked << ' ';
      const std::string limit = limit_text.str();
      const Ran exported = claystack("export --json --certificate" + limit + pot + " " + stl);
      const Ran checked = claystack("check --json" + limit + pot);
      solid::WallLimit asked_limit;
      asked_limit.min_wall_mm = asked;
      const int expected = asked_limit.met_by(exported.json().at("min_wall_mm")) ? 0 : 1;
      EXPECT_EQ(exported.status, expected) << exported.out << exported.err;
      EXPECT_EQ(checked.status, expected) << checked.out;
      ++(expected == 0 ? passed : failed);
      EXPECT_EQ(exported.json().at("min_wall_mm"), checked.json().at("min_wall_mm"));
      const Ran proved =
          claystack("check --json --certificate " + stl + ".certificate.json " + stl);
      EXPECT_EQ(proved.status, 0) << proved.out;
      const auto bounds = proved.json().at("certificate").at("wall_mm");
      EXPECT_EQ(bounds.at(0), exported.json().at("min_wall_mm"));
      EXPECT_GE(bounds.at(1), bounds.at(0));
      const double with_limit = exported.json().at("min_wall_mm");
      EXPECT_GE(with_limit, wall);
      EXPECT_EQ(read_text(stl) == unlimited, asked == wall || expected == 1);
    }
  }
  EXPECT_GE(2 * passed, pots());
  EXPECT_GE(2 * failed, pots());
}

TEST(WallVerdict, AWallDrawnAtTheLimitPasses) {
  const ScratchFolder folder;
  const std::string pot = folder.file("cup.pot.json"), stl = folder.file("cup.stl");
  std::vector<Ring> rings(80, {quanta_from_radius(40.0), quanta_from_radius(36.0)});
  for (std::size_t i = 0; i < 6; ++i) rings[i].inner2 = 0;
  Pot cup;
  cup.stack = ClayStack::from_rings(1.0, rings, 0, rings.size()).value();
  cup.ledger.initial = cup.stack.volume();
  write_text(pot, write_pot(cup, PotEncoding::json));
  for (const auto& [limit, status] : {std::pair{"4", 0}, {"4.003", 0}, {"4.01", 1}}) {
    EXPECT_EQ(claystack("export -q " + pot + " " + stl + " --min-wall " + limit).status, status)
        << limit;
    EXPECT_EQ(claystack("check -q " + pot + " --min-wall " + limit).status, status) << limit;
    EXPECT_EQ(claystack("check -q " + stl + " --min-wall " + limit).status, status) << limit;
  }
}

/// A tube of 1.5 mm, whose wall with its facets is a little less: no line rounds it up to 1.500.
TEST(WallVerdict, IsRoundedDownByEveryCommandThatPrintsIt) {
  const ScratchFolder folder;
  const std::string pot = folder.file("tube.pot.json"), png = folder.file("tube.png");
  Pot tube;
  tube.stack =
      ClayStack::from_rings(1.0, {80, {quanta_from_radius(30.0), quanta_from_radius(28.5)}}, 0, 80)
          .value();
  tube.ledger.initial = tube.stack.volume();
  write_text(pot, write_pot(tube, PotEncoding::json));
  const Ran checked = claystack("check " + pot);
  const double wall_mm = claystack("check --json " + pot).json().at("min_wall_mm");
  ASSERT_GT(wall_mm, 1.4995);
  ASSERT_LT(wall_mm, 1.5);
  EXPECT_NE(checked.out.find("minimum wall 1.499 mm"), std::string::npos) << checked.out;
  const Ran drawn = claystack("render --wall-map --size 64x64 " + pot + " -o " + png);
  EXPECT_NE(drawn.out.find("thinnest 1.499"), std::string::npos) << drawn.out << drawn.err;
}

// Inside and outside differ by the smallest step of a pot file; float32 has no such step.
TEST(WallVerdict, OfALipThatNoMeshFileCanHoldIsTheSameOfCheckAndExport) {
  const ScratchFolder folder;
  const std::string pot = folder.file("cup.pot.json"), stl = folder.file("cup.stl");
  const Quanta outer2 = quanta_from_radius(30.0);
  std::vector<Ring> rings(100, {outer2, quanta_from_radius(27.0)});
  for (std::size_t i = 0; i < 6; ++i) rings[i].inner2 = 0;
  for (std::size_t i = 95; i < 100; ++i) rings[i].inner2 = outer2 - 1;
  Pot cup;
  cup.stack = ClayStack::from_rings(1.0, rings, 0, rings.size()).value();
  cup.ledger.initial = cup.stack.volume();
  write_text(pot, write_pot(cup, PotEncoding::json));
  const Ran exported = claystack("export " + pot + " " + stl), checked = claystack("check " + pot);
  EXPECT_EQ(exported.status, 1);
  EXPECT_NE(exported.err.find("mm is too thin for a mesh file"), std::string::npos) << exported.err;
  EXPECT_EQ(checked.status, 1) << checked.out;
  EXPECT_NE(checked.out.find("no process allows less than"), std::string::npos) << checked.out;
}

// A lip that tapers to 0.23 mm.
TEST(WallVerdict, OfAMeshWithACertificateIsThatOfTheCertificate) {
  const ScratchFolder folder;
  const std::string svg = folder.file("p.svg"), pot = folder.file("p.pot.json"),
                    stl = folder.file("p.stl"), package = folder.file("p.3mf");
  write_text(svg,
             "<svg xmlns='http://www.w3.org/2000/svg' width='80mm' height='90mm' "
             "viewBox='0 0 80 90'><polygon points='0,90 36,90 36,0 35.77,0 30,15.85 30,84 0,84'/>"
             "</svg>");
  ASSERT_EQ(claystack("import " + svg + " --axis 0 -o " + pot).status, 0);
  const Ran exported = claystack("export --json --certificate " + pot + " " + stl + " " + package);
  const double wall = exported.json().at("min_wall_mm");
  ASSERT_LT(wall, 0.45);
  const std::string with = " --certificate " + stl + ".certificate.json ";
  for (const auto& [limit, status] : {std::pair{"0.45", 1}, std::pair{"0.35", 0}})
    for (const std::string& file : {pot, with + stl, package}) {
      const Ran checked = claystack("check --json --min-wall " + std::string(limit) + " " + file);
      EXPECT_EQ(checked.status, status) << file << checked.out;
    }
  // The lip of the pot is named, and not its face. Without a certificate, rays see it nearly as
  // thin.
  const auto parts = claystack("check --json " + pot).json().at("wall_parts");
  ASSERT_EQ(parts.size(), 2u) << parts;
  EXPECT_EQ(parts[0].at("part"), "wall");
  EXPECT_NEAR(parts[0].at("min_wall_mm").get<double>(), 6.0, 0.05);
  EXPECT_EQ(parts[1].at("part"), "lip");
  // The certificate of the STL states the same wall. The export states the thinnest of its files:
  // the points of the 3MF are rounded once more, on both sides of the wall.
  const auto certificate = nlohmann::json::parse(read_text(stl + ".certificate.json"));
  EXPECT_EQ(parts[1].at("min_wall_mm"), certificate.at("wall_lower_mm"));
  EXPECT_NEAR(certificate.at("wall_lower_mm").get<double>() - wall,
              2.0 * certificate.at("rounding_mm").get<double>(), 1e-12);
  EXPECT_GT(parts[1].at("at_mm").at(1), 88.0);
  const Ran thin = claystack("check --min-wall 1 " + pot);
  EXPECT_NE(thin.out.find("thinner: lip from 8"), std::string::npos) << thin.out;
  const Ran thinnest = claystack("check --min-wall 0.45 " + pot);  // between two samples
  EXPECT_NE(thinnest.out.find("; thinnest: lip at a height of 89."), std::string::npos)
      << thinnest.out;
  const Ran sampled = claystack("check --json --min-wall 1 " + stl);
  EXPECT_EQ(sampled.status, 1);
  const auto least = sampled.json().at("wall_sampled");
  EXPECT_GT(least.at("least_mm"), wall - 1e-4);
  EXPECT_LT(least.at("least_mm"), wall + 0.3);
  EXPECT_GT(least.at("at_mm").at(2), 88.0);
}

}  // namespace
}  // namespace clay::test
