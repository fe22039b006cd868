// The solid for CAD: its geometry against closed forms, its file against faults.

#include "export/formats/step.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid {
namespace {

constexpr double kPi = std::numbers::pi;

/// A cup with cones: 30 to 40 mm outside, 26 to 36 mm inside, 50 mm high, with a floor of 8 mm.
const Profile kCup{{{{0, 0}, {30, 0}, {40, 50}, {36, 50}, {26, 8}, {0, 8}}}};
double frustum(double a, double b, double h) { return kPi / 3.0 * h * (a * a + a * b + b * b); }
const double kCupVolume = frustum(30, 40, 50) - frustum(26, 36, 42);

/// A wall that bends: a sphere of radius 50 between heights -30 and 40 about its middle, as lines.
Profile sphere(std::size_t edges) {
  Polygon piece{{0, 0}};
  for (std::size_t i = 0; i <= edges; ++i) {
    const double angle = std::asin(-0.6) + (std::asin(0.8) - std::asin(-0.6)) *
                                               static_cast<double>(i) / static_cast<double>(edges);
    piece.push_back({50.0 * std::cos(angle), 30.0 + 50.0 * std::sin(angle)});
  }
  piece.push_back({0, piece.back().y});
  return {{piece}};
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Step, ACupIsExactInBothKinds) {
  for (const StepWalls walls : {StepWalls::lines, StepWalls::spline}) {
    const RevolvedBrep brep = revolved_brep(kCup, walls, 0.01).value();
    EXPECT_EQ(brep.faces(), 2u + 2u + 1u + 2u);  // foot, floor, wall, rim, bore
    EXPECT_NEAR(brep.volume_mm3 / kCupVolume, 1.0, 1e-11);
    EXPECT_LE(brep.deviation_mm, 2e-9);
    const StepSolid found = verify_step(encode_step(brep, "cup"), "cup.step").value();
    EXPECT_EQ(found.bodies, 1u);
    EXPECT_EQ(found.faces, brep.faces());
    // Euler: V - E + F - H = 2, with two vertices and edges a circle, and a hole in the rim.
    EXPECT_EQ(found.edges, 2u * 4u + 2u * 2u);
    EXPECT_NEAR(found.volume_mm3 / kCupVolume, 1.0, 1e-11);
  }
}

/// A rod of 20 000 rings, alternately 40 and 42 mm in radius. The volume is a sum with a term for
/// each face. In a plain sum the rounding errors add up to more than 1e-13 of the volume.
TEST(Step, TheVolumeOfManyFacesIsSummedWithoutLoss) {
  constexpr int kRings = 20'000;
  constexpr double kHeightMm = 0.0051;
  Polygon piece{{0, 0}};
  for (int i = 0; i < kRings; ++i)
    for (const int end : {0, 1}) piece.push_back({40.0 + 2.0 * (i % 2), (i + end) * kHeightMm});
  piece.push_back({0, kRings * kHeightMm});
  const RevolvedBrep brep = revolved_brep({{piece}}, StepWalls::lines, 0.01).value();
  const double volume = kPi * kHeightMm * (kRings / 2) * (40.0 * 40.0 + 42.0 * 42.0);
  EXPECT_NEAR(brep.volume_mm3 / volume, 1.0, 1e-13);
  const StepSolid found = verify_step(encode_step(brep, "rod"), "rod.step").value();
  EXPECT_NEAR(found.volume_mm3 / volume, 1.0, 1e-13);
}

TEST(Step, ACurveKeepsToleranceAndVolume) {
  const Profile lines = sphere(200);
  const double volume = volume_of(lines);
  for (const double tolerance : {0.1, 0.01, 0.001}) {
    const RevolvedBrep brep = revolved_brep(lines, StepWalls::spline, tolerance).value();
    EXPECT_EQ(brep.faces(), 4u);
    EXPECT_LE(brep.deviation_mm, tolerance);
    EXPECT_NEAR(brep.volume_mm3 / volume, 1.0, 1e-9);
    // Independent of the bound: the points of the curve lie near the sphere.
    double farthest = 0.0;
    const Profile flat = brep.flattened(1e-5);
    for (const ProfilePoint& p : flat.pieces[0])
      if (p.rho > 0.0)
        farthest = std::max(farthest, std::abs(std::hypot(p.rho, p.y - 30.0) - 50.0));
    EXPECT_LE(farthest, brep.deviation_mm + 50.0 * (1.0 - std::cos(0.5 * 1.6 / 200)) + 1e-5);
    EXPECT_NEAR(verify_step(encode_step(brep, "s"), "s").value().volume_mm3 / volume, 1.0, 1e-9);
  }
}

double distance_to_line(const ProfilePoint& p, const Polygon& line) {
  double least = INFINITY;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const ProfilePoint &a = line[i], &b = line[i + 1];
    const double dx = b.rho - a.rho, dy = b.y - a.y;
    const double t = ((p.rho - a.rho) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy);
    const double near = std::clamp(t, 0.0, 1.0);
    least = std::min(least, std::hypot(p.rho - a.rho - near * dx, p.y - a.y - near * dy));
  }
  return least;
}

