// Figures that the panels show for known pots; they must be those of the engine and the export.

#include "app/studio/readings/readings.hpp"
#include "app/studio/readings/goal.hpp"

#include "app/render/pot_view.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/export/walls.hpp"
#include "tests/app/studio/cups.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clay::studio {
namespace {

using test::cup_rings;
using test::pot_of;
using test::question_of;

constexpr double kPi = std::numbers::pi;

TEST(ClayAccount, WeighsTheClayOfTheLedger) {
  const Quanta trimmed = quanta_from_mm2(100.0);
  const ClayAccount account = account_of(*pot_of(cup_rings(), trimmed));
  // 2 g/cm^3; a disc 10 mm high and a tube 50 mm high.
  const double cup_mm3 = kPi * (1600.0 * 10.0 + (1600.0 - 35.0 * 35.0) * 50.0);
  EXPECT_NEAR(account.in_stack_g, 2e-3 * cup_mm3, 1e-6);
  EXPECT_NEAR(account.trimmed_g, 2e-3 * kPi * 0.5 * 100.0, 1e-9);
  EXPECT_NEAR(account.initial_g, account.in_stack_g + account.trimmed_g, 1e-9);
  EXPECT_EQ(account.unaccounted, "0");
  EXPECT_NEAR(account.capacity_mm3, kPi * 35.0 * 35.0 * 50.0, 1e-6);
}

/// Fired, lengths shrink by a tenth and the capacity by 1 - 0.9^3.
TEST(Goal, ReadsTheFiguresOfTheFiredPot) {
  PotQuestion question = question_of(pot_of(cup_rings()));
  question.shrinkage = 0.1;
  const PotCheck check = check_pot(question);
  ASSERT_TRUE(check.maker) << check.why_not;
  // The lip is rounded and the floor is smooth: a few tenths of the 192 ml.
  const double ml = 1e-3 * kPi * 35.0 * 35.0 * 50.0 * 0.729;
  EXPECT_NEAR(check.maker->in_use().capacity_ml, ml, 0.01 * ml);
  PotGoal goal{.holds_ml = 140.0, .height_mm = 54.0, .diameter_mm = 0.0, .shrinkage_percent = 10.0};
  GoalReading reading = read_goal(goal, *check.maker, LengthUnit::mm);
  EXPECT_TRUE(reading.met) << reading.text;
  EXPECT_EQ(reading.text, "Holds 140 of 140 ml, 54.0 of 54.0 mm high after firing");
  goal.height_mm = 60.0;  // that of the pot on the wheel
  reading = read_goal(goal, *check.maker, LengthUnit::cm);
  EXPECT_FALSE(reading.met) << reading.text;
  question.shrinkage = 0.0;
  EXPECT_TRUE(read_goal({.height_mm = 60.0}, *check_pot(question).maker, LengthUnit::mm).met);
}

TEST(Target, DistanceOfAWallThatIsMovedIsTheWay) {
  const auto cup = pot_of(cup_rings()), thick = pot_of(cup_rings(8.0));
  const render::PotView target = render::view_of(*cup);
  const auto same = off_target(target, target);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->mm, 0.0);
  const auto off = off_target(render::view_of(*thick), target);
  ASSERT_TRUE(off);
  EXPECT_NEAR(off->mm, 3.0, 2e-3);  // the inner wall moved by 3 mm
  ASSERT_EQ(off->rows_mm.size(), 120u);
  EXPECT_NEAR(off->rows_mm[80], 3.0f, 2e-3f);
  EXPECT_NEAR(off->rows_mm[5], 0.0f, 1e-6f) << "the floor is the same";
}

TEST(ClayAccount, ReportsAMissingQuantum) {
  Pot pot = *pot_of(cup_rings());
  pot.ledger.initial += 1;
  EXPECT_EQ(account_of(pot).unaccounted, "-1");
}

