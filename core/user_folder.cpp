#include "core/user_folder.hpp"

#include <pwd.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <ctime>
#include <system_error>

namespace clay {
namespace {

namespace fs = std::filesystem;

/// Empty if not set, or not an absolute path.
fs::path absolute_path(const char* value) {
  return value != nullptr && value[0] == '/' ? fs::path(value) : fs::path();
}

fs::path home() {
  if (fs::path named = absolute_path(std::getenv("HOME")); !named.empty()) return named;
  std::array<char, 16384> buffer;
  passwd entry{};
  passwd* found = nullptr;
  if (getpwuid_r(getuid(), &entry, buffer.data(), buffer.size(), &found) != 0 || found == nullptr)
    return {};
  return absolute_path(found->pw_dir);
}

}  // namespace

fs::path user_folder(UserFolder kind) {
  const bool config = kind == UserFolder::config;
  fs::path base = absolute_path(std::getenv(config ? "XDG_CONFIG_HOME" : "XDG_STATE_HOME"));
  if (base.empty()) {
    base = home();
    if (base.empty()) return {};
    base /= config ? ".config" : ".local/state";
  }
  return base / "claystack";
}

fs::path current_folder() {
  std::error_code none;
  return fs::current_path(none);
}

std::string time_and_process() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  const std::size_t length = std::strftime(text, sizeof text, "%Y%m%dT%H%M%S-", &utc);
  return std::string(text, length) + std::to_string(getpid());
}

}  // namespace clay
