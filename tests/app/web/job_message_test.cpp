// Questions of the page's window to its worker, and the answers: nothing is lost on the way.

#include "app/web/job_message.hpp"

#include "app/render/pot_view.hpp"
#include "app/studio/readings/goal.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace clay::web {
namespace {

/// A cup with vertical walls: floor 10 mm, height 60 mm, radius 40 mm; rings of 0.5 mm.
history::SharedPot cup(double wall_mm) {
  std::vector<Ring> rings(120, Ring{quanta_from_radius(40.0), 0});
  for (std::size_t i = 20; i < rings.size(); ++i)
    rings[i].inner2 = quanta_from_radius(40.0 - wall_mm);
  Pot pot;
  pot.stack = ClayStack::from_rings(0.5, std::move(rings), 0).value();
  pot.ledger.initial = pot.stack.volume();
  return std::make_shared<const Pot>(std::move(pot));
}

studio::PotQuestion full_question() {
  const auto pot = cup(1.5);
  studio::PotQuestion question{{pot, render::view_of(*pot), 1.7, 0.3}, "porcelain", 0.04};
  question.target =
      std::make_shared<const studio::Target>(studio::Target{"thick", render::view_of(*cup(8.0))});
  question.shrinkage = 0.1;
  return question;
}

/// Every figure that the panels can show, as a text.
std::string shown(const studio::PotCheck& check) {
  std::ostringstream text;
  text.precision(17);
  const auto place = [&](const glm::dvec2& p) { text << p.x << ' ' << p.y << '\n'; };
  text << check.live << check.proved << check.fallen << check.why_not << check.triangles << '\n'
       << check.fault_mm.value_or(-1.0) << '\n'
       << check.form.hollow << check.form.floorless << check.form.parts << ' '
       << check.form.parting_mm.value_or(-1.0) << ' ' << check.form.floor_mm.value_or(-1.0) << ' '
       << check.form.throttle_mm.value_or(-1.0) << check.thinnest_in_floor << '\n'
       << check.tolerance_mm << ' ' << check.counted_mm3 << ' ' << check.proved_mm3 << ' '
       << check.volume_error_relative << ' ' << check.least_wall_mm << ' ' << check.thinnest_mm
       << ' ' << check.height_mm << ' ' << check.seconds << '\n'
       << wall_text(check, studio::LengthUnit::mm) << ready_text(check, studio::LengthUnit::mm);
  place(check.thinnest_from);
  place(check.thinnest_to);
  if (check.limit) text << check.limit->asked_by() << check.limit->up_to_size_sum_mm << '\n';
  for (const auto& remark : check.remarks)
    text << remark.from_mm << ' ' << remark.to_mm << remark.text << '\n';
  for (const auto& problem : check.problems) {
    text << problem.text << problem.fails << static_cast<int>(problem.kind) << problem.figure;
    if (problem.at) text << ' ' << problem.at->rho << ' ' << problem.at->y << '\n';
  }
  for (const auto& wall : check.walls) text << wall.outer_mm << ' ' << wall.inner_mm << '\n';
  if (check.off) {
    text << check.off->mm << ' ' << check.off->radius_mm << ' ' << check.off->height_mm << '\n';
    for (const float row_mm : check.off->rows_mm) text << row_mm << '\n';
  }
  if (!check.maker) return text.str();
  const auto state = [&](const solid::PotState& of) {
    text << of.size.diameter_mm << ' ' << of.size.height_mm << ' ' << of.size.foot_diameter_mm
         << ' ' << of.weight_g << ' ' << of.capacity_ml << ' ' << of.to_line_ml << ' '
         << of.inside_cm2 << ' ' << of.outside_cm2 << '\n';
  };
  const solid::MakerNumbers& maker = *check.maker;
  state(maker.thrown);
  if (maker.dry) state(*maker.dry);
  if (maker.fired) state(*maker.fired);
  text << maker.clay.density_g_cm3 << ' ' << maker.clay.shrinkage << ' '
       << maker.clay.drying_shrinkage.value_or(-1.0) << ' ' << maker.clay.water << ' '
       << maker.clay.ignition_loss << ' ' << maker.fill_line_mm << ' ' << maker.empty.centre_mm
       << ' ' << maker.empty.tipping_deg << ' ' << (maker.full ? maker.full->centre_mm : -1.0);
  return text.str();
}

TEST(JobMessage, CarriesTheWholeCheckOfAPot) {
  const studio::PotQuestion asked = full_question();
  const Question received = question_in(message_of(asked));
  ASSERT_TRUE(received.check);
  EXPECT_FALSE(received.exporting);
  studio::PotCheck expected = check_pot(asked), found = check_pot(*received.check);
  ASSERT_TRUE(expected.maker && expected.off && !expected.problems.empty()) << shown(expected);
  expected.seconds = found.seconds = 0.25;
  EXPECT_EQ(shown(found), shown(expected));
  expected.fault_mm = 1.0 / 3.0;
  expected.remarks.push_back({0.1, std::numeric_limits<double>::infinity(), "a step"});
  const auto answer = check_in(message_of(expected));
  ASSERT_TRUE(answer);
  EXPECT_EQ(shown(*answer), shown(expected));
}

TEST(JobMessage, CarriesAQuestionDuringAStroke) {
  studio::PotQuestion asked = full_question();
  asked.subject.pot = nullptr;
  asked.subject.outline.fallen = render::FallenView{7, glm::dmat4(2.0)};
  const Question received = question_in(message_of(asked));
  ASSERT_TRUE(received.check);
  EXPECT_TRUE(received.check->subject.live());
  EXPECT_EQ(received.check->subject.outline, asked.subject.outline);
  EXPECT_EQ(received.check->subject.crown_mm, 0.3);
  EXPECT_EQ(received.check->target->name, "thick");
  EXPECT_EQ(received.check->target->view, asked.target->view);
}

TEST(JobMessage, CarriesTheWholeExport) {
  ExportQuestion asked{studio::ExportKind::files, {}, *cup(5.0)};
  asked.choices = {.meshes = {solid::MeshFormat::drc, solid::MeshFormat::obj},
                   .step = true,
                   .section = true,
                   .dxf = true,
                   .pdf = true,
                   .report = true,
                   .pot = true,
                   .folder = "/a",
                   .name = "cup",
                   .tolerance_mm = 0.3,
                   .smoothing = solid::Smoothing::none,
                   .smooth_length_mm = 7.5,
                   .process = "porcelain",
                   .min_wall_mm = 1.1,
                   .shrinkage_percent = 12.5,
                   .material = "celadon",
                   .foot_width_mm = 6.1,
                   .foot_depth_mm = 3.2,
                   .floor_fillet_mm = 2.3,
                   .lip_fillet_mm = 1.4,
                   .glaze_mm = 0.2,
                   .drain_mm = 2.1,
                   .size = studio::ExportSize::height,
                   .holds_ml = 351.0,
                   .weighs_g = 401.0,
                   .height_mm = 101.0,
                   .diameter_mm = 102.0};
  const Question received = question_in(message_of(asked));
  ASSERT_TRUE(received.exporting);
  EXPECT_FALSE(received.check);
  EXPECT_EQ(received.exporting->kind, asked.kind);
  EXPECT_EQ(received.exporting->choices, asked.choices);
  EXPECT_EQ(received.exporting->pot.stack.volume(), asked.pot.stack.volume());
}

TEST(JobMessage, CarriesFiguresAndErrors) {
  const ExportAnswer answer{
      studio::ExportFigures{.has_solid = true,
                            .triangles = 7,
                            .meshes = {{solid::MeshFormat::obj, 5'000'000'000}},
                            .diameter_mm = 0.1,
                            .height_mm = 0.2,
                            .shrinkage = 0.3,
                            .capacity_ml = 0.8,
                            .weight_g = 0.9,
                            .fallen = true,
                            .thinnest_mm = 0.4,
                            .thinnest_at_mm = 0.5,
                            .thinnest_in_floor = true,
                            .closed_cavity = true,
                            .problems = {"thin"},
                            .failed = 1,
                            .marks = {{{0.6, 0.7}, "here"}}}};
  const auto found = export_in(message_of(answer));
  ASSERT_TRUE(found && *found);
  const studio::ExportFigures& figures = **found;
  EXPECT_TRUE(figures.has_solid && figures.fallen && figures.thinnest_in_floor &&
              figures.closed_cavity);
  EXPECT_EQ(figures.failed, 1u);
  EXPECT_EQ(figures.triangles, 7u);
  ASSERT_EQ(figures.meshes.size(), 1u);
  EXPECT_EQ(figures.meshes[0].format, solid::MeshFormat::obj);
  EXPECT_EQ(figures.meshes[0].bytes, 5'000'000'000u);
  EXPECT_EQ(
      (std::vector{figures.diameter_mm, figures.height_mm, figures.shrinkage, figures.thinnest_mm,
                   figures.thinnest_at_mm, figures.capacity_ml, figures.weight_g}),
      (std::vector{0.1, 0.2, 0.3, 0.4, 0.5, 0.8, 0.9}));
  EXPECT_EQ(figures.problems, std::vector<std::string>{"thin"});
  ASSERT_EQ(figures.marks.size(), 1u);
  EXPECT_EQ(figures.marks[0].place_mm, glm::dvec2(0.6, 0.7));
  EXPECT_EQ(figures.marks[0].text, "here");
  const auto failed = export_in(message_of(ExportAnswer(failure(ErrorKind::io, "full"))));
  ASSERT_TRUE(failed && !*failed);
  EXPECT_EQ(failed->error().kind, ErrorKind::io);
  EXPECT_EQ(failed->error().message, "full");
}

TEST(JobMessage, CarriesTheQuestionForALesson) {
  const strokes::Stroke stroke{.name = "Pull",
                               .hint = "Draw it up.",
                               .kind = strokes::StrokeKind::pull,
                               .through_mm = {{0.1, 0.2}},
                               .outline = {{1.0 / 3.0, 0.0}, {48.0, 1.0}},
                               .outline_in_mm = true,
                               .inside = true,
                               .speed_mm_s = 45.5,
                               .passes = 3,
                               .step_mm = {0.3, 0.4},
                               .hold_s = 0.5,
                               .trim = true,
                               .gap_mm = {11.0, 7.5},
                               .from_mm = 17.3,
                               .ease_mm = 0.6};
  const auto script = std::make_shared<const strokes::StrokeScript>(
      strokes::StrokeScript{7, 250.0, 0.07, 400.0, {130.0, 140.0}, {stroke, stroke}});
  studio::LessonQuestion asked{script, {}, cup(5.0), 9, 1, 2};
  asked.scene.name = "cup";
  asked.scene.clay = ClaySpec{.floor_mm = 1.0 / 7.0};
  asked.scene.tool = {EllipseSpec{12.0, 7.1}, ToolMode::pinch, 6.5};
  const Question received = question_in(message_of(asked));
  ASSERT_TRUE(received.lesson);
  EXPECT_FALSE(received.check || received.exporting);
  EXPECT_EQ(received.lesson->scene, asked.scene);
  EXPECT_EQ(received.lesson->pot->stack.volume(), asked.pot->stack.volume());
  EXPECT_EQ(received.lesson->node, 9u);
  EXPECT_EQ(received.lesson->step, 1u);
  EXPECT_EQ(received.lesson->passes_left, 2);
  // The script with its strokes: the same bytes once more.
  EXPECT_EQ(message_of(*received.lesson), message_of(asked));
  const strokes::StrokeScript& found = *received.lesson->script;
  EXPECT_EQ(std::tie(found.seed, found.rate_hz, found.tremor_mm, found.travel_mm_s, found.start_mm),
            std::tie(script->seed, script->rate_hz, script->tremor_mm, script->travel_mm_s,
                     script->start_mm));
  ASSERT_EQ(found.strokes.size(), 2u);
  EXPECT_EQ(found.strokes[1].kind, strokes::StrokeKind::pull);
  EXPECT_EQ(found.strokes[1].outline, stroke.outline);
  EXPECT_EQ(found.strokes[1].gap_mm, stroke.gap_mm);
}

TEST(JobMessage, CarriesThePlanOfAStroke) {
  studio::LessonPlan plan{.node = 3,
                          .step = 2,
                          .mode = ToolMode::trim,
                          .gap_mm = 0.1,
                          .path = {{{0.2, 1.0 / 3.0}, 0.4}, {{0.5, 0.6}, 0.7}},
                          .after = render::view_of(*cup(4.0)),
                          .left_mm2 = 0.8,
                          .problem = "none"};
  const auto found = plan_in(message_of(plan));
  ASSERT_TRUE(found);
  EXPECT_EQ(std::tie(found->node, found->step, found->mode, found->gap_mm, found->path,
                     found->after, found->left_mm2, found->problem),
            std::tie(plan.node, plan.step, plan.mode, plan.gap_mm, plan.path, plan.after,
                     plan.left_mm2, plan.problem));
}

TEST(JobMessage, IgnoresMessagesOfAnotherKind) {
  EXPECT_FALSE(check_in(message_of(full_question())));
  EXPECT_FALSE(export_in(message_of(full_question())));
  EXPECT_FALSE(plan_in(message_of(full_question())));
}

}  // namespace
}  // namespace clay::web