TEST(ClayAccount, UsesTheServosLedgerDuringAStroke) {
  const auto pot = pot_of(cup_rings());
  const ClayAccount before = account_of(*pot);
  servo::LiveStatus status;
  status.stack_mm3 = 1000.0;
  status.trimmed_mm3 = 500.0;
  const ClayAccount account = account_of(status, pot->stack, 2.0, before);
  EXPECT_NEAR(account.in_stack_g, 2.0, 1e-12);
  EXPECT_NEAR(account.trimmed_g, 1.0, 1e-12);
  EXPECT_EQ(account.initial_g, before.initial_g);
  EXPECT_EQ(account.unaccounted, "0");
  EXPECT_EQ(account.capacity_mm3, before.capacity_mm3);
}

TEST(StressCurve, MatchesTheEngineAndReportsTheHeight) {
  const auto pot = pot_of(cup_rings());
  const StressCurve curve = stress_of(pot->stack, 2.0, 2.0);
  EXPECT_EQ(curve.kpa, stresses_kpa(pot->stack, 2.0));
  // The lowest ring of the wall carries the 49.5 mm above it.
  EXPECT_NEAR(curve.most_kpa, 2000.0 * 9.80665 * 0.0495 * 1e-3, 1e-9);
  EXPECT_EQ(stress_text(curve, LengthUnit::mm), "49 % of the limit, at a height of 10.2 mm");
  EXPECT_EQ(stress_text(stress_of(pot->stack, 2.0, std::nullopt), LengthUnit::cm),
            "Maximum 0.97 kPa, at a height of 1.02 cm; no limit is set");
}

