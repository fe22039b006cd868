// Updates between two frames: devices connect and disconnect, strokes end, a pot falls, the
// desktop's file dialog and background jobs return their results.

#include "app/render/pot_view.hpp"
#include "app/servo/words.hpp"
#include "app/studio/app_state.hpp"
#include "app/studio/fall_show.hpp"
#include "app/studio/output_dialogs.hpp"
#include "app/studio/panels/timeline.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace clay::studio {
namespace {

constexpr double kDeviceNoteS = 6.0, kJournalNoteS = 6.0, kCutNoteS = 8.0;
// A homed device reports its state with its first frames.
constexpr std::uint64_t kTicksUntilHomed = 250;

// --- Devices. ------------------------------------------------------------------------------------

/// Replaces the banner about the arm if it is still shown.
void show_arm_notice(AppState& state, Grade grade, const std::string& text, double until_s = 0.0) {
  state.ui.notices.withdraw_state(std::exchange(state.ui.arm.shown, text));
  if (!text.empty()) state.ui.notices.show_state(grade, text, until_s);
}

/// A newly opened device replaces the mouse once the mouse has released the clay.
void update_devices(AppState& state) {
  if (!state.devices) return;
  if (const std::string problem = state.devices->take_problem(); !problem.empty())
    report(state, {ErrorKind::bad_input, problem + "; the mouse remains in use"});
  if (state.stroke.throwing() && !state.stroke.has_device()) return;
  auto device = state.devices->take();
  if (!device) {
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left))  // not while a slider is dragged
      state.stroke.hold(tool_of(state.settings.tool), state.settings.wheel_rpm);
    return;
  }
  const falcon::DeviceInfo& info = device->info();
  state.log("device: " + info.name);
  show_arm_notice(state, Grade::note, info.name + " is connected and in use",
                  state.now_s() + kDeviceNoteS);
  servo::LiveSettings settings;
  settings.buttons = info.can_push ? servo::kFalconButtons : servo::kTwoButtons;
  state.stroke.take(std::move(device), settings);
}

void lose_device(AppState& state, const Error& why) {
  if (state.devices) state.devices->look_again();
  const Error error{why.kind, why.message + "; the mouse is in use now"};
  state.log("error: " + error.message);
  state.last_error = error;
  show_arm_notice(state, Grade::error, error.message);
}

/// The banner about an action at the arm stays until the user has done it.
void update_arm_notice(AppState& state) {
  const bool in_use = state.stroke.throwing() && state.stroke.has_motors();
  const servo::LiveStatus& status = state.stroke.status();
  ArmReport& arm = state.ui.arm;
  const std::string guard = in_use ? servo::name_of(status.guard) : "";
  if (guard != arm.guard && !guard.empty()) state.log("force: " + guard);
  arm.guard = guard;
  if (!in_use) return;
  const bool homing =
      status.device == falcon::DeviceState::needs_homing && status.ticks > kTicksUntilHomed;
  const bool requests = homing || servo::waits_for_rearm(status);
  const std::string text = requests ? view_model(state).arm_text() : std::string();
  const bool requested = std::exchange(arm.requests, requests && !text.empty());
  if (arm.requests ? text != arm.shown : requested) show_arm_notice(state, Grade::warning, text);
}

// --- Strokes. ------------------------------------------------------------------------------------

void update_strokes(AppState& state) {
  if (const auto problem = state.document.take_problem()) report(state, *problem);
  const StrokeNews news = state.stroke.take_news();
  if (news.device_lost)
    lose_device(state, *news.error);
  else if (news.error)
    report(state, *news.error);
  if (!news.stroke_ended) return;
  if (state.document.has_work() && !state.stroke.by_hand())
    state.scene.follow(state.stroke.view(), news.before, state.settings.tool.mode);
  state.log(fmt::format("stroke ended: {} poses, {} ticks", news.poses, news.ticks));
  if (!news.nothing_cut.empty()) note(state, Grade::note, news.nothing_cut, kCutNoteS);
  if (news.ending == servo::Ending::collapsed) {
    state.fall.begin(state.document.shared_pot(), state.now_s());
    state.ui.notices.show(Grade::warning, fmt::format("The pot has fallen: {}.",
                                                      fall_reason(*state.document.pot().collapse)));
    state.ui.notices.keep_answer_while([](const Document& document) { return document.fallen(); });
  }
  if (news.ring_limit)
    state.ui.notices.show(Grade::warning,
                          "The pot has reached the maximum height for this lump: the rest of the "
                          "clay cannot rise above the rim.");
}

/// A stroke of a device does not end by itself. In a lesson it ends when the tool leaves the clay,
/// and the next one is planned. The window cannot lead a tool that a hand holds.
void guide_device(AppState& state) {
  if (!state.stroke.has_device()) return;
  if (state.stroke.has_left_clay()) state.stroke.release();
  if (state.guide.demonstration() == Demonstration::none) return;
  state.guide.demonstrate(Demonstration::none);
  note(state, Grade::warning,
       state.stroke.device_name() +
           " holds the tool: throw the steps with it, or disconnect it and choose Show me",
       kDeviceNoteS);
}