/// Hundreds of spans, whose control points lie on a grid: it is finer than the tolerance.
TEST(Step, TheCurveOfARoughWallKeepsASmallTolerance) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> noise(-0.005, 0.005);
  Polygon piece{{0, 0}};
  for (int i = 0; i <= 400; ++i)
    piece.push_back({30.0 + 5.0 * std::sin(i / 60.0) + noise(random), 0.05 * i});
  const Polygon wall(piece.begin() + 1, piece.end());
  piece.push_back({0, 20});
  const double volume = volume_of(Profile{{piece}});
  for (const double tolerance : {0.001, 0.0003, 0.0001}) {
    const auto brep = revolved_brep({{piece}}, StepWalls::spline, tolerance);
    ASSERT_TRUE(brep) << brep.error().message;
    EXPECT_EQ(brep->faces(), 4u);
    EXPECT_LE(brep->deviation_mm, tolerance);
    EXPECT_NEAR(brep->volume_mm3 / volume, 1.0, 1e-9);
    const Profile flat = brep->flattened(1e-5);
    double farthest = 0.0;
    for (const ProfilePoint& p : flat.pieces[0])
      if (p.rho > 0.0) farthest = std::max(farthest, distance_to_line(p, wall));
    EXPECT_LE(farthest, tolerance);
  }
}

TEST(Step, TheBoundOfTheDistanceHolds) {
  // A curve with three known control points off the line: the bound is not below the true distance.
  const Polygon line{{10, 0}, {10, 30}};
  const WallCurve bulge{{0.0, 1.0}, {{10, 0}, {11, 10}, {11, 20}, {10, 30}}};
  EXPECT_NEAR(distance_bound(bulge, line), 1.0, 1e-12);  // the hull; the curve itself reaches 0.75
  double farthest = 0.0;
  for (const ProfilePoint& p : flattened(bulge, 1e-6))
    farthest = std::max(farthest, std::abs(p.rho - 10.0));
  EXPECT_NEAR(farthest, 0.75, 1e-4);
  // pi times the integral of (10 + 3 t (1 - t))^2 30 dt
  EXPECT_NEAR(swept_volume(bulge), kPi * 30.0 * (100.0 + 10.0 + 0.3), 1e-9);
}

TEST(Step, CavitiesAreVoidsAndPiecesAreSolids) {
  const Profile hollow{
      {{{0, 0}, {30, 0}, {30, 40}, {0, 40}, {0, 30}, {20, 30}, {20, 10}, {0, 10}}}};
  const std::string step =
      encode_step(revolved_brep(hollow, StepWalls::lines, 0.01).value(), "box");
  EXPECT_NE(step.find("BREP_WITH_VOIDS"), step.npos);
  const StepSolid found = verify_step(step, "box").value();
  EXPECT_NEAR(found.volume_mm3, kPi * (900.0 * 40.0 - 400.0 * 20.0), 1e-4);
  EXPECT_EQ(found.faces, 8u);

  const Profile two{{{{10, 0}, {20, 0}, {20, 10}, {10, 10}}, {{0, 20}, {5, 20}, {5, 25}, {0, 25}}}};
  const StepSolid both =
      verify_step(encode_step(revolved_brep(two, StepWalls::spline, 0.01).value(), "two"), "two")
          .value();
  EXPECT_EQ(both.bodies, 2u);
  EXPECT_NEAR(both.volume_mm3, kPi * (300.0 * 10.0 + 25.0 * 5.0), 1e-4);
}

