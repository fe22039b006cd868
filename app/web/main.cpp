// The page's program: the window in a canvas. The script page/page.js sends the events of the
// browser and calls claystack_frame for each frame.

#include "app/studio/studio.hpp"
#include "app/web/page_worker.hpp"
#include "app/web/pot_text.hpp"
#include "app/web/web_hid.hpp"
#include "app/web/web_host.hpp"
#include "app/web/window_reader.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "core/worker.hpp"

#include <emscripten.h>
#include <emscripten/html5.h>
#include <fmt/format.h>
#include <imgui_internal.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::web {
namespace {

EM_JS(void, page_log, (const char* text, int size),
      { Module["page"].log(UTF8ToString(text, size)); });
EM_JS(void, page_fail, (const char* text), { Module["page"].fail(UTF8ToString(text)); });
EM_JS(bool, page_stores, (), { return Module["page"].stores(); });
EM_JS(void, page_theme, (const char* name), { Module["page"].setTheme(UTF8ToString(name)); });
EM_JS(void, page_show_controls, (const char* json),
      { Module["page"].showControls(UTF8ToString(json)); });
EM_JS(void, page_announce, (const char* text), { Module["page"].announce(UTF8ToString(text)); });

constexpr const char* kCanvas = "#canvas";
constexpr int kFramesAfterEvent = 3;
constexpr double kBetweenReadingsMs = 250.0;

std::unique_ptr<WebHost> host;
std::unique_ptr<studio::Studio> window;
int frames_wanted = kFramesAfterEvent;
bool damaged = true;
std::string announced;                     // by page_announce
std::optional<studio::Theme> shown_theme;  // by page_theme
std::string report;                        // of claystack_report
std::string shown_controls;                // by page_show_controls
bool unread = true;                        // the window has changed since the last reading
double read_ms = 0.0;

void take(studio::Input input) {
  if (!window) return;
  window->take(std::move(input));
  frames_wanted = kFramesAfterEvent;
}

/// Announces the figures to screen readers.
void announce() {
  auto summary = summary_of(window->state());
  if (!summary || *summary == announced) return;
  announced = std::move(*summary);
  page_announce(announced.c_str());
}

/// Gives the controls and texts of the window to screen readers, but not during a stroke.
void read_window(double page_ms) {
  if (!unread || window->state().stroke.throwing() || page_ms - read_ms < kBetweenReadingsMs)
    return;
  unread = false;
  read_ms = page_ms;
  WindowReader reader;
  reader.begin();
  window->repeat_panels();
  std::string controls = reader.end();
  if (controls == shown_controls) return;
  shown_controls = std::move(controls);
  page_show_controls(shown_controls.c_str());
}

/// The rest of the page has the theme of the window.
void show_theme() {
  const studio::Theme theme = window->state().settings.theme;
  if (shown_theme == theme) return;
  shown_theme = theme;
  page_theme(theme == studio::Theme::light ? "light" : "dark");
}

studio::Theme theme_of(bool light) { return light ? studio::Theme::light : studio::Theme::dark; }

/// The studio draws into separate canvases, so the page needs neither samples nor depth.
bool create_context() {
  EmscriptenWebGLContextAttributes wish;
  emscripten_webgl_init_context_attributes(&wish);
  wish.majorVersion = 2;
  wish.alpha = wish.antialias = wish.depth = wish.stencil = false;
  // Otherwise the first draw call of a frame clears the pixels of an earlier blit.
  wish.preserveDrawingBuffer = true;
  const auto context = emscripten_webgl_create_context(kCanvas, &wish);
  return context > 0 && emscripten_webgl_make_context_current(context) == EMSCRIPTEN_RESULT_SUCCESS;
}

/// Removes files that no longer exist from the settings. The page keeps saved works; it keeps other
/// opened files only until it is closed.
void forget_missing(studio::Settings& settings) {
  const auto missing = [](const std::string& path) {
    std::error_code ignored;
    return !std::filesystem::exists(path, ignored);
  };
  std::erase_if(settings.recent, missing);
  std::erase_if(settings.processes, missing);
  if (settings.process.ends_with(".json") && missing(settings.process)) settings.process.clear();
}

void begin(bool light, bool fingers) {
  if (!create_context()) return page_fail("This browser does not offer WebGL 2");
  host = std::make_unique<WebHost>(fingers);
  auto loaded = studio::load_settings(studio::settings_path());
  if (!loaded.settings.theme_chosen) loaded.settings.theme = theme_of(light);
  loaded.settings.folder =
      std::filesystem::path(studio::settings_path().root_path() / "home" / "web_user").string();
  forget_missing(loaded.settings);
  auto made = studio::Studio::create(*host, loaded.settings, [](std::string_view line) {
    page_log(line.data(), static_cast<int>(line.size()));
  });
  if (!made) return page_fail(made.error().message.c_str());
  window = std::move(*made);
  studio::AppState& state = window->state();
  if (loaded.may_save)
    state.settings_file = studio::SettingsFile(studio::settings_path(), state.settings);
  state.document.keep_journals();
  state.devices = std::make_unique<studio::DeviceWatch>(look_for_hid(host->clock()));
  // If another tab stores the works, they are in use there.
  if (page_stores()) state.recoverable = history::recoverable();
  if (!loaded.note.empty()) state.ui.notices.show(studio::Grade::warning, loaded.note);
  if (!state.recoverable.empty())
    state.log(fmt::format("recovery offered: {}", state.recoverable.size()));
  state.log("window open");
}

}  // namespace
}  // namespace clay::web

using namespace clay;
using namespace clay::web;