/// A new step selects its tool.
void update_guide(AppState& state) {
  if (state.guide.active()) guide_device(state);
  state.guide.update(state.document, state.stroke);
  if (!state.guide.active()) return;
  if (state.guide.take_new_step() && !state.stroke.by_hand()) {
    const LessonPlan& plan = *state.guide.plan();
    choose(state.guide.tool(), state.settings.tool);
    state.settings.tool.mode = plan.mode;
    if (plan.gap_mm > 0.0) {
      state.settings.tool.gap_mm = plan.gap_mm;
      state.settings.tool.gap_share = 0.0;
    }
    state.log(fmt::format("step: {}", state.guide.stroke(plan.step).name));
  }
  state.play.advance(state);
}

/// The animation of a fall ends early if another pot is shown.
void update_fall(AppState& state) {
  if (!state.fall.running()) return;
  const bool fallen =
      state.document.fallen() && !state.document.scrubbing() && !state.stroke.throwing();
  if (!fallen) return state.fall.end();
  if (const auto place = state.fall.at(state.now_s(), state.document.view()))
    state.document.show_fall(*place);
  else
    apply(state, GoToStroke{state.document.work().at()});
}

// --- Crash protection. ---------------------------------------------------------------------------

constexpr double kJournalRetryS = 5.0;

/// A full disk ends the journal. The banner stays until a new one could be written.
void update_journal(AppState& state) {
  JournalWatch& watch = state.ui.journal;
  const auto problem = state.document.journal_problem();
  if (problem && watch.shown.empty()) {
    watch.shown = "A crash would lose strokes: " + problem->message +
                  ". Save the work (Ctrl+S), to another disk if this one is full.";
    watch.retry_s = state.now_s() + kJournalRetryS;
    state.log("error: " + watch.shown);
  }
  if (watch.shown.empty()) return;
  if (problem && state.now_s() > watch.retry_s && !state.document.work().in_stroke()) {
    state.document.renew_journal();
    watch.retry_s = state.now_s() + kJournalRetryS;
    return;
  }
  state.ui.notices.withdraw_state(watch.shown);
  if (problem) return state.ui.notices.show_state(Grade::error, watch.shown);
  watch.shown.clear();
  state.ui.notices.show_state(Grade::note, "Every stroke is protected against a crash again",
                              state.now_s() + kJournalNoteS);
}

// --- Files. --------------------------------------------------------------------------------------

/// The folder of a picture, or of an export.
void choose_folder(AppState& state, const std::string& folder) {
  if (state.ui.shows<PictureDialog>()) {
    PictureFile file = state.ui.pictures.file;
    file.folder = folder;
    return apply(state, EditPicture{file});
  }
  ExportChoices choices = state.ui.exporting.choices;
  choices.folder = folder;
  apply(state, EditExport{choices});
}

void update_file_dialog(AppState& state) {
  const FileDialog::Kind kind = state.file_dialog.kind();
  const auto chosen = state.file_dialog.take();
  if (!chosen || chosen->empty()) return;
  switch (kind) {
    case FileDialog::Kind::open:
      apply(state, OpenFile{*chosen});
      break;
    case FileDialog::Kind::process:
      apply(state, UseProcess{*chosen});
      break;
    case FileDialog::Kind::target:
      apply(state, UseTarget{*chosen});
      break;
    case FileDialog::Kind::save:
      apply(state, SaveFile{*chosen, true});  // the desktop's dialog has asked the user
      break;
    case FileDialog::Kind::folder:
      choose_folder(state, *chosen);
      break;
  }
}

/// A standing outline of at most kThumbRows rows.
render::PotView thumb_of(const Pot& pot) {
  constexpr std::size_t kThumbRows = 96;
  const render::PotView whole = render::view_of(pot);
  render::PotView thumb;
  thumb.height_mm = whole.height_mm;
  const std::size_t rows = std::min(whole.rows.size(), kThumbRows);
  for (std::size_t i = 0; i < rows; ++i)
    thumb.rows.push_back(whole.rows[i * whole.rows.size() / rows]);
  return thumb;
}

/// One a frame, the nearest first, so that no frame replays more than a stroke.
void update_thumbs(AppState& state) {
  UiState& ui = state.ui;
  ui.thumbs_missing = false;
  if (!state.document.has_work() || state.stroke.by_hand()) return;
  const history::Work& work = state.document.work();
  std::vector<history::NodeId> wanted{0};
  for (const TimelineCard& card : timeline_of(work)) wanted.push_back(card.node);
  const auto missing =
      std::ranges::find_if(wanted, [&](history::NodeId node) { return !ui.thumbs.contains(node); });
  if (missing == wanted.end()) return;
  const auto pot = state.document.pot_at(*missing);
  ui.thumbs[*missing] = pot ? thumb_of(**pot) : render::PotView();
  ui.thumbs_missing = missing + 1 != wanted.end();
}

}  // namespace

void update(AppState& state) {
  const std::int64_t now_ns = state.host.frame_ns();
  state.ui.notices.expire(state.now_s(), state.document);
  update_devices(state);
  update_file_dialog(state);
  update_thumbs(state);
  update_export(state);
  update_picture(state);
  state.gamepad.advance(state);
  state.stroke.advance(now_ns);
  state.host.clock().sleep_until_ns(now_ns);  // in case no servo has advanced it
  update_strokes(state);
  update_guide(state);
  update_journal(state);
  update_arm_notice(state);
  update_fall(state);
  (void)succeeded(state, state.settings_file.update(state.settings, state.now_s()));
  state.ui.notices.appear_in(state.ui.dialog.index());
}

}  // namespace clay::studio