TEST(Step, AConeToAPointIsRefused) {
  const Profile cone{{{{0, 0}, {30, 0}, {0, 40}}}};
  EXPECT_FALSE(revolved_brep(cone, StepWalls::lines, 0.01));
}

TEST(Step, TheJudgeFindsPlantedFaults) {
  const std::string step =
      encode_step(revolved_brep(kCup, StepWalls::lines, 0.01).value(), "it's a \\ cup");
  ASSERT_TRUE(verify_step(step, "cup"));
  EXPECT_NE(step.find("'it''s a \\\\ cup'"), step.npos);
  const auto wrong = [&](std::string_view from, std::string_view to, std::string_view why) {
    const auto verdict = verify_step(replaced(step, from, to), "cup.step");
    ASSERT_FALSE(verdict) << from;
    EXPECT_NE(verdict.error().message.find(why), std::string::npos) << verdict.error().message;
  };
  wrong("(40.,0.,50.)", "(40.,0.,50.1)", "vert");           // a vertex off its line or circle
  wrong("0.1973955598", "0.1983955598", "on its surface");  // the slope of a cone
  const auto first = [&](std::string_view entity, std::string_view end) {
    const std::size_t at = step.find(entity);
    return step.substr(at, step.find(end, at) + end.size() - at);
  };
  const std::string edge = first("ORIENTED_EDGE", ".F."), bound = first("FACE_OUTER_BOUND", ".T.");
  wrong(edge, replaced(edge, ".F.", ".T."), "follow each other");
  wrong(bound, replaced(bound, ".T.", ".F."), "sense of its loop");
  wrong("FACE_OUTER_BOUND", "FACE_BOUND", "counterclockwise");  // the foot's only bound
  wrong("MANIFOLD_SOLID_BREP", "SHELL_BASED_SURFACE_MODEL", "expected a solid");
  wrong("CLOSED_SHELL('',(", "CLOSED_SHELL('',(#999999,", "expected an entity");
  wrong("ENDSEC;\nEND-ISO", "END-ISO", "expected");
  wrong("(40.,0.,50.)", "(40.,9.E999,50.)", "expected a number");  // does not fit: not a zero
  wrong("(40.,0.,50.)", "(40.,nan,50.)", "expected a number");
  wrong("FACE_BOUND", "FACE_BOUNDARY", "a bound of a face");
  wrong(".MILLI.,.METRE.", "$,.METRE.", "lengths in mm");
  wrong("LENGTH_UNIT()", "RATIO_UNIT()", "LENGTH_UNIT");
  wrong("\n#7=", "\n#8=", "expected #7=");  // numbers that repeat or leave gaps
  wrong("\n#7=", "\n#18446744073709551623=", "expected #7=");
  // A face that is missing leaves open edges.
  const std::size_t shell = step.find("CLOSED_SHELL('',(") + 17;
  std::string open = step;
  open.erase(shell, open.find(',', shell) + 1 - shell);
  const auto verdict = verify_step(open, "cup.step");
  ASSERT_FALSE(verdict);
  EXPECT_NE(verdict.error().message.find("two faces"), std::string::npos);
}

TEST(Step, EmptyListsAreRefused) {
  const auto refused = [](const std::string& step, std::string_view list, std::string_view why) {
    const std::size_t begin = step.find(list);
    ASSERT_NE(begin, step.npos) << list;
    std::string without = step;
    const std::size_t first = begin + list.size();
    without.erase(first, without.find(')', first) - first);
    const auto verdict = verify_step(without, "s.step");
    ASSERT_FALSE(verdict) << list;
    EXPECT_EQ(verdict.error().kind, ErrorKind::unsound);
    EXPECT_NE(verdict.error().message.find(why), std::string::npos) << verdict.error().message;
  };
  const std::string cup = encode_step(revolved_brep(kCup, StepWalls::lines, 0.01).value(), "cup");
  refused(cup, "EDGE_LOOP('',(", "expected circles in its loop");  // of the foot, a plane
  const std::string ball =
      encode_step(revolved_brep(sphere(200), StepWalls::spline, 0.01).value(), "ball");
  refused(ball, "B_SPLINE_CURVE_WITH_KNOTS('',3,(", "expected control points");
}

