// The verdict on a pot: that of the export, and the form of the pot.

#include "app/studio/readings/pot_check.hpp"
#include "claystack/export/job.hpp"
#include "tests/app/studio/cups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>

namespace clay::studio {
namespace {

using test::cup_rings;
using test::pot_of;
using test::question_of;

TEST(Verdict, IsThatOfTheExport) {
  auto thin = cup_rings();
  for (std::size_t i = 66; i < 70; ++i) thin[i].inner2 = quanta_from_radius(38.4);
  auto lid = cup_rings();
  for (std::size_t i = 110; i < lid.size(); ++i) lid[i].inner2 = 0;
  std::vector<Ring> wide(20, Ring{quanta_from_radius(400.0), 0});
  for (const auto& rings : {cup_rings(), thin, lid, wide}) {
    const auto pot = pot_of(rings);
    for (const char* process : {"fdm", "porcelain"}) {
      const PotCheck check = check_pot(question_of(pot, process));
      solid::ExportRequest request;
      request.options.walls.process = solid::process_named(process).value();
      request.files = {solid::file_request("pot.stl").value()};
      const auto problems = solid::problems_of(solid::preview_export(*pot, request).value());
      ASSERT_EQ(check.problems.size(), problems.size()) << process;
      for (std::size_t i = 0; i < problems.size(); ++i) {
        EXPECT_EQ(check.problems[i].kind, problems[i].kind);
        EXPECT_EQ(check.problems[i].fails, problems[i].fails);
      }
      EXPECT_EQ(check.ready(), std::ranges::none_of(problems, &solid::Problem::fails));
    }
  }
}

TEST(Verdict, ClaimsNothingAboutAPotThatIsNotChecked) {
  PotCheck check;
  check.stopped = true;
  check.why_not = "no memory";
  EXPECT_EQ(ready_text(check, LengthUnit::mm), "Not checked: no memory");
  EXPECT_EQ(wall_text(check, LengthUnit::mm), "Walls unknown: no memory");
}

TEST(Verdict, NamesPlaceAndMeasureInTheUnit) {
  const auto verdict = [](std::vector<Ring> rings, LengthUnit unit) {
    return ready_text(check_pot(question_of(pot_of(std::move(rings)), "porcelain")), unit);
  };
  EXPECT_EQ(verdict(cup_rings(), LengthUnit::mm), "Ready to print");
  auto lip = cup_rings();
  for (std::size_t i = 116; i < 120; ++i) lip[i].inner2 = quanta_from_radius(38.4);  // 58 to 60 mm
  const std::string thin = verdict(lip, LengthUnit::mm);
  EXPECT_EQ(thin.find("Not ready: thin lip of 1.6 mm at a height of 5"), 0u) << thin;
  EXPECT_NE(thin.find("Porcelain needs 2.0 mm"), std::string::npos) << thin;
  const std::string inches = verdict(lip, LengthUnit::in);
  // The lip of 1.6 mm is cut 0.03 mm thicker by smoothing: 0.063 to 0.065 in.
  EXPECT_EQ(inches.find("Not ready: thin lip of 0.06"), 0u) << inches;
  EXPECT_EQ(inches.find(" in at"), inches.find("0.06") + 5) << inches;
  EXPECT_EQ(inches.find("mm"), std::string::npos) << inches;
  auto lid = cup_rings();
  for (std::size_t i = 110; i < lid.size(); ++i) lid[i].inner2 = 0;
  EXPECT_EQ(verdict(lid, LengthUnit::mm), "Not ready: closed cavity at a height of 32.5 mm");
  auto parted = cup_rings();
  for (std::size_t i = 80; i < parted.size(); ++i)
    parted[i] = {quanta_from_radius(30.0), quanta_from_radius(25.0)};
  EXPECT_EQ(verdict(parted, LengthUnit::mm),
            "Not ready: in two parts, separated at a height of 40.0 mm");
}

TEST(Verdict, CountsTheParts) {
  auto parted = cup_rings();
  for (std::size_t i = 80; i < 100; ++i)
    parted[i] = {quanta_from_radius(30.0), quanta_from_radius(25.0)};
  const PotCheck check = check_pot(question_of(pot_of(std::move(parted))));
  EXPECT_EQ(check.form.parts, 3u);
  EXPECT_EQ(ready_text(check, LengthUnit::mm),
            "Not ready: in 3 parts, the lowest up to a height of 40.0 mm");
}

TEST(Verdict, OfALumpIsNoPraise) {
  const std::vector<Ring> lump(40, Ring{quanta_from_radius(40.0), 0});
  const PotCheck check = check_pot(question_of(pot_of(lump)));
  EXPECT_EQ(check.verdict(), Verdict::lump);
  EXPECT_TRUE(check.ready()) << "the export writes it";
  EXPECT_EQ(ready_text(check, LengthUnit::mm), "Solid clay");
}

TEST(Verdict, DoubtsAPotWithoutAFloor) {
  const std::vector<Ring> ring(80, Ring{quanta_from_radius(40.0), quanta_from_radius(34.0)});
  const PotCheck check = check_pot(question_of(pot_of(ring)));
  EXPECT_EQ(check.verdict(), Verdict::doubtful);
  EXPECT_EQ(ready_text(check, LengthUnit::mm), "Check before printing: no floor");
  // A turned foot is no hole.
  auto turned = cup_rings();
  for (std::size_t i = 0; i < 8; ++i) turned[i].inner2 = quanta_from_radius(30.0);
  EXPECT_EQ(ready_text(check_pot(question_of(pot_of(turned))), LengthUnit::mm), "Ready to print");
}

TEST(Verdict, DoubtsAHollowThatIsAllButClosed) {
  const auto bottle = [](double mouth_mm) {
    auto rings = cup_rings();
    for (std::size_t i = 110; i < rings.size(); ++i)
      rings[i].inner2 = quanta_from_radius(0.5 * mouth_mm);
    return pot_of(std::move(rings));
  };
  const auto throttle = [&](double mouth_mm) {
    return form_of(bottle(mouth_mm)->stack).throttle_mm;
  };
  ASSERT_TRUE(throttle(1.0));
  EXPECT_GT(*throttle(1.0), 55.0);
  EXPECT_FALSE(throttle(2.5));
  EXPECT_FALSE(form_of(pot_of(cup_rings())->stack).throttle_mm);
  PotCheck check;
  check.proved = true;
  check.form = form_of(bottle(1.0)->stack);
  EXPECT_EQ(check.verdict(), Verdict::doubtful);
  EXPECT_EQ(
      ready_text(check, LengthUnit::mm).find("Check before printing: mouth narrower than 2.0"), 0u);
}

TEST(Walls, TheThinnestPlaceCanBeTheFloor) {
  auto rings = cup_rings(8.0);
  for (std::size_t i = 8; i < 20; ++i) rings[i].inner2 = quanta_from_radius(32.0);  // from 4 mm up
  const PotCheck check = check_pot(question_of(pot_of(std::move(rings)), "fdm"));
  ASSERT_TRUE(check.proved) << check.why_not;
  EXPECT_TRUE(check.thinnest_in_floor);
  EXPECT_EQ(wall_text(check, LengthUnit::mm).find("Thinnest wall 4.0 mm, in the floor; "), 0u)
      << wall_text(check, LengthUnit::mm);
  EXPECT_FALSE(check_pot(question_of(pot_of(cup_rings()))).thinnest_in_floor);
}

/// Smoothing rounds the corner of the bore, so the face of the floor may be a little higher there.
TEST(Walls, APlaceBesideTheFaceOfTheFloorIsNotInTheFloor) {
  PotForm form;
  form.floor_mm = 5.0;
  EXPECT_TRUE(in_floor(form, {10.0, 0.0}, {10.0, 5.0}));
  EXPECT_TRUE(in_floor(form, {10.0, 5.5}, {10.2, 0.0}));
  EXPECT_FALSE(in_floor(form, {113.8, 5.22}, {113.8, 5.35}));  // a tooth outside, above the face
  EXPECT_FALSE(in_floor(form, {113.8, 3.0}, {113.8, 3.2}));    // and below it
  EXPECT_FALSE(in_floor(form, {10.0, 0.0}, {10.0, 7.0}));
  EXPECT_FALSE(in_floor(form, {30.0, 4.0}, {34.0, 5.0}));  // across the wall
  EXPECT_FALSE(in_floor({}, {10.0, 0.0}, {10.0, 5.0}));
}

/// A cone that leans out by 45 degrees: across, its wall is thinner than level.
TEST(Walls, AreMeasuredAcrossTheClay) {
  std::vector<Ring> rings;
  for (int i = 0; i < 120; ++i) {
    const double outer = 30.0 + 0.5 * i;
    rings.push_back({quanta_from_radius(outer), i < 12 ? 0 : quanta_from_radius(outer - 6.0)});
  }
  const PotCheck check = check_pot(question_of(pot_of(std::move(rings))));
  ASSERT_TRUE(check.proved) << check.why_not;
  const auto wall = wall_mm_at(check, 40.0);
  ASSERT_TRUE(wall);
  EXPECT_NEAR(*wall, 6.0 / std::numbers::sqrt2, 0.05);
  EXPECT_FALSE(wall_mm_at(check, 61.0));
}

TEST(Units, ShowThousandthsOfAnInchOfAWall) {
  EXPECT_EQ(thickness_text(4.5, LengthUnit::mm), "4.5 mm");
  EXPECT_EQ(thickness_text(4.5, LengthUnit::cm), "0.45 cm");
  EXPECT_EQ(thickness_text(4.5, LengthUnit::in), "0.177 in");  // 4.5 / 25.4
}

TEST(Verdict, IsDoubtfulWhereTheExportOnlyWarns) {
  const auto check_of = [](std::vector<Ring> rings, const char* process) {
    return check_pot(question_of(pot_of(std::move(rings)), process));
  };
  EXPECT_EQ(check_of(cup_rings(), "").verdict(), Verdict::ready);
  auto paper = cup_rings();
  for (std::size_t i = 80; i < 100; ++i) paper[i].inner2 = quanta_from_radius(39.6);
  const PotCheck unasked = check_of(paper, "");
  EXPECT_EQ(unasked.verdict(), Verdict::doubtful);
  EXPECT_TRUE(unasked.ready());  // the export writes it
  const std::string words = ready_text(unasked, LengthUnit::mm);
  EXPECT_EQ(words.find("Check before printing: thin wall of 0."), 0u) << words;
  EXPECT_EQ(check_of(paper, "porcelain").verdict(), Verdict::not_ready);
}

}  // namespace
}  // namespace clay::studio