TEST(SectionRows, KeepExtremesOfManyRingsPerPixel) {
  std::vector<Ring> rings(100'000, Ring{quanta_from_radius(40.0), quanta_from_radius(30.0)});
  rings[50'123] = {quanta_from_radius(45.0), quanta_from_radius(20.0)};
  const ClayStack stack = ClayStack::from_rings(0.001, std::move(rings), 0).value();
  const auto rows = section_rows(stack, 100);
  ASSERT_EQ(rows.size(), 100u);
  EXPECT_EQ(rows[0], (SectionRow{30.0f, 30.0f, 40.0f, 40.0f}));
  EXPECT_EQ(rows[50], (SectionRow{20.0f, 30.0f, 40.0f, 45.0f}));
  EXPECT_EQ(rows[51], rows[0]);
}

TEST(SectionRows, GiveEachRingRowsInProportionToItsHeight) {
  const ClayStack stack =
      ClayStack::from_rings(1.0, {{quanta_from_radius(10), 0}, {quanta_from_radius(20), 0}}, 0)
          .value();
  const auto rows = section_rows(stack, 6);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(rows[i].outer_most_mm, i < 3 ? 10.0f : 20.0f) << i;
}

TEST(MinMax, KeepsExtremes) {
  std::vector<CurvePoint> points;
  for (int i = 0; i < 10'000; ++i) points.push_back({i * 1e-3, i == 5'432 ? 7.0 : 1.0});
  const auto parts = min_max_of(points, 0.0, 10.0, 100);
  for (std::size_t i = 0; i < 100; ++i)
    EXPECT_EQ(parts[i], (MinMax{1.0, i == 54 ? 7.0 : 1.0})) << i;
  EXPECT_EQ(min_max_of(points, 20.0, 30.0, 2)[0], std::nullopt);
  EXPECT_EQ(round_up(0.03), 0.05);
  EXPECT_EQ(round_up(200.0), 200.0);
  EXPECT_EQ(round_up(201.0), 500.0);
}

TEST(TickHistory, KeepsTenSecondsAndTheirPercentiles) {
  TickHistory ticks;
  for (int i = 0; i < 20'000; ++i)  // 20 s at 1 kHz; 2 in 100 are late by 500 us
    ticks.add({std::int64_t{i} * 1'000'000, 0.5f, 0.0f, i % 50 == 0 ? 500.0f : 20.0f, 3.0f,
               i % 1000 == 0});
  const TickFigures figures = ticks.figures();
  EXPECT_NEAR(static_cast<double>(figures.ticks), 10'000.0, 1.0);
  EXPECT_EQ(figures.late_p50_us, 20.0);
  EXPECT_EQ(figures.late_p99_us, 500.0);
  EXPECT_EQ(figures.late_most_us, 500.0);
  EXPECT_EQ(figures.work_p50_us, 3.0);
  EXPECT_EQ(figures.missed, 10u);
  const auto curve = ticks.curve(&servo::TickSample::late_us);
  EXPECT_EQ(curve.back().at, 0.0);
  EXPECT_NEAR(curve.front().at, -kHistoryS, 1e-9);
}

TEST(Subject, OfAnOutlineKeepsTheCrown) {
  const Ring ring{quanta_from_radius(40.0), quanta_from_radius(30.0)};
  const auto stack =
      ClayStack::from_rings(0.5, std::vector<Ring>(10, ring), ring.volume() / 3).value();
  servo::LiveProfile profile;
  servo::show(stack, 0.0, profile);
  render::PotView outline;
  outline.height_mm = profile.height_mm;
  for (std::size_t row = 0; row < profile.size; ++row)
    outline.rows.push_back({profile.rows[row].outer_mm, profile.rows[row].inner_mm});
  const auto shown = stack_of(outline, profile.crown_mm);
  ASSERT_TRUE(shown);
  EXPECT_NEAR(shown->height_mm(), stack.height_mm(), 1e-9);
  EXPECT_NEAR(shown->volume_mm3() / stack.volume_mm3(), 1.0, 1e-6);
  EXPECT_FALSE(stack_of({}, 0.0));
}

TEST(Subject, OfAnOutlineKeepsACrownThatAToolPreventsFromRising) {
  render::PotView outline;
  outline.height_mm = 6.3;  // ten rings of 0.5 mm and a crown of 1.3 mm
  outline.rows.assign(10, {40.0f, 30.0f});
  const auto shown = stack_of(outline, 1.3);
  ASSERT_TRUE(shown);
  EXPECT_NEAR(shown->height_mm(), 6.3, 1e-9);
  EXPECT_NEAR(shown->volume_mm3(), std::numbers::pi * (1600.0 - 900.0) * 6.3, 0.01);
}

TEST(PotCheck, MatchesTheCup) {
  const PotCheck check = check_pot(question_of(pot_of(cup_rings())));
  ASSERT_TRUE(check.proved) << check.why_not;
  EXPECT_FALSE(check.live);
  EXPECT_NEAR(check.thinnest_mm, 5.0, 1e-6);
  EXPECT_LE(check.least_wall_mm, 5.0);
  EXPECT_GT(check.least_wall_mm, 4.9);
  EXPECT_NEAR(check.counted_mm3, kPi * (1600.0 * 10.0 + 375.0 * 50.0), 1e-6);
  EXPECT_NEAR(check.proved_mm3 / check.counted_mm3, 1.0, 1e-9);
  EXPECT_GT(check.triangles, 100u);
  EXPECT_NEAR(wall_at_height(check.walls, check.height_mm, 40.0), 5.0, 1e-3);
  EXPECT_EQ(wall_text(check, LengthUnit::mm).substr(0, 20), "Thinnest wall 5.0 mm");
}

TEST(PotCheck, ReportsAThinWallWithItsHeight) {
  auto rings = cup_rings();
  for (std::size_t i = 66; i < 70; ++i) rings[i].inner2 = quanta_from_radius(38.4);  // 33 to 35 mm
  const PotCheck check = check_pot(question_of(pot_of(std::move(rings)), "porcelain"));
  ASSERT_TRUE(check.proved) << check.why_not;
  ASSERT_TRUE(check.limit);
  // The clay that rounding the lip by 2 mm removes, 2 (4 - pi) 2 pi 37.5 mm3, is spread over a
  // surface of about 2 (2 pi 37.5) 60 mm2: the wall is 0.03 mm thicker.
  EXPECT_NEAR(check.thinnest_mm, 1.63, 0.02);
  EXPECT_EQ(check.limit->min_wall_mm,
            solid::process_named("porcelain").value().wall_for(80 + 80 + 60).min_wall_mm);
  EXPECT_TRUE(check.thin());
  const std::string words = wall_text(check, LengthUnit::mm);
  EXPECT_EQ(words.find("Thinnest wall 1.6 mm, at a height of 3"), 0u) << words;
  EXPECT_NE(words.find("Porcelain requires"), std::string::npos) << words;
  EXPECT_NE(words.find("too thin"), std::string::npos) << words;
  const auto thin = thin_stretches(check);
  ASSERT_EQ(thin.size(), 1u);
  EXPECT_NEAR(thin[0].from_mm, 33.0, 1.5);
  EXPECT_NEAR(thin[0].to_mm, 35.0, 1.5);
  EXPECT_TRUE(thin_stretches(check_pot(question_of(pot_of(cup_rings()), "porcelain"))).empty());
}

TEST(PotCheck, ComparesWallsWithAProcessFile) {
  const std::string file = std::string(CLAYSTACK_SAMPLES).append("/workshop.process.json");
  const PotCheck check = check_pot(question_of(pot_of(cup_rings()), file));
  ASSERT_TRUE(check.limit);
  EXPECT_EQ(check.limit->min_wall_mm, 4.0) << "for sizes up to 400 mm";
  EXPECT_EQ(check.limit->process, "workshop printer, 4 mm nozzle");
  const PotCheck gone = check_pot(question_of(pot_of(cup_rings()), "/none.process.json"));
  EXPECT_EQ(gone.verdict(), Verdict::not_ready) << "the export refuses it too";
  EXPECT_EQ(ready_text(gone, LengthUnit::mm).find("Not checked: /none.process.json"), 0u);
}

TEST(PotCheck, ReportsTheReasonAndThePlace) {
  auto rings = cup_rings();
  for (std::size_t i = 80; i < rings.size(); ++i)  // a detached ring from 40 mm up
    rings[i] = {quanta_from_radius(30.0), quanta_from_radius(25.0)};
  const PotCheck check = check_pot(question_of(pot_of(std::move(rings))));
  EXPECT_FALSE(check.proved);
  EXPECT_NE(check.why_not.find("one piece"), std::string::npos) << check.why_not;
  ASSERT_TRUE(check.fault_mm);
  EXPECT_EQ(*check.fault_mm, 40.0);
}

TEST(PotCheck, OfAnOutlineMatchesThePotInFloatPrecision) {
  const auto pot = pot_of(cup_rings());
  const PotCheck exact = check_pot(question_of(pot));
  PotQuestion question = question_of(pot);
  question.subject.pot = nullptr;
  const PotCheck live = check_pot(question);
  ASSERT_TRUE(live.proved) << live.why_not;
  EXPECT_TRUE(live.live);
  EXPECT_NEAR(live.thinnest_mm, exact.thinnest_mm, 1e-4);
  EXPECT_NEAR(live.counted_mm3 / exact.counted_mm3, 1.0, 1e-6);
}

TEST(PotCheck, NamesAClosedCavity) {
  auto rings = cup_rings();
  for (std::size_t i = 110; i < rings.size(); ++i) rings[i].inner2 = 0;
  const PotCheck check = check_pot(question_of(pot_of(std::move(rings))));
  ASSERT_TRUE(check.proved) << check.why_not;
  ASSERT_FALSE(check.remarks.empty());
  EXPECT_NEAR(check.remarks[0].from_mm, 10.0, 1e-9);
  EXPECT_NEAR(check.remarks[0].to_mm, 55.0, 1e-9);
}

TEST(WallMap, FitsItsScaleToThePot) {
  const auto top_mm = [](double wall_mm) {
    return wall_map_of(check_pot(question_of(pot_of(cup_rings(wall_mm))))).top_mm;
  };
  EXPECT_EQ(top_mm(4.5), 5.0);
  EXPECT_EQ(top_mm(8.0), 10.0);
  EXPECT_EQ(top_mm(15.0), 20.0);
}

}  // namespace
}  // namespace clay::studio
