#include "export/section/simplify_line.hpp"

#include "tests/export/smoothing/smoothing_oracles.hpp"
#include "tests/export/smoothing/smoothing_stacks.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace clay::solid {
namespace {

oracles::Point real(const ProfilePoint& p) { return {p.rho, p.y}; }

/// Every removed point lies within its tolerance of the edge that replaces it.
bool promise_kept(const Polygon& line, const Polygon& made, const std::vector<double>& tolerances) {
  if (made.front() != line.front() || made.back() != line.back()) return false;
  std::size_t edge = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == made[edge + 1] && edge + 2 < made.size()) {
      ++edge;
      continue;
    }
    const auto away = oracles::distance(real(line[i]), {real(made[edge]), real(made[edge + 1])});
    if (away > tolerances[i] * (1 + 1e-9L) + 1e-12L) return false;
  }
  return edge + 2 == made.size();
}

Polygon wandering_line(std::mt19937_64& random, std::size_t count, double sideways, double up) {
  Polygon line{{30.0, 0.0}};
  for (std::size_t i = 1; i < count; ++i)
    line.push_back({std::abs(line.back().rho + sideways * (samples::uniform(random) - 0.5)),
                    line.back().y + up * (0.01 + samples::uniform(random))});
  return line;
}

RC_GTEST_PROP(SimplifyLine, RemovesOnlyPointsNearTheRemainingEdge, ()) {
  auto random = *samples::random_engine();
  const Polygon line =
      wandering_line(random, *rc::gen::inRange<std::size_t>(2, 300),
                     *rc::gen::element(0.01, 1.0, 30.0), *rc::gen::element(0.01, 1.0));
  const double tolerance = *rc::gen::element(1e-3, 0.05, 0.5, 20.0);
  std::vector<double> tolerances(line.size());
  for (double& each : tolerances)
    each = samples::uniform(random) < 0.1 ? 0.0 : tolerance * samples::uniform(random);
  RC_ASSERT(promise_kept(line, simplified(line, tolerances), tolerances));
}

TEST(SimplifyLine, ReducesAStraightLineToItsEnds) {
  Polygon line;
  for (int i = 0; i <= 1000; ++i) line.push_back({5.0 + 0.3 * i, 0.7 * i});
  EXPECT_EQ(simplified(line, std::vector<double>(line.size(), 1e-6)).size(), 2u);
}

TEST(SimplifyLine, KeepsAPointWithoutTolerance) {
  Polygon line;
  for (int i = 0; i <= 100; ++i) line.push_back({5.0, 0.5 * i});
  std::vector<double> tolerances(line.size(), 1.0);
  tolerances[30] = 0.0;
  EXPECT_EQ(simplified(line, tolerances), (Polygon{line[0], line[30], line[100]}));
}

TEST(SimplifyLine, ArcNeedsTheChordsOfItsSagitta) {
  // A chord between points on the arc may deviate by the tolerance: 2 acos(1 - e / R) each.
  constexpr double kRadius = 50.0, kTolerance = 0.01;
  Polygon line;
  for (int i = 0; i <= 100'000; ++i) {
    const double angle = 0.5 * M_PI * (i / 100'000.0 - 0.5);
    line.push_back({kRadius * std::cos(angle), kRadius * (1.0 + std::sin(angle))});
  }
  const double chords = 0.5 * M_PI / (2.0 * std::acos(1.0 - kTolerance / kRadius));
  const Polygon made = simplified(line, std::vector<double>(line.size(), kTolerance));
  EXPECT_LE(static_cast<double>(made.size()), std::ceil(chords) + 2.0);
  EXPECT_GE(static_cast<double>(made.size()), std::floor(chords));
}

TEST(SimplifyLine, IsFastForAMillionPointsInAnyOrder) {
  // Worst cases of Douglas-Peucker (a split beside an end each time) and of a search that continues
  // for a farther valid point.
  std::mt19937_64 random(11);
  Polygon growing, fanning;
  for (int i = 0; i < 1'000'000; ++i) {
    growing.push_back({30.0 + (i % 2 == 0 ? 1e-5 : -1e-5) * i, 1e-3 * i});
    fanning.push_back({30.0 + 0.5 * std::sin(1e-3 * i) + 0.019 * (i % 2), 1e-4 * i});
  }
  for (const Polygon& line : {growing, fanning, wandering_line(random, 1'000'000, 0.1, 0.001)}) {
    const std::vector<double> tolerances(line.size(), 0.01);
    EXPECT_TRUE(promise_kept(line, simplified(line, tolerances), tolerances));
  }
}

TEST(SimplifyLine, RemovesExactlyCollinearPointsOnVerticals) {
  EXPECT_EQ(without_straight_points({{3, 0}, {3, 1}, {3, 1}, {3, 2}, {4, 2}, {4, 3}, {4.5, 4}}),
            (Polygon{{3, 0}, {3, 2}, {4, 2}, {4, 3}, {4.5, 4}}));
}

}  // namespace
}  // namespace clay::solid
