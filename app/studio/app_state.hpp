#pragma once
// The complete state of the window, without drawing: document, stroke, view model, user interface
// and background jobs. It needs a host, but neither screen nor OpenGL.

#include "app/history/recovery.hpp"
#include "app/studio/device_watch.hpp"
#include "app/studio/fall_show.hpp"
#include "app/studio/file_dialog.hpp"
#include "app/studio/gamepad_hand.hpp"
#include "app/studio/guide/guide.hpp"
#include "app/studio/guide/play.hpp"
#include "app/studio/host.hpp"
#include "app/studio/scene_view.hpp"
#include "app/studio/view_model.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::studio {

struct AppState {
  AppState(Host& given, Settings remembered, std::function<void(std::string_view)> log_line)
      : host(given),
        settings(std::move(remembered)),
        stroke(document, given.clock(), given.threads()),
        readings(given.real_time()),
        guide(given.threads()),
        pictures(given.threads()),
        log(std::move(log_line)) {}

  Host& host;
  Settings settings;
  SettingsFile settings_file;  ///< by default, settings are not saved
  Document document;
  StrokeController stroke;
  Readings readings;
  Guide guide;
  Play play;  ///< of the guide's strokes
  SceneView scene;
  GamepadHand gamepad;
  UiState ui;
  FallShow fall;
  Exporter exporter;
  PictureWriter pictures;
  FileDialog file_dialog;                ///< the desktop's dialog, used instead of a text field
  std::unique_ptr<DeviceWatch> devices;  ///< null: do not look for devices
  std::vector<history::Recoverable> recoverable;
  std::function<void(std::string_view)> log;  ///< receives events, one line each
  std::optional<Error> last_error;            ///< the last one that was reported
  bool done = false;                          ///< the window may close

  [[nodiscard]] float scale() const { return settings.scale * host.content_scale(); }
  [[nodiscard]] double now_s() { return 1e-9 * static_cast<double>(host.frame_ns()); }
};

/// Valid until the state is moved; created for every frame and every action.
[[nodiscard]] ViewModel view_model(AppState& state);

/// Executes an action. An action that would replace an unsaved work waits in an UnsavedDialog.
/// Errors appear as a banner and in the log.
void apply(AppState& state, const Action& action);
/// Executes them in order; `actions` is empty afterwards.
void apply_all(AppState& state, Actions& actions);

/// Once a frame: connects and disconnects devices, advances the servo, collects finished background
/// jobs.
void update(AppState& state);

// --- For actions and updates. --------------------------------------------------------------------
/// Shows an error as a banner and logs it.
void report(AppState& state, const Error& error);
/// The same for a file that could not be opened. Removes a file that no longer exists from the
/// recent files.
void report_unopened(AppState& state, const std::filesystem::path& path, const Error& error);
/// Reports the error, if there is one. Returns true on success.
bool succeeded(AppState& state, const Result<void>& result);
/// Ends the stroke and the moment shown, so that a file holds the pot that is shown.
void show_present(AppState& state);
/// Shows the current pot and saves. Returns true on success.
bool save_document(AppState& state, const std::filesystem::path& path);
/// Shows a note that disappears after some seconds.
void note(AppState& state, Grade grade, std::string text, double seconds);

}  // namespace clay::studio
