#pragma once
// Where the programs keep what the user did not name a file for, as the XDG base directory
// specification says: https://specifications.freedesktop.org/basedir-spec/latest

#include <filesystem>

namespace clay::cli {

enum class UserFolder {
  config,  ///< $XDG_CONFIG_HOME, by default ~/.config
  state,   ///< $XDG_STATE_HOME, by default ~/.local/state
};

/// The folder `claystack` in there; it need not exist. A value that is empty or relative counts as
/// not set. Without HOME the home is that of the password file. Empty where that names none either.
[[nodiscard]] std::filesystem::path user_folder(UserFolder kind);

/// What to say where it is empty.
inline constexpr const char* kNoHome =
    "expected a home folder, found none: HOME is not set, and the password file has no entry";

}  // namespace clay::cli
