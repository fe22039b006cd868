#pragma once
// Folders for files that the user did not name, by the XDG base directory specification:
// https://specifications.freedesktop.org/basedir-spec/latest

#include <filesystem>
#include <string>

namespace clay {

enum class UserFolder {
  config,  ///< $XDG_CONFIG_HOME, by default ~/.config
  state,   ///< $XDG_STATE_HOME, by default ~/.local/state
};

/// The folder `claystack` in it; it need not exist. An empty or relative value counts as not set.
/// Without HOME, the password file gives the home folder. Empty if neither exists.
[[nodiscard]] std::filesystem::path user_folder(UserFolder kind);

/// The folder in which the program runs; empty if it no longer exists.
[[nodiscard]] std::filesystem::path current_folder();

/// The message for an empty folder.
inline constexpr const char* kNoHome =
    "expected a home folder, found none: HOME is not set, and the password file has no entry";

/// "20261121T230307-4711": the time (UTC) and the process, for the name of a file that no other
/// program takes.
[[nodiscard]] std::string time_and_process();

}  // namespace clay
