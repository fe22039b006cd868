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
  return work::Work::begin(scene).map([&](work::Work&& work) { begin(scene, std::move(work)); });
}

Result<void> Potter::begin(const SceneSpec& scene, const Pot& pot) {
  return work::Work::begin(scene, pot).map([&](work::Work&& work) {
    begin(scene, std::move(work));
  });
}

Result<void> Potter::begin(WorkRecord record) {
  const SceneSpec scene = record.scenes.at(record.nodes.at(record.at).scene);
  return work::Work::open(std::move(record)).map([&](work::Work&& work) {
    begin(scene, std::move(work));
  });
}

void Potter::begin(const SceneSpec& scene, work::Work work) {
  release();
  scene_ = scene;
  work_.emplace(std::move(work));
  status_ = {};
  news_ = {};
  show_pot();
}

void Potter::show_pot() {
  auto pot = work_->pot();
  if (pot) {
    pot_ = std::move(*pot);
    view_ = draw::view_of(*pot_);
  } else {
    news_.error = pot.error();
  }
}

Result<void> Potter::press(const Press& press) {
  release();
  SceneSpec scene = scene_;
  scene.tool = press.tool;
  scene.removal.rate_per_s = press.rate_per_s;
  live::LiveSettings settings = MouseDevice::servo_settings();
  closed_gap_mm_ = press.tool.mode == ToolMode::pinch ? press.tool.gap_mm.value_or(0.0) : 0.0;
  gap_mm_ = std::max(closed_gap_mm_, press.gap_mm);
  settings.gap_mm = gap_mm_;
  mouse_.begin_at(press.place_mm);
  return sit_down(scene, settings);
}

Result<void> Potter::sit_down(const SceneSpec& scene, const live::LiveSettings& settings) {
  if (pot_->collapse)
    return failure(ErrorKind::bad_input, "The clay has fallen: undo takes the last stroke back");
  auto wheel = Wheel::build(scene, *pot_);
  if (!wheel) return tl::make_unexpected(wheel.error());
  auto sink = work_->begin_stroke(scene);
  if (!sink) return tl::make_unexpected(sink.error());
  auto recorder = live::Recorder::create(**sink);
  auto sitting = Sitting::begin(std::move(*wheel), mouse_, clock_, recorder.get(), &trace_, settings,
                                threads_ ? Pace::thread : Pace::stepped);
  if (!sitting) {
    (void)recorder->finish();
    (void)work_->end_stroke();  // without a pose it is none
    return tl::make_unexpected(sitting.error());
  }
  scene_ = scene;
  recorder_ = std::move(recorder);
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
  if (scene_.force) scene_.force->stiffness_n_per_mm2 = n_per_mm2;
}

void Potter::release() {
  if (!sitting_) return;
  news_.stroke_ended = true;
  news_.ending = sitting_->end();
  status_ = sitting_->status();
  news_.poses = status_.poses;
  news_.ring_limit = status_.ring_limit;
  const Pot felt = sitting_->wheel().pot();
  if (auto kept = recorder_->finish(); !kept) news_.error = kept.error();
  auto added = work_->end_stroke(&felt);
  if (!added) news_.error = added.error();
  sitting_.reset();
  recorder_.reset();
  show_pot();
}

void Potter::undo() {
  release();
  if (work_->undo()) show_pot();
}

void Potter::redo() {
  release();
  if (work_->redo()) show_pot();
}

Result<void> Potter::save(const std::string& path) {
  release();
  return work_->save(path);
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

void Potter::look() {
  status_ = sitting_->status();
  if (const live::LiveProfile* profile = sitting_->new_profile()) view_ = view_of(*profile);
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

}  // namespace clay::studio
