#include "user_folders.hpp"

#include <pwd.h>
#include <unistd.h>

#include <cstdlib>

namespace clay::app {
namespace {

namespace fs = std::filesystem;

// By the XDG base directory specification a relative path is to be ignored.
bool absolute(const char* path) { return path != nullptr && path[0] == '/'; }

fs::path base_folder(const char* variable, const fs::path& below_home) {
  const char* folder = std::getenv(variable);
  return (absolute(folder) ? fs::path(folder) : home_folder() / below_home) / "claystack";
}

}  // namespace

fs::path home_folder() {
  if (const char* home = std::getenv("HOME"); absolute(home)) return home;
  const passwd* user = getpwuid(getuid());
  return user != nullptr && absolute(user->pw_dir) ? user->pw_dir : "/";
}

fs::path state_folder() { return base_folder("XDG_STATE_HOME", ".local/state"); }

fs::path config_folder() { return base_folder("XDG_CONFIG_HOME", ".config"); }

}  // namespace clay::app
