#pragma once
// What panels, actions and the view work on. Plain on purpose: a panel draws from it and changes
// it, and knows no other panel.

#include "app/history/recovery.hpp"
#include "app/studio/device_watch.hpp"
#include "app/studio/exporter.hpp"
#include "app/studio/fall_show.hpp"
#include "app/studio/file_dialog.hpp"
#include "app/studio/host.hpp"
#include "app/studio/importing.hpp"
#include "app/studio/notices.hpp"
#include "app/studio/readings/readings.hpp"
#include "app/studio/scene_view.hpp"
#include "app/studio/settings.hpp"
#include "app/studio/stroke_controller.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace clay::studio {

/// What lies over the view; one at a time.
enum class Overlay {
  none,
  gallery,
  shortcuts,
  quit_prompt,  ///< before anything that would end a work that is not saved
  open_file,
  save_file,
  export_files,
  import_drawing,
  settings,
};

/// Something to know about a place of the pot.
struct Mark {
  glm::dvec2 place_mm{0.0};  ///< (rho, y)
  std::string text;
};

/// The card of an export, and what came of it.
struct ExportCard {
  ExportWish wish, rehearsed;  ///< `rehearsed`: what `shown` is of
  std::optional<solid::ExportReport> shown;
  std::string problem;               ///< why there is nothing to show
  std::vector<std::string> written;  ///< files of the last export; empty: none yet
  std::string said;                  ///< how it ended
};

struct AppState {
  AppState(Host& given, Settings remembered, std::function<void(std::string_view)> log_line)
      : host(given),
        settings(std::move(remembered)),
        potter(given.clock(), given.real_time()),
        readings(given.real_time()),
        log(std::move(log_line)) {}

  Host& host;
  Settings settings;
  StrokeController potter;
  Readings readings;
  SceneView view;
  Notices notices;
  std::string hand_told;                      ///< of the arm that is there, or was
  bool hand_asks = false;                     ///< that is a request
  std::string hand_is;                        ///< in the log: the guard's state
  std::function<void(std::string_view)> log;  ///< events, a line each
  Fonts fonts;
  std::unique_ptr<DeviceWatch> devices;    ///< null: nobody looks for any
  std::vector<history::Recoverable> left;  ///< by programs that died, newest first
  Overlay overlay = Overlay::gallery;
  bool restyle = true;                     ///< theme or scale have changed
  bool done = false;                       ///< the window may close
  std::function<void(AppState&)> waiting;  ///< what an unsaved work holds up, until it is answered
  bool save_first = false;                 ///< the answer was to save: then it goes on
  std::string reveal;  ///< id of a panel that has just been opened: its column scrolls to it
  std::filesystem::path file;  ///< of the work; empty: it has none yet
  std::string path_box;        ///< what is typed in the box for names of files
  FileDialog dialog;           ///< of the desktop, in place of the box where there is one
  Exporter exporter;
  ExportCard exporting;
  ImportCard importing;
  FallShow fall;
  std::vector<Mark> marks;  ///< of the pot `marked`
  history::SharedPot marked;
  double rate_per_s = 20.0;  ///< of the scene, at kNominalRpm

  [[nodiscard]] float scale() const { return settings.scale * host.content_scale(); }
  [[nodiscard]] const Palette& colours() const { return palette(settings.theme); }
};

/// A scene's removal rate is of a wheel that turns so fast; it goes in proportion.
inline constexpr double kNominalRpm = 120.0;
[[nodiscard]] double clay_rate_per_s(const AppState& shop);

/// As a banner and in the log.
void tell(AppState& shop, const Error& error);
/// Back to the view, or to the gallery where there is no work yet.
void close_overlay(AppState& shop);

/// The work that the potter has now: its tool is chosen, the view is on it.
void show_work(AppState& shop);

/// Does it at once, or where the work has changed since it was saved, after the question whether to
/// keep it. `prompt`: a word for the log.
void ask_first(AppState& shop, const char* prompt, std::function<void(AppState&)> then);
/// The answers. `keep_it` saves before it goes on, and asks for a name where there is none.
void keep_it(AppState& shop);
void let_it_go(AppState& shop);

/// A new work from a scene; the tool that is chosen becomes the scene's.
void begin_work(AppState& shop, const SceneSpec& scene);
/// Goes on with the work of a program that died, or drops it for good.
void recover_work(AppState& shop, std::size_t left);
void discard_work(AppState& shop, std::size_t left);

/// An arm that has appeared takes the clay, with its stiffness within what it can render, once the
/// mouse has let go; what is wrong with one is told.
void look_at_devices(AppState& shop);
/// The arm has gone: why is told, and one that comes is looked for.
void lose_arm(AppState& shop, const Error& why);
/// What only the hand at the arm can do stands in a banner for as long as it is to be done.
void look_at_hand(AppState& shop);
/// Of an arm that throws: what it does, or needs. Empty with anything that can't push.
[[nodiscard]] std::string words_of_hand(const AppState& shop);
/// The guard keeps the force at zero until somebody asks for it.
[[nodiscard]] bool waits_for_rearm(const AppState& shop);

/// For a pot that comes without one: its proportions.
[[nodiscard]] SceneSpec scene_for(const Pot& pot, const std::string& name);
/// Any file that the studio knows: a scene, a pot, a work, a process; of a drawing the card that
/// imports it.
void open_file(AppState& shop, const std::filesystem::path& path);
/// Limits of a process of the user's own, a .json file: for the walls, and for the export where its
/// card is open.
void take_process(AppState& shop, const std::filesystem::path& path);
/// By the ending of the name; whether it was written. What waits for it goes on.
bool save_to(AppState& shop, const std::filesystem::path& path);
/// Where the box for names begins: the folder of the last file.
void ask_for_open(AppState& shop);
void ask_for_save(AppState& shop);
void ask_for_process(AppState& shop);
/// What the desktop's dialog was answered.
void look_at_dialog(AppState& shop);

/// The drawing of the card becomes the work.
void take_import(AppState& shop);

/// The card of an export, with what was chosen last.
void ask_for_export(AppState& shop);
void write_export(AppState& shop);
/// Once a frame: the rehearsal of what is chosen, what has ended, and marks on the pot.
void look_at_export(AppState& shop);

}  // namespace clay::studio
