#include "app/bench/extreme/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace clay::extreme {

SceneSpec small_pot() {
  SceneSpec scene;
  scene.lump.rings = 60;
  scene.lump.ring_height_mm = 1.0;
  scene.lump.outer_radius_mm = 30.0;
  scene.lump.max_rings = 240;
  scene.tool.shape = SphereSpec{8.0};
  scene.removal.min_wall_mm = 0.5;
  scene.flow.sigma_mm = 4.0;
  scene.flow.reach_mm = 12.0;
  return scene;
}

Trial::Trial(Model model, const SceneSpec& scene) : exact_(model == Model::conserving) {
  auto subject = make_subject(model, scene);
  if (!subject) {
    why_ = subject.error().message;
    return;
  }
  subject_ = std::move(*subject);
  fault_ = subject_->fault();
  if (const auto clay = subject_->clay()) before_ = *clay;
}

Tick Trial::at(const glm::dvec3& hip_mm, bool trim, std::int64_t dt_us) {
  if (!subject_ || !has_no_fault()) return {};
  time_us_ += dt_us;
  ++ticks_;
  last_ = subject_->step({time_us_, hip_mm, trim, gap_mm_});
  touched_ = touched_ || last_.contact;
  check_tick();
  return last_;
}

void Trial::check_tick() {
  const glm::dvec3& f = last_.force_n;
  if (last_.undefined) fault_ = "an index out of range, undefined in C++";
  if (last_.endless)
    fault_ = fmt::format("the growth loop does not end: {} rings", subject_->rings());
  if (!(std::isfinite(f.x) && std::isfinite(f.y) && std::isfinite(f.z)))
    fault_ = fmt::format("force ({:.3g}, {:.3g}, {:.3g}) N", f.x, f.y, f.z);
  else
    largest_force_n_ = std::max(largest_force_n_, glm::length(f));
  if (fault_.empty()) fault_ = subject_->fault();
  if (!fault_.empty()) fault_ = fmt::format("tick {}: {}", ticks_, fault_);
}

void Trial::stroke(const glm::dvec3& from_mm, const glm::dvec3& to_mm, int ticks, bool trim) {
  for (int k = 0; k < ticks; ++k) {
    const double s = ticks > 1 ? static_cast<double>(k) / (ticks - 1) : 1.0;
    at(from_mm + s * (to_mm - from_mm), trim);
  }
}

void Trial::require(bool holds, const std::string& failure) {
  if (has_no_fault() && !holds) fault_ = failure;
}

void Trial::weigh() {
  if (!subject_ || !has_no_fault()) return;
  const auto now = subject_->clay();
  if (!now) {
    fault_ = "a non-finite radius";
    return;
  }
  const Exact change = *now - before_;
  if (abs(change) <= subject_->allowance()) return;
  const double percent = before_ == 0 ? 0.0 : 100.0 * (change / before_).convert_to<double>();
  fault_ = fmt::format("clay {:+.3g} % after {} ticks", percent, ticks_);
}

Outcome Trial::done(const std::string& extra) {
  if (!subject_) return {Verdict::passed, "refused: " + why_};
  weigh();
  if (!has_no_fault()) return {Verdict::failed, fault_};
  std::string note = fmt::format("{} ticks, {}", ticks_, exact_ ? "0 quanta" : "within rounding");
  if (!extra.empty()) note += "; " + extra;
  return {Verdict::passed, note};
}

Outcome refused_or_sound(Model model, const SceneSpec& scene, const glm::dvec3& from_mm,
                         const glm::dvec3& to_mm, int ticks) {
  Trial trial(model, scene);
  trial.stroke(from_mm, to_mm, ticks);
  return trial.done();
}

}  // namespace clay::extreme
