#pragma once
#include <filesystem>

namespace clay::app {

/// $HOME, or the user's home of the password file where it is not set; "/" where there is none.
[[nodiscard]] std::filesystem::path home_folder();

/// $XDG_STATE_HOME or ~/.local/state, /claystack. May not exist.
[[nodiscard]] std::filesystem::path state_folder();

/// $XDG_CONFIG_HOME or ~/.config, /claystack. May not exist.
[[nodiscard]] std::filesystem::path config_folder();

}  // namespace clay::app
