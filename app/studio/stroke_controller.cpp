#include "app/studio/stroke_controller.hpp"

#include "app/render/pot_view.hpp"

#include <algorithm>

namespace clay::studio {
namespace {

constexpr double kClosingMmPerS = 15.0;  // two hands that take hold of a wall

render::PotView view_of(const servo::LiveProfile& profile) {
  render::PotView view;
  view.height_mm = profile.height_mm;
  view.rows.reserve(profile.size);
  for (std::size_t row = 0; row < profile.size; ++row)
    view.rows.push_back({profile.rows[row].outer_mm, profile.rows[row].inner_mm});
  return view;
}

}  // namespace

Result<void> StrokeController::begin(const SceneSpec& scene) {
  return history::Work::begin(scene).map(
      [&](history::Work&& work) { begin(scene, std::move(work)); });
}

Result<void> StrokeController::begin(const SceneSpec& scene, const Pot& pot) {
  return history::Work::begin(scene, pot).map([&](history::Work&& work) {
    begin(scene, std::move(work));
  });
}

Result<void> StrokeController::begin(WorkRecord record) {
  const SceneSpec scene = record.scenes.at(record.nodes.at(record.at).scene);
  return history::Work::open(std::move(record)).map([&](history::Work&& work) {
    begin(scene, std::move(work));
  });
}

void StrokeController::begin(const SceneSpec& scene, history::Work work) {
  release();
  scene_ = scene;
  if (work_ && (given_up_ || !work_->unsaved()) && work_->journal() != nullptr)
    work_->journal()->discard();
  given_up_ = false;
  work_.emplace(std::move(work));
  status_ = {};
  news_ = {};
  device_waits_ = device_ != nullptr;
  show_pot();
  if (!journals_ || work_->journal() != nullptr) return;
  if (auto journal = history::Journal::begin(work_->record()))
    work_->keep(std::move(*journal));
  else
    news_.error = journal.error();
}

Result<void> StrokeController::begin(history::Work work) {
  const WorkRecord& record = work.record();
  const SceneSpec scene = record.scenes.at(record.nodes.at(record.at).scene);
  begin(scene, std::move(work));
  return {};
}

void StrokeController::close() {
  release();
  if (work_ && work_->journal() != nullptr) work_->journal()->discard();
}

void StrokeController::show_pot() {
  moment_.reset();
  auto pot = work_->pot();
  if (pot) {
    pot_ = std::move(*pot);
    view_ = render::view_of(*pot_);
    crown_mm_ = 0.0;
  } else {
    news_.error = pot.error();
  }
}

Result<void> StrokeController::press(const Press& press) {
  if (device_) return {};  // the hand at the arm has the clay
  release();
  branch_here();
  device_waits_ = false;
  SceneSpec scene = scene_;
  scene.tool = press.tool;
  scene.removal.rate_per_s = press.rate_per_s;
  servo::LiveSettings settings = MouseDevice::servo_settings();
  closed_gap_mm_ = press.tool.mode == ToolMode::pinch ? press.tool.gap_mm.value_or(0.0) : 0.0;
  gap_mm_ = std::max(closed_gap_mm_, press.gap_mm);
  settings.gap_mm = gap_mm_;
  mouse_.begin_at(press.place_mm);
  return sit_down(scene, mouse_, settings);
}

Result<void> StrokeController::sit_down(const SceneSpec& scene, falcon::HapticDevice& device,
                                        const servo::LiveSettings& settings) {
  if (pot_->collapse)
    return failure(ErrorKind::bad_input,
                   can_undo() ? "The clay has fallen: undo takes the last stroke back"
                              : "The clay has fallen: it can be exported as it is");
  auto wheel = Wheel::build(scene, *pot_);
  if (!wheel) return tl::make_unexpected(wheel.error());
  auto sink = work_->begin_stroke(scene);
  if (!sink) return tl::make_unexpected(sink.error());
  auto recorder = servo::Recorder::create(**sink);
  const Pace pace = !threads_                ? Pace::stepped
                    : device.info().can_push ? Pace::real_time
                                             : Pace::thread;
  auto sitting = StrokeSession::begin(std::move(*wheel), device, clock_, recorder.get(), &trace_,
                                      settings, pace);
  if (!sitting) {
    (void)recorder->finish();
    (void)work_->end_stroke();  // without a pose it is none
    return tl::make_unexpected(sitting.error());
  }
  given_up_ = false;
  moment_.reset();
  scene_ = scene;
  recorder_ = std::move(recorder);
  sitting_ = std::move(*sitting);
  if (paused_) pause(true);
  status_ = {};
  last_ns_ = counted_ns_ = clock_.now_ns();
  counted_ticks_ = 0;
  tick_rate_hz_ = 0.0;
  return {};
}

void StrokeController::command(const servo::Command& command) noexcept {
  if (sitting_) (void)sitting_->command(command);
}

void StrokeController::pause(bool on) noexcept {
  paused_ = on;
  command({servo::CommandKind::pause, on ? 1.0 : 0.0});
}

void StrokeController::set_stiffness(double n_per_mm2) {
  if (scene_.force) scene_.force->stiffness_n_per_mm2 = n_per_mm2;
}

void StrokeController::release() {
  if (!sitting_) return;
  news_.stroke_ended = true;
  news_.ending = sitting_->end();
  status_ = sitting_->status();
  news_.poses = status_.poses;
  news_.ticks = status_.ticks;
  news_.ring_limit = status_.ring_limit;
  servo_ = {sitting_->loop().timing(), sitting_->loop().events(), sitting_->realtime()};
  const Pot felt = sitting_->wheel().pot();
  if (auto kept = recorder_->finish(); !kept)
    news_.error = kept.error();
  else if (recorder_->lost() > 0)
    news_.error = Error{ErrorKind::io,
                        "The stroke was kept up to where the machine was too slow to "
                        "record it; what came after is gone"};
  auto added = work_->end_stroke(&felt);
  if (!added) news_.error = added.error();
  sitting_.reset();
  recorder_.reset();
  show_pot();
  if (news_.ending == servo::Ending::device_lost) lose_device();
  device_waits_ = device_ != nullptr && news_.ending != servo::Ending::collapsed;
}

void StrokeController::undo() {
  release();
  if (work_->undo()) show_pot();
  device_waits_ = device_ != nullptr;
}

void StrokeController::redo() {
  release();
  if (work_->redo()) show_pot();
  device_waits_ = device_ != nullptr;
}

void StrokeController::go_to(history::NodeId node) {
  release();
  if (node != work_->at()) work_->go_to(node);
  show_pot();
  device_waits_ = device_ != nullptr;
}

void StrokeController::scrub(history::NodeId node, double seconds) {
  release();
  auto pot = work_->scrub(node, seconds);
  if (!pot) {
    news_.error = pot.error();
    return;
  }
  view_ = render::view_of(*pot);
  moment_ = Moment{node, seconds};
  device_waits_ = false;
}

void StrokeController::show_present() {
  if (!moment_) return;
  show_pot();
  device_waits_ = device_ != nullptr;
}

void StrokeController::branch_here() {
  if (!moment_) return;
  if (auto added = work_->branch(moment_->node, moment_->seconds); !added)
    news_.error = added.error();
  show_present();
}

Result<void> StrokeController::save(const std::string& path) {
  release();
  return work_->save(path);
}

void StrokeController::advance(std::int64_t now_ns) {
  if (!sitting_ && device_waits_ && work_ && !pot_->collapse) sit_with_device();
  if (!sitting_) return;
  if (gap_mm_ > closed_gap_mm_) {
    const double elapsed_s = 1e-9 * static_cast<double>(now_ns - last_ns_);
    gap_mm_ = std::max(closed_gap_mm_, gap_mm_ - kClosingMmPerS * elapsed_s);
    command({servo::CommandKind::gap, gap_mm_});
  }
  last_ns_ = now_ns;
  sitting_->advance(now_ns);
  look();
  count_ticks(now_ns);
  if (!sitting_->running()) release();
}

void StrokeController::look() {
  status_ = sitting_->status();
  const servo::LiveProfile* profile = sitting_->new_profile();
  if (profile == nullptr) return;
  view_ = view_of(*profile);
  crown_mm_ = profile->crown_mm;
}

/// Four times a second: a rate that can be read.
void StrokeController::count_ticks(std::int64_t now_ns) {
  constexpr std::int64_t kEveryNs = 250'000'000;
  if (now_ns - counted_ns_ < kEveryNs) return;
  tick_rate_hz_ = 1e9 * static_cast<double>(status_.ticks - counted_ticks_) /
                  static_cast<double>(now_ns - counted_ns_);
  counted_ns_ = now_ns;
  counted_ticks_ = status_.ticks;
}

}  // namespace clay::studio
