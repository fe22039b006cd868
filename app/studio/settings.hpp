#pragma once
// What the window remembers from one time to the next.

#include "app/studio/style.hpp"
#include "app/studio/tool_choice.hpp"
#include "app/studio/units.hpp"
#include "claystack/core/result.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace clay::studio {

inline constexpr double kSlowestHandMmPerS = 10.0, kFastestHandMmPerS = 200.0;
inline constexpr std::size_t kMostRecent = 8, kMostProcesses = 4;
inline constexpr double kSlowestRpm = 20.0, kFastestRpm = 240.0;

struct Settings {
  Theme theme = Theme::dark;
  float scale = 1.0f;  ///< beside the screen's own, kSmallestScale to kLargestScale
  LengthUnit unit = LengthUnit::mm;
  double wheel_rpm = 120.0;  ///< kSlowestRpm to kFastestRpm
  ToolChoice tool;
  bool wall_map = false;      ///< thickness of walls as colours on the pot
  bool full_section = false;  ///< both halves
  std::string
      process;  ///< whose walls are asked for, also in an export: a name or a file; empty: none
  std::vector<std::string> processes;  ///< files of the user's own, newest first
  bool hints = true;                   ///< the first-run hint has not been closed yet
  std::map<std::string, bool> open;    ///< panels by id; one that is not named is as it comes
  std::string folder;                  ///< of the last file; empty: none yet
  std::vector<std::string> recent;     ///< files, newest first, kMostRecent at most
  double pressing_mm_s = 80.0;         ///< of the tool in the clay, kSlowestHand to kFastestHand
};

/// A file that was opened or saved: its folder, and the first of the recent ones.
void remember(Settings& settings, const std::filesystem::path& path);
/// A file of the user's own becomes the process, and the first of those to choose from.
void remember_process(Settings& settings, const std::filesystem::path& path);

/// The file studio.json in the user's folder for settings: cli::user_folder. Empty without one.
[[nodiscard]] std::filesystem::path settings_path();

/// Errors name file, field, what was expected and what was found.
Result<Settings> parse_settings(std::string_view text, std::string_view name);
[[nodiscard]] std::string write_settings(const Settings& settings);

struct LoadedSettings {
  Settings settings;
  std::string note;  ///< what to tell the user; empty: nothing
};
/// A file that is broken is moved aside, never overwritten; without one all is as it comes.
[[nodiscard]] LoadedSettings load_settings(const std::filesystem::path& path);
Result<void> save_settings(const Settings& settings, const std::filesystem::path& path);

}  // namespace clay::studio
