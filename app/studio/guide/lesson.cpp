#include "app/studio/guide/lesson.hpp"

#include "app/render/pot_view.hpp"
#include "app/studio/free_place.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clay::studio {
namespace {

constexpr double kSampleMm = 0.5;  // spacing of the slices that are compared
constexpr std::size_t kPosesPerPoint = 6;
constexpr double kLowestMm = -6.0;

/// No clay above the rim.
render::Row clay_at(const render::PotView& pot, double y_mm) {
  const render::Row* row = row_at(pot, y_mm);
  return row != nullptr ? *row : render::Row{};
}

double width_mm(const render::Row& row) {
  return static_cast<double>(row.outer_mm) - static_cast<double>(row.inner_mm);
}

std::vector<PathPoint> path_of(const std::vector<Pose>& poses) {
  std::vector<PathPoint> path;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (k % kPosesPerPoint != 0 && k + 1 < poses.size()) continue;
    const Pose& pose = poses[k];
    // The tool stops at the wheel head, but the hand may point below it.
    path.push_back({{pose.position_mm.x, std::max(kLowestMm, pose.position_mm.y)},
                    1e-6 * static_cast<double>(pose.time_us - poses.front().time_us)});
  }
  return path;
}

}  // namespace

double difference_mm2(const render::PotView& a, const render::PotView& b) {
  const double top_mm = std::max(a.height_mm, b.height_mm);
  double area_mm2 = 0.0;
  for (double y_mm = 0.5 * kSampleMm; y_mm < top_mm; y_mm += kSampleMm) {
    const render::Row p = clay_at(a, y_mm), q = clay_at(b, y_mm);
    const double both = std::max(0.0, static_cast<double>(std::min(p.outer_mm, q.outer_mm)) -
                                          static_cast<double>(std::max(p.inner_mm, q.inner_mm)));
    area_mm2 += kSampleMm * (width_mm(p) + width_mm(q) - 2.0 * both);
  }
  return area_mm2;
}

double width_difference_mm2(const render::PotView& a, const render::PotView& b) {
  const double top_mm = std::max(a.height_mm, b.height_mm);
  double area_mm2 = 0.0;
  for (double y_mm = 0.5 * kSampleMm; y_mm < top_mm; y_mm += kSampleMm)
    area_mm2 += kSampleMm * std::abs(width_mm(clay_at(a, y_mm)) - width_mm(clay_at(b, y_mm)));
  return area_mm2;
}

namespace {

/// A learner's pot may be wider inside than the sample: a trim leaves clay around the corner of the
/// floor there too.
void keep_clear_of_bore(strokes::Stroke& stroke, const render::PotView& pot) {
  constexpr double kSpareMm = 7.5, kCornerMm = 8.0, kStepMm = 0.5;
  for (glm::dvec2& point : stroke.outline) {
    const double y_mm = stroke.outline_in_mm ? point.y : point.y * pot.height_mm;
    double bore_mm = 0.0;
    for (double y = y_mm - kCornerMm; y <= y_mm + kCornerMm; y += kStepMm)
      bore_mm = std::max(bore_mm, static_cast<double>(clay_at(pot, y).inner_mm));
    if (bore_mm > 0.0) point.x = std::max(point.x, bore_mm + kSpareMm);
  }
}

/// The foot does not move while a wall is pulled: a wall that is led outward beyond the foot tears
/// off there. The pull begins within the foot of the learner's pot and reaches the sample's line
/// further up.
void begin_within_foot(strokes::Stroke& stroke, const render::PotView& pot) {
  constexpr double kFreeShare = 0.3;
  if (stroke.outline_in_mm || stroke.outline.front().y >= kFreeShare || pot.rows.empty()) return;
  const double foot_mm = static_cast<double>(pot.rows.front().outer_mm);
  const double most_mm = foot_mm - 0.5 * stroke.gap_mm.front() - kFootSpareMm;
  const auto above = std::ranges::find_if(
      stroke.outline, [](const glm::dvec2& point) { return point.y > kFreeShare; });
  if (above == stroke.outline.end() || stroke.outline.front().x <= most_mm) return;
  const glm::dvec2 below = *std::prev(above);
  const double part = (kFreeShare - below.y) / (above->y - below.y);
  std::vector<glm::dvec2> outline = {{most_mm, stroke.outline.front().y},
                                     {below.x + part * (above->x - below.x), kFreeShare}};
  outline.insert(outline.end(), above, stroke.outline.end());
  stroke.outline = std::move(outline);
}

}  // namespace

LessonPlan plan_step(const LessonQuestion& question) {
  LessonPlan plan;
  plan.node = question.node;
  plan.step = question.step;
  strokes::StrokeScript script = *question.script;
  strokes::Stroke& stroke = script.strokes.at(question.step);
  stroke.passes = std::max(1, question.passes_left);
  // A sponge rounds a lip and cuts nothing, at any place where a learner holds it.
  plan.mode = stroke.kind == strokes::StrokeKind::lip ? ToolMode::smooth
              : stroke.trim                           ? ToolMode::trim
                                                      : ToolMode::press;
  if (!stroke.gap_mm.empty()) {
    plan.mode = ToolMode::pinch;
    plan.gap_mm = 0.5 * (stroke.gap_mm.front() + stroke.gap_mm.back());
  }
  const render::PotView now = render::view_of(*question.pot);
  if (stroke.kind == strokes::StrokeKind::pull) begin_within_foot(stroke, now);
  if (stroke.trim && !stroke.inside) keep_clear_of_bore(stroke, now);
  const auto planned = strokes::plan(script, question.step, question.scene, *question.pot);
  if (!planned) {
    plan.problem = planned.error().message;
    return plan;
  }
  plan.path = path_of(planned->poses);
  plan.after = render::view_of(planned->after);
  plan.left_mm2 = plan.left_from(now);
  return plan;
}

}  // namespace clay::studio
