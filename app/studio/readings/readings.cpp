#include "app/studio/readings/readings.hpp"

#include "claystack/engine/clay.hpp"

#include <fmt/format.h>

namespace clay::studio {
namespace {

constexpr std::int64_t kLiveCheckNs = 100'000'000;  // minimum time between checks during a stroke

std::string line_of(const PotCheck& check) {
  const std::string verdict =
      check.proved ? fmt::format("proved, {} triangles", check.triangles) : check.why_not;
  return fmt::format("checked: {}, {:.1f} ms", verdict, 1e3 * check.seconds);
}

}  // namespace

void Readings::update(const Document& document, StrokeController& stroke, const Wanted& wanted,
                      std::int64_t now_ns, const std::function<void(std::string_view)>& log) {
  stroke.trace().want(wanted.ticks);
  ticks_.take(stroke.trace());
  if (!document.has_work()) return;
  read(document, stroke);
  if (wanted.check) ask(wanted, now_ns);
  if (auto answer = checker_.take()) {
    check_ = std::move(answer);
    current_ = !changed_ && !checker_.busy();
    if (!check_->live) log(line_of(*check_));
  }
}

/// The pot at rest, or the outline from the servo during a stroke.
void Readings::read(const Document& document, const StrokeController& stroke) {
  const bool live = stroke.throwing();
  const bool same = live ? subject_.live() && subject_.outline == stroke.view()
                         : subject_.pot == document.shown_pot();
  const SceneSpec& scene = document.scene();
  const auto limit_kpa =
      scene.stability ? std::optional(scene.stability->max_stress_kpa) : std::nullopt;
  if (!same) {
    subject_ = {live ? nullptr : document.shown_pot(), stroke.view(), scene.lump.density_g_cm3,
                stroke.crown_mm()};
    outline_stack_ = live ? stack_of(subject_.outline, subject_.crown_mm) : std::nullopt;
    section_size_ = 0;
    changed_ = true;
    current_ = false;
    if (const ClayStack* clay = stack()) {
      widest_mm_ = largest_radius_mm(*clay);
      stress_ = stress_of(*clay, subject_.density_g_cm3, limit_kpa);
    }
    if (!live) account_ = resting_account_ = account_of(*subject_.pot);
  }
  if (live && outline_stack_ && stroke.status().ticks > 0)
    account_ =
        account_of(stroke.status(), *outline_stack_, subject_.density_g_cm3, resting_account_);
}

void Readings::ask(const Wanted& wanted, std::int64_t now_ns) {
  if (!changed_ && asked_ == wanted) return;
  const bool soon = now_ns - asked_ns_ < kLiveCheckNs || checker_.busy();
  if (live() && soon) return;
  checker_.ask({.subject = subject_,
                .process = wanted.process,
                .target = wanted.target,
                .shrinkage = wanted.shrinkage});
  asked_ = wanted;
  asked_ns_ = now_ns;
  changed_ = false;
}

double Readings::diameter_mm() const noexcept {
  return current_ && check_->maker ? check_->maker->thrown.size.diameter_mm : 2.0 * widest_mm_;
}

double Readings::capacity_mm3() const noexcept {
  return current_ && check_->maker ? 1e3 * check_->maker->thrown.capacity_ml
                                   : account_.capacity_mm3;
}

const ClayStack* Readings::stack() const noexcept {
  if (subject_.pot) return &subject_.pot->stack;
  return outline_stack_ ? &*outline_stack_ : nullptr;
}

const std::vector<SectionRow>& Readings::section(std::size_t rows) const {
  if (section_size_ != rows || rows == 0) {
    const ClayStack* clay = stack();
    section_ = clay != nullptr && rows > 0 ? section_rows(*clay, rows) : std::vector<SectionRow>();
    section_size_ = rows;
  }
  return section_;
}

}  // namespace clay::studio
