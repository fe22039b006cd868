#include "app/bench/machine.hpp"

#include "claystack/version.hpp"
#include "claystack_commit.hpp"

#include <sys/utsname.h>

#include <fstream>
#include <thread>

namespace clay::bench {
namespace {

/// The first `model name` of /proc/cpuinfo.
std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      if (const auto colon = line.find(": "); colon != std::string::npos)
        return line.substr(colon + 2);
  return "unknown";
}

std::string system_name() {
  utsname name{};
  if (uname(&name) != 0) return "unknown";
  return std::string(name.sysname)
      .append(" ")
      .append(name.release)
      .append(" ")
      .append(name.machine);
}

}  // namespace

Machine this_machine() {
#ifdef __clang__
  const std::string compiler = "Clang " __clang_version__;
#else
  const std::string compiler = "GCC " __VERSION__;
#endif
  return {cpu_model(),     std::thread::hardware_concurrency(),        system_name(), compiler,
          CLAYSTACK_FLAGS, CLAYSTACK_VERSION " (" CLAYSTACK_COMMIT ")"};
}

}  // namespace clay::bench