extern "C" {
/// Returns true if the next frame is wanted at once.
EMSCRIPTEN_KEEPALIVE bool claystack_frame(double page_ms) {
  if (!window) return false;
  PeriodicWorker::run_all();
  host->begin_frame(page_ms);
  if (window->frame(std::exchange(damaged, false) ? studio::Painting::always
                                                  : studio::Painting::if_changed))
    unread = true;
  read_window(page_ms);
  announce();
  show_theme();
  if (frames_wanted > 0) --frames_wanted;
  const bool reads = unread && !window->state().stroke.throwing();
  return frames_wanted > 0 || reads || window->wakeful();
}
/// The browser's preferred theme has changed: the window uses it, unless the user has chosen a
/// theme.
EMSCRIPTEN_KEEPALIVE void claystack_prefers(bool light) {
  if (!window || window->state().settings.theme_chosen) return;
  window->state().settings.theme = theme_of(light);
  window->state().ui.restyle = true;
  frames_wanted = kFramesAfterEvent;
}
EMSCRIPTEN_KEEPALIVE void claystack_resize(int width_px, int height_px, float scale) {
  if (!window) return;
  if (scale != host->content_scale()) window->state().ui.restyle = true;
  host->resize({width_px, height_px}, scale);
  damaged = true;
  frames_wanted = kFramesAfterEvent;
}
/// `strength`: of a pen, 0 to 1; negative: a mouse or a finger.
EMSCRIPTEN_KEEPALIVE void claystack_pointer(float x_px, float y_px, double strength) {
  take(studio::PointerMoved{{x_px, y_px}, strength < 0.0 ? std::nullopt : std::optional(strength)});
}
EMSCRIPTEN_KEEPALIVE void claystack_gamepad_plugged(const char* name) {
  take(studio::GamepadPlugged{name});
}
EMSCRIPTEN_KEEPALIVE void claystack_gamepad(double left_x, double left_y, double right_x,
                                            double right_y, double left_trigger,
                                            double right_trigger, unsigned buttons) {
  take(studio::GamepadChanged{
      {{left_x, left_y}, {right_x, right_y}, left_trigger, right_trigger, buttons}});
}
EMSCRIPTEN_KEEPALIVE void claystack_button(int button, bool down, unsigned mods) {
  take(studio::ButtonChanged{static_cast<studio::MouseButton>(button), down, mods});
}
EMSCRIPTEN_KEEPALIVE void claystack_scroll(float steps) { take(studio::Scrolled{steps}); }
EMSCRIPTEN_KEEPALIVE void claystack_key(int key, bool down, bool repeated, unsigned mods) {
  take(studio::KeyChanged{key, down, repeated, mods});
}
EMSCRIPTEN_KEEPALIVE void claystack_text(unsigned character) {
  take(studio::TextTyped{static_cast<char32_t>(character)});
}
EMSCRIPTEN_KEEPALIVE void claystack_paste(const char* text) {
  if (host) host->paste(text);
}
/// Works of a crash that the gallery offers.
EMSCRIPTEN_KEEPALIVE int claystack_recoverable() {
  return window ? static_cast<int>(window->state().recoverable.size()) : 0;
}
EMSCRIPTEN_KEEPALIVE void claystack_open(const char* path) { take(studio::FilesDropped{{path}}); }
/// A screen reader has pressed the control with this number, see window_reader.hpp.
EMSCRIPTEN_KEEPALIVE void claystack_press(unsigned id) {
  if (!window) return;
  ImGui::ActivateItem(id);
  frames_wanted = kFramesAfterEvent;
}
/// Whether gestures and the key Tab are for an open dialog or menu, not for the pot.
EMSCRIPTEN_KEEPALIVE bool claystack_dialog_open() {
  return window && (!window->state().ui.shows<studio::NoDialog>() ||
                    ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
}
/// Whether a text field takes characters. A phone then shows its keyboard.
EMSCRIPTEN_KEEPALIVE bool claystack_typing() { return window && ImGui::GetIO().WantTextInput; }
/// True over the pot, false over panels and dialogs.
EMSCRIPTEN_KEEPALIVE bool claystack_over_pot() {
  return window && window->state().ui.shows<studio::NoDialog>() && !ImGui::GetIO().WantCaptureMouse;
}
/// The pot in words. Valid until the next call.
EMSCRIPTEN_KEEPALIVE const char* claystack_report() {
  report = window ? report_of(window->state()) : std::string();
  return report.c_str();
}
/// The page is hidden: a stroke that is under way ends.
EMSCRIPTEN_KEEPALIVE void claystack_hide() {
  if (!window) return;
  window->state().stroke.release();
  PeriodicWorker::run_all();
}
/// Writes the pot on the wheel in its compact form. False: there is none.
EMSCRIPTEN_KEEPALIVE bool claystack_write_pot(const char* path) {
  if (!window || !window->state().document.has_work()) return false;
  return publish(path, write_pot(window->state().document.pot(), PotEncoding::cbor)).has_value();
}
EMSCRIPTEN_KEEPALIVE void claystack_notice(const char* text) {
  if (!window) return;
  window->state().ui.notices.show(studio::Grade::warning, text);
  frames_wanted = kFramesAfterEvent;
}
EMSCRIPTEN_KEEPALIVE void claystack_answered(int worker, const char* message, int size) {
  PageWorker::receive(worker, {message, static_cast<std::size_t>(size)});
  frames_wanted = kFramesAfterEvent;
}
EMSCRIPTEN_KEEPALIVE void claystack_stage(int worker, const char* text) {
  PageWorker::show_stage(worker, text);
  frames_wanted = kFramesAfterEvent;
}
}

int main(int argc, char** argv) {
  begin(argc > 1 && argv[1] == std::string_view("light"),
        argc > 2 && argv[2] == std::string_view("fingers"));
  return 0;
}
