#pragma once
// What panels, actions and the view work on. Plain on purpose: a panel draws from it and changes
// it, and knows no other panel.

#include "studio/device_watch.hpp"
#include "studio/host.hpp"
#include "studio/notices.hpp"
#include "studio/potter.hpp"
#include "studio/scene_view.hpp"
#include "studio/settings.hpp"
#include "work/recovery.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace clay::studio {

/// What lies over the view; one at a time.
enum class Overlay { none, gallery, shortcuts, quit_prompt, open_file, save_file };

struct Workshop {
  Workshop(Host& given, Settings remembered, std::function<void(std::string_view)> log_line)
      : host(given),
        settings(std::move(remembered)),
        potter(given.clock(), given.real_time()),
        log(std::move(log_line)) {}

  Host& host;
  Settings settings;
  Potter potter;
  SceneView view;
  Notices notices;
  std::function<void(std::string_view)> log;  ///< events, a line each
  Fonts fonts;
  std::unique_ptr<DeviceWatch> devices;  ///< null: nobody looks for any
  std::vector<work::Recoverable> left;   ///< by programs that died, newest first
  Overlay overlay = Overlay::gallery;
  bool restyle = true;  ///< theme or scale have changed
  bool paused = false;  ///< nothing that the hand does reaches the clay
  bool done = false;    ///< the window may close
  bool quit_after_saving = false;
  std::filesystem::path file;  ///< of the work; empty: it has none yet
  std::string path_box;        ///< what is typed in the box for names of files
  double rate_per_s = 20.0;    ///< of the scene, at kNominalRpm

  [[nodiscard]] float scale() const { return settings.scale * host.content_scale(); }
  [[nodiscard]] const Palette& colours() const { return palette(settings.theme); }
};

/// A scene's removal rate is of a wheel that turns so fast; it goes in proportion.
inline constexpr double kNominalRpm = 120.0;
[[nodiscard]] double clay_rate_per_s(const Workshop& shop);

/// As a banner and in the log.
void tell(Workshop& shop, const Error& error);
/// Back to the view, or to the gallery where there is no work yet.
void close_overlay(Workshop& shop);

/// The work that the potter has now: its tool is chosen, the view is on it.
void show_work(Workshop& shop);

/// A new work from a scene; the tool that is chosen becomes the scene's.
void begin_work(Workshop& shop, const SceneSpec& scene);
/// Goes on with the work of a program that died, or drops it for good.
void recover_work(Workshop& shop, std::size_t left);
void discard_work(Workshop& shop, std::size_t left);

/// An arm that has appeared takes the clay, with its stiffness within what it can render; what is
/// wrong with one is told.
void look_at_devices(Workshop& shop);

/// Any file that the studio knows: a scene, a pot, a work.
void open_file(Workshop& shop, const std::filesystem::path& path);
/// By the ending of the name; whether it was written. A window that waits for this to close does.
bool save_to(Workshop& shop, const std::filesystem::path& path);

}  // namespace clay::studio
