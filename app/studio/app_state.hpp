#pragma once
// The whole state of the window, without its drawing: document, hand, view model, user interface,
// and the jobs in the background. It needs a host, but no screen and no OpenGL.

#include "app/history/recovery.hpp"
#include "app/studio/device_watch.hpp"
#include "app/studio/fall_show.hpp"
#include "app/studio/file_dialog.hpp"
#include "app/studio/host.hpp"
#include "app/studio/scene_view.hpp"
#include "app/studio/view_model.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::studio {

struct AppState {
  AppState(Host& given, Settings remembered, std::function<void(std::string_view)> log_line)
      : host(given),
        settings(std::move(remembered)),
        stroke(document, given.clock(), given.real_time()),
        readings(given.real_time()),
        log(std::move(log_line)) {}

  Host& host;
  Settings settings;
  Document document;
  StrokeController stroke;
  Readings readings;
  SceneView scene;
  UiState ui;
  FallShow fall;
  Exporter exporter;
  FileDialog file_dialog;                ///< of the desktop, instead of a text field
  std::unique_ptr<DeviceWatch> devices;  ///< null: no device is looked for
  std::vector<history::Recoverable> recoverable;
  std::function<void(std::string_view)> log;  ///< events, one line each
  bool done = false;                          ///< the window may close

  [[nodiscard]] float scale() const { return settings.scale * host.content_scale(); }
  [[nodiscard]] double now_s() { return 1e-9 * static_cast<double>(host.frame_ns()); }
};

/// Valid until the state changes its place; made for every frame and every action.
[[nodiscard]] ViewModel view_model(AppState& state);

/// Carries out an action. Actions that replace an unsaved work are kept by a question first
/// (UnsavedDialog). Errors appear as a banner and in the log.
void apply(AppState& state, const Action& action);
/// In order; `actions` is empty afterwards.
void apply_all(AppState& state, Actions& actions);

/// What happens by itself, once a frame: devices come and go, the servo ticks, background jobs end.
void update(AppState& state);

// --- For actions and updates. --------------------------------------------------------------------
/// Banner and log.
void report(AppState& state, const Error& error);
/// The same, unless it succeeded; whether it did.
bool succeeded(AppState& state, const Result<void>& result);
/// Ends the stroke and saves; whether that succeeded.
bool save_document(AppState& state, const std::filesystem::path& path);
/// A note that disappears after some seconds.
void note(AppState& state, Grade grade, std::string text, double seconds);

}  // namespace clay::studio
