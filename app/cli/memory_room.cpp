#include "app/cli/memory_room.hpp"

#include "core/size_text.hpp"

#include <fmt/format.h>

#include <sys/resource.h>
#include <algorithm>
#include <fstream>

namespace clay::cli {
namespace {

constexpr const char* kOfProcess = "/proc/self/status";
std::uint64_t limit_set = 0;

/// A value in kB of one of the kernel's tables, in bytes; 0 if missing.
std::uint64_t kernel_figure(const char* table, std::string_view label) {
  std::ifstream lines(table);
  for (std::string word; lines >> word;) {
    std::uint64_t kb = 0;
    if (word == label && lines >> kb) return 1024 * kb;
  }
  return 0;
}

/// The memory that a limit leaves to a process that uses `used`.
std::uint64_t rest_of(std::uint64_t limit, std::uint64_t used) {
  return limit - std::min(used, limit);
}

constexpr int kDecimals = 1;

double in_gigabytes(std::uint64_t bytes) { return static_cast<double>(bytes) / 1e9; }

std::string gigabytes(std::uint64_t bytes, int decimals) {
  return size_text(in_gigabytes(bytes), decimals) + " GB";
}

}  // namespace

void limit_memory(std::uint64_t bytes) noexcept try {
  rlimit data{};
  if (::getrlimit(RLIMIT_DATA, &data) != 0 || kernel_figure(kOfProcess, "VmData:") > bytes) return;
  data.rlim_cur = std::min<rlim_t>(bytes, data.rlim_max);
  if (::setrlimit(RLIMIT_DATA, &data) == 0) limit_set = data.rlim_cur;
} catch (...) {
  // Without the figure there is no limit.
}

std::uint64_t memory_limit() noexcept { return limit_set; }

MemoryRoom memory_room() {
  MemoryRoom room;
  const auto narrow = [&](std::uint64_t left, std::string_view limit) {
    if (left < room.bytes) room = {left, limit};
  };
  if (const auto free = kernel_figure("/proc/meminfo", "MemAvailable:"); free > 0)
    narrow(free + kernel_figure("/proc/meminfo", "SwapFree:"), "the free memory of this machine");
  rlimit space{};
  if (::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
    narrow(rest_of(space.rlim_cur, kernel_figure(kOfProcess, "VmSize:")),
           "the limit on address space (ulimit -v)");
  if (limit_set > 0)
    narrow(rest_of(limit_set, kernel_figure(kOfProcess, "VmData:")), "the limit --memory");
  return room;
}

Result<void> expect_room(std::string_view job, std::uint64_t bytes) {
  const MemoryRoom room = memory_room();
  if (bytes <= room.bytes) return {};
  return failure(ErrorKind::io, lack_of_room(job, bytes, room));
}

std::string lack_of_room(std::string_view job, std::uint64_t bytes, const MemoryRoom& room) {
  const int decimals = decimals_apart(in_gigabytes(bytes), in_gigabytes(room.bytes), kDecimals);
  return fmt::format("{} needs about {} of memory, found {} available within {}", job,
                     gigabytes(bytes, decimals), gigabytes(room.bytes, decimals), room.limit);
}

Result<void> expect_room_to_draw(std::uint64_t pixels) {
  constexpr std::uint64_t kOfDriver = 256'000'000, kOfPixel = 20;
  return expect_room("drawing", kOfDriver + kOfPixel * pixels);
}

std::string gigabytes(std::uint64_t bytes) { return gigabytes(bytes, kDecimals); }

}  // namespace clay::cli
