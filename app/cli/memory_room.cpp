#include "app/cli/memory_room.hpp"

#include <fmt/format.h>

#include <sys/resource.h>
#include <algorithm>
#include <fstream>

namespace clay::cli {
namespace {

/// A value in kB of one of the kernel's tables, in bytes; empty if missing.
std::uint64_t kernel_figure(const char* table, std::string_view label) {
  std::ifstream lines(table);
  for (std::string word; lines >> word;) {
    std::uint64_t kb = 0;
    if (word == label && lines >> kb) return 1024 * kb;
  }
  return 0;
}

}  // namespace

MemoryRoom memory_room() {
  MemoryRoom room;
  if (const auto free = kernel_figure("/proc/meminfo", "MemAvailable:"); free > 0)
    room = {free + kernel_figure("/proc/meminfo", "SwapFree:"), "the free memory of this machine"};
  rlimit space{};
  if (::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY) {
    const std::uint64_t used = kernel_figure("/proc/self/status", "VmSize:");
    const std::uint64_t left = space.rlim_cur - std::min<std::uint64_t>(used, space.rlim_cur);
    if (left < room.bytes) room = {left, "the limit on address space (ulimit -v)"};
  }
  return room;
}

std::string gigabytes(std::uint64_t bytes) {
  return fmt::format("{:.2g} GB", static_cast<double>(bytes) / 1e9);
}

}  // namespace clay::cli
