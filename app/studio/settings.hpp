#pragma once
// Settings of the window that are kept between runs.

#include "app/studio/readings/goal.hpp"
#include "app/studio/style.hpp"
#include "app/studio/tool_choice.hpp"
#include "app/studio/units.hpp"
#include "claystack/core/result.hpp"
#include "core/material.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace clay::studio {

inline constexpr double kSlowestHandMmPerS = 10.0, kFastestHandMmPerS = 200.0;
/// Stiffness of the contact [N/mm^2].
inline constexpr double kSoftestClay = 1e-4, kStiffestClay = 10.0;
/// Maximum advance of the tool into the clay per turn of the wheel, with the mouse [mm].
inline constexpr double kSoftestBiteMm = 0.5, kFirmestBiteMm = 20.0, kUsualBiteMm = 8.0;
/// The bite of a press of this strength, 0 (soft) to 1 (firm).
[[nodiscard]] double bite_at(double strength) noexcept;
inline constexpr std::size_t kMostRecent = 8, kMostProcesses = 4;
inline constexpr double kSlowestRpm = 20.0, kFastestRpm = 240.0;

struct Settings {
  Theme theme = Theme::dark;
  bool theme_chosen = false;  ///< by the user; until then a page follows its browser
  float scale = 1.0f;  ///< multiplies the scale of the screen; kSmallestScale to kLargestScale
  LengthUnit unit = LengthUnit::mm;
  double wheel_rpm = 120.0;  ///< kSlowestRpm to kFastestRpm
  ToolChoice tool;
  bool wall_map = false;       ///< show wall thickness as colours on the pot
  Material material = kWet;    ///< the clay or glaze that is shown
  bool throwing_lines = true;  ///< show lines and specks, which are not in the pot
  bool full_section = false;   ///< show both halves of the section
  std::string process;         ///< process for walls and exports: a name or a file; empty: none
  std::vector<std::string> processes;  ///< custom process files, newest first
  PotGoal goal;                        ///< the size and the capacity that the pot is to have
  bool hints = true;                   ///< the first-run hint has not been closed yet
  std::map<std::string, bool> open;    ///< unfolded panels by id; others have their default
  std::string folder;                  ///< of exports and saved files; empty: none yet
  std::vector<std::string> recent;     ///< files, newest first, at most kMostRecent
  double bite_mm = kUsualBiteMm;       ///< strength of the hand, kSoftestBiteMm to kFirmestBiteMm
  /// Maximum tool speed in the clay, kSlowestHandMmPerS to kFastestHandMmPerS.
  double pressing_mm_s = 80.0;
};

/// Puts a file that was opened or saved first in the recent ones.
void remember(Settings& settings, const std::filesystem::path& path);
/// Forgets a recent file that no longer exists.
void forget_if_missing(Settings& settings, const std::filesystem::path& path);
/// Selects a custom process file and puts it first in the list.
void remember_process(Settings& settings, const std::filesystem::path& path);

/// The file studio.json in the user's settings folder (clay::user_folder). Empty without one.
[[nodiscard]] std::filesystem::path settings_path();

/// Errors name file, field, what was expected and what was found.
Result<Settings> parse_settings(std::string_view text, std::string_view name);
[[nodiscard]] std::string write_settings(const Settings& settings);

struct LoadedSettings {
  Settings settings;
  std::string note;      ///< a message for the user; empty: none
  bool may_save = true;  ///< no file is there that could be neither read nor renamed
};
/// A broken file is renamed, never overwritten. Without a file all settings have their defaults.
[[nodiscard]] LoadedSettings load_settings(const std::filesystem::path& path);

inline constexpr double kSettingsDelayS = 1.0;

/// A setting that the command line may have given to this window only: the file keeps the value
/// from before until the user changes it.
template <class T>
class ForThisWindow {
 public:
  ForThisWindow() = default;
  ForThisWindow(T stored, T given) : stored_(stored), given_(given), given_only_(stored != given) {}
  [[nodiscard]] T to_store(T shown) {
    given_only_ = given_only_ && shown == given_;
    return given_only_ ? stored_ : shown;
  }

 private:
  T stored_{}, given_{};
  bool given_only_ = false;
};

/// Saves settings soon after they change, so that a window that is killed loses only the changes of
/// its last second. A window saves only its own changes, because several may be open.
class SettingsFile {
 public:
  /// Saves nothing.
  SettingsFile() = default;
  /// `stored`: the settings in the file, or the defaults if there is no file.
  SettingsFile(std::filesystem::path path, const Settings& stored);
  /// `window`: the settings with the theme and the scale of the command line.
  SettingsFile(std::filesystem::path path, const Settings& stored, const Settings& window);
  /// To be called every frame; saves at most once in kSettingsDelayS. An error is returned for the
  /// first of several failures only.
  Result<void> update(const Settings& settings, double now_s);
  /// Saves now, if they have changed.
  Result<void> save(const Settings& settings);

 private:
  std::filesystem::path path_;
  std::string stored_;  // of this window, when it last saved
  ForThisWindow<Theme> theme_;
  ForThisWindow<float> scale_;
  double next_s_ = 0.0;
  bool failed_ = false;
};

}  // namespace clay::studio