/// Leaves the first and last of the four items after each `keyword`.
std::string with_two_points(std::string text, std::string_view keyword,
                            std::string_view separator) {
  for (std::size_t at = text.find(keyword); at != text.npos; at = text.find(keyword, at + 1)) {
    const std::size_t first = text.find(separator, at + keyword.size());
    const std::size_t last = text.find(separator, text.find(separator, first + 1) + 1);
    text.erase(first, last - first);
  }
  return text;
}

TEST(Step, ACurveWithoutKnotsIsRefused) {
  const Profile bent{{{{0, 0}, {30, 0}, {35.1, 25}, {40, 50}, {0, 50}}}};
  const std::string cup = encode_step(revolved_brep(bent, StepWalls::spline, 1.0).value(), "cup");
  std::string line = with_two_points(cup, "B_SPLINE_CURVE_WITH_KNOTS('',3,(", ",");
  line = with_two_points(line, "B_SPLINE_SURFACE(3,3,(", "),(");
  line = with_two_points(line, "RATIONAL_B_SPLINE_SURFACE(", "),(");
  constexpr std::string_view kKnots = "(4,4),(4,4),(0.,1.),";
  for (std::size_t at = line.find(kKnots); at != line.npos; at = line.find(kKnots))
    line.replace(at, kKnots.size(), "(),(4,4),(),");
  const auto verdict = verify_step(line, "cup.step");
  ASSERT_FALSE(verdict);
  EXPECT_NE(verdict.error().message.find("control points than knots"), std::string::npos)
      << verdict.error().message;
}

TEST(Step, TheJudgeReadsEveryNumberOfACurve) {
  const std::string ball =
      encode_step(revolved_brep(sphere(200), StepWalls::spline, 0.1).value(), "ball");
  ASSERT_TRUE(verify_step(ball, "ball"));
  const auto wrong = [&](std::string_view from, std::string_view to, std::string_view why) {
    const auto verdict = verify_step(replaced(ball, from, to), "ball.step");
    ASSERT_FALSE(verdict) << from;
    EXPECT_NE(verdict.error().message.find(why), std::string::npos) << verdict.error().message;
  };
  const std::size_t curve = ball.find("B_SPLINE_CURVE_WITH_KNOTS"), end = ball.find('\n', curve);
  const std::string line = ball.substr(curve, end - curve);
  wrong(line, replaced(line, "'',3,", "'',2,"), "degree 3");
  wrong(line, replaced(line, "(4,", "(3,"), "fourfold");
  wrong(line, replaced(line, "(0.,", "(0.5,"), "its edges on its surface");
  wrong(line, replaced(line, "(0.,", "(1000.,"), "ascending");
  wrong("B_SPLINE_SURFACE(3,3,", "B_SPLINE_SURFACE(2,3,", "degree 3");
  wrong("B_SPLINE_SURFACE(3,3,", "B_SPLINE_SURFACE(3,2,", "degree 3");
  wrong("(4,4),", "(4,3),", "fourfold");
  wrong("(0.,1.),.UNSPECIFIED.", "(1.,0.),.UNSPECIFIED.", "ascending");
  wrong("DIRECTION('',(0.,0.,1.))", "DIRECTION('',(1.,0.,1.))", "a frame on the axis");
  wrong("DIRECTION('',(1.,0.,0.))", "DIRECTION('',(0.,0.,1.))", "a frame on the axis");
}

TEST(Step, DeepListsAreRefused) {
  const std::string head = "ISO-10303-21;\nDATA;\n#1=A", tail = "ENDSEC;\nEND-ISO-10303-21;\n";
  for (const std::size_t depth : {33u, 1000000u}) {
    const std::string deep = std::string(depth, '(') + "1" + std::string(depth, ')');
    EXPECT_EQ(verify_step(head + deep + ";\n" + tail, "deep").error().kind, ErrorKind::bad_input);
  }
}

TEST(Step, EveryCutFileIsRefused) {
  const std::string step = encode_step(revolved_brep(kCup, StepWalls::lines, 0.01).value(), "cup");
  for (std::size_t size = 0; size + 1 < step.size(); size += 97)
    EXPECT_FALSE(verify_step(std::string_view(step).substr(0, size), "cup.step")) << size;
}

}  // namespace
}  // namespace clay::solid
