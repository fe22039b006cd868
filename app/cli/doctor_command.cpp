#include "app/cli/commands.hpp"
#include "app/cli/installed.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/memory_room.hpp"

#include "core/user_folder.hpp"
#ifdef CLAYSTACK_WINDOW
#include "app/render/offscreen.hpp"
#endif

#include <fmt/format.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace clay::cli {
namespace {

namespace fs = std::filesystem;

/// A part of the system, and its use.
struct Finding {
  std::string name;  ///< "udev rule"
  bool good = false;
  std::string found;  ///< "llvmpipe", "none"
  std::string use;    ///< the functions that are missing without it
  std::string fix;    ///< a command; empty if good
};

Finding examine_memory() {
  constexpr std::uint64_t kLeast = std::uint64_t{1} << 30;
  const MemoryRoom room = memory_room();
  Finding finding{"memory",
                  room.bytes >= kLeast,
                  gigabytes(room.bytes) + " available within " + std::string(room.limit),
                  "checking large meshes takes up to 2 GB",
                  {}};
  if (!finding.good) finding.fix = "close other programs, or raise the limit: ulimit -v unlimited";
  return finding;
}

/// Whether a folder lies below the home folder, where a command that ran as root may have made it.
/// Folders elsewhere, such as / if there is no home folder, must keep their owner.
bool is_below_home(const fs::path& folder) {
  const char* home = std::getenv("HOME");
  const fs::path below = folder.lexically_relative(home != nullptr ? home : "");
  return !below.empty() && below != "." && *below.begin() != "..";
}

/// Creates nothing: a folder that does not exist yet is made where the nearest one is writable.
Finding examine_home() {
  constexpr const char* kAnother = "export HOME=/path/to/a/folder";
  fs::path folder = user_folder(UserFolder::state);
  if (folder.empty())
    return {"home folder", false, "none", "journals for recovery, settings", kAnother};
  const std::string wanted = folder.string();
  std::error_code ignored;
  while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
  const bool is_folder = fs::is_directory(folder, ignored);
  const bool good = is_folder && ::access(folder.c_str(), W_OK) == 0;
  const std::string fix = is_folder && is_below_home(folder)
                              ? fmt::format("sudo chown \"$USER\" \"{}\"", folder.string())
                              : kAnother;
  return {"home folder", good, wanted, "journals for recovery, settings", good ? "" : fix};
}

#ifdef CLAYSTACK_WINDOW
Finding examine_graphics() {
  const auto offscreen =
      expect_room_to_draw(0).and_then([] { return render::Offscreen::create(); });
  if (offscreen) return {"graphics", true, offscreen->renderer(), "pictures and the window", {}};
  return {"graphics", false, offscreen.error().message, "pictures and the window",
          "sudo apt install libegl1 libgl1 libgl1-mesa-dri"};
}
#endif

#ifdef CLAYSTACK_STUDIO
bool runs(std::string_view program) {
  std::istringstream folders(std::getenv("PATH") ? std::getenv("PATH") : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

Finding examine_dialog() {
  for (const char* program : {"zenity", "kdialog"})
    if (runs(program)) return {"file dialog", true, program, "choosing files in the window", {}};
  return {"file dialog", false, "none", "choosing files in the window", "sudo apt install zenity"};
}

Finding examine_screen() {
  const bool good = is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
  return {"screen", good, good ? "a display" : "none", "claystack studio",
          good ? "" : "start claystack studio in a desktop session, or use ssh -X"};
}
#endif

#ifdef CLAYSTACK_USB
/// Requests real-time scheduling, then restores the scheduling of this process.
bool gets_real_time() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_RTPRIO, &limit) == 0 && limit.rlim_cur > 0) return true;
  sched_param parameters{};
  parameters.sched_priority = 1;
  const int policy = ::sched_getscheduler(0);
  sched_param before{};
  ::sched_getparam(0, &before);
  if (::sched_setscheduler(0, SCHED_FIFO, &parameters) != 0) return false;
  return ::sched_setscheduler(0, policy, &before) == 0;
}

Finding examine_real_time() {
  const bool good = gets_real_time();
  return {"real-time priority", good, good ? "permitted" : "not permitted",
          "forces on time, while other programs run",
          good ? ""
               : "echo \"$USER - rtprio 50\" | sudo tee /etc/security/limits.d/60-claystack.conf; "
                 "then log in again"};
}

/// Path of the udev rule: installed, or in a clone.
std::string rule_to_copy() {
  std::error_code ignored;
  const fs::path rule = installed("lib/udev/rules.d/60-claystack.rules");
  return fs::exists(rule, ignored) ? rule.string() : "falcon/device/60-claystack.rules";
}

Finding examine_udev_rule() {
  constexpr std::array kFolders{"/etc/udev/rules.d", "/run/udev/rules.d", "/usr/lib/udev/rules.d",
                                "/usr/local/lib/udev/rules.d", "/lib/udev/rules.d"};
  constexpr const char* kRule = "60-claystack.rules";
  std::error_code ignored;
  for (const char* folder : kFolders)
    if (fs::exists(fs::path(folder) / kRule, ignored))
      return {"udev rule", true, (fs::path(folder) / kRule).string(), "permission for devices", {}};
  return {"udev rule", false, "none", "permission for devices",
          fmt::format("sudo cp {} /etc/udev/rules.d/ && sudo udevadm control --reload && sudo "
                      "udevadm trigger",
                      rule_to_copy())};
}
#endif

std::vector<Finding> examine() {
  std::vector<Finding> findings{examine_memory(), examine_home()};
#ifdef CLAYSTACK_WINDOW
  findings.push_back(examine_graphics());
#endif
#ifdef CLAYSTACK_STUDIO
  findings.push_back(examine_screen());
  findings.push_back(examine_dialog());
#endif
#ifdef CLAYSTACK_USB
  findings.push_back(examine_real_time());
  findings.push_back(examine_udev_rule());
#endif
  return findings;
}

Json json_of(const std::vector<Finding>& findings) {
  Json list = Json::array();
  for (const Finding& finding : findings) {
    Json one = {{"name", finding.name},
                {"good", finding.good},
                {"found", finding.found},
                {"use", finding.use}};
    if (!finding.fix.empty()) one["fix"] = finding.fix;
    list.push_back(std::move(one));
  }
  const bool good = std::ranges::all_of(findings, &Finding::good);
  return {{"schema", "claystack-doctor-1"}, {"good", good}, {"findings", std::move(list)}};
}

void print(const std::vector<Finding>& findings, const Console& console) {
  for (const Finding& finding : findings) {
    console.print(fmt::format("{:8} {:20} {}", finding.good ? "good" : "missing", finding.name,
                              finding.found));
    if (finding.good) continue;
    console.print(fmt::format("         needed for: {}", finding.use));
    console.print(fmt::format("         fix: {}", finding.fix));
  }
}

}  // namespace

void add_doctor_command(CLI::App& app, Console& console, int& exit) {
  CLI::App* command = app.add_subcommand(
      "doctor",
      "Check this machine: graphics, screen, devices, priority, memory; show the commands that "
      "fix what is missing");
  command->footer(
      "\nExamples:\n  claystack doctor\n  claystack doctor --json\n\n"
      "Exit status: 0 nothing is missing; 1 something is.");
  command->callback([&console, &exit] {
    Progress progress(console, "doctor", 0);
    progress.stage("examining this machine");
    const std::vector<Finding> findings = examine();
    if (console.json) print_json(json_of(findings));
    print(findings, console);
    exit = std::ranges::all_of(findings, &Finding::good) ? kDone : kUnsound;
  });
}

}  // namespace clay::cli
