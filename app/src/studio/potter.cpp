#include "studio/potter.hpp"

#include "draw/pot_view.hpp"

#include <algorithm>

namespace clay::studio {
namespace {

constexpr double kClosingMmPerS = 15.0;  // two hands that take hold of a wall

draw::PotView view_of(const live::LiveProfile& profile) {
  draw::PotView view;
  view.height_mm = profile.height_mm;
  view.rows.reserve(profile.size);
  for (std::size_t row = 0; row < profile.size; ++row)
    view.rows.push_back({profile.rows[row].outer_mm, profile.rows[row].inner_mm});
  return view;
}

}  // namespace

Result<void> Potter::begin(const SceneSpec& scene) {
  release();
  auto wheel = Wheel::build(scene);
  if (!wheel) return tl::make_unexpected(wheel.error());
  scene_ = scene;
  pot_ = wheel->pot();
  status_ = {};
  show_pot();
  return {};
}

void Potter::show_pot() { view_ = draw::view_of(*pot_); }

Result<void> Potter::press(const Press& press) {
  release();
  SceneSpec scene = *scene_;
  scene.tool = press.tool;
  scene.removal.rate_per_s = press.rate_per_s;
  auto wheel = Wheel::build(scene);
  if (!wheel) return tl::make_unexpected(wheel.error());
  live::LiveSettings settings = MouseDevice::servo_settings();
  closed_gap_mm_ = press.tool.mode == ToolMode::pinch ? press.tool.gap_mm.value_or(0.0) : 0.0;
  gap_mm_ = std::max(closed_gap_mm_, press.gap_mm);
  settings.gap_mm = gap_mm_;
  mouse_.begin_at(press.place_mm);
  auto sitting = Sitting::begin(std::move(*wheel), mouse_, clock_, nullptr, settings,
                                threads_ ? Pace::thread : Pace::stepped);
  if (!sitting) return tl::make_unexpected(sitting.error());
  scene_ = scene;
  sitting_ = std::move(*sitting);
  status_ = {};
  last_ns_ = counted_ns_ = clock_.now_ns();
  counted_ticks_ = 0;
  tick_rate_hz_ = 0.0;
  return {};
}

void Potter::command(const live::Command& command) noexcept {
  if (sitting_) (void)sitting_->command(command);
}

void Potter::set_stiffness(double n_per_mm2) {
  if (scene_ && scene_->force) scene_->force->stiffness_n_per_mm2 = n_per_mm2;
}

void Potter::release() {
  if (!sitting_) return;
  news_.stroke_ended = true;
  news_.ending = sitting_->end();
  status_ = sitting_->status();
  news_.poses = status_.poses;
  pot_ = sitting_->wheel().pot();
  sitting_.reset();
  show_pot();
}

void Potter::advance(std::int64_t now_ns) {
  if (!sitting_) return;
  if (gap_mm_ > closed_gap_mm_) {
    const double elapsed_s = 1e-9 * static_cast<double>(now_ns - last_ns_);
    gap_mm_ = std::max(closed_gap_mm_, gap_mm_ - kClosingMmPerS * elapsed_s);
    command({live::CommandKind::gap, gap_mm_});
  }
  last_ns_ = now_ns;
  sitting_->advance(now_ns);
  look();
  count_ticks(now_ns);
  if (!sitting_->running()) release();
}

/// Four times a second: a rate that can be read.
void Potter::count_ticks(std::int64_t now_ns) {
  constexpr std::int64_t kEveryNs = 250'000'000;
  if (now_ns - counted_ns_ < kEveryNs) return;
  tick_rate_hz_ = 1e9 * static_cast<double>(status_.ticks - counted_ticks_) /
                  static_cast<double>(now_ns - counted_ns_);
  counted_ns_ = now_ns;
  counted_ticks_ = status_.ticks;
}

void Potter::look() {
  status_ = sitting_->status();
  if (const live::LiveProfile* profile = sitting_->new_profile()) view_ = view_of(*profile);
}

// Until the work is kept by strokes there is nothing to go back to.
bool Potter::can_undo() const noexcept { return false; }
bool Potter::can_redo() const noexcept { return false; }
void Potter::undo() {}
void Potter::redo() {}
bool Potter::unsaved() const noexcept { return news_.poses > 0 || status_.poses > 0; }

}  // namespace clay::studio
