#include "app/bench/extreme/page_watch.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstring>

namespace clay::extreme {
namespace {

struct Pages {
  std::uintptr_t first = 0, end = 0;
};

std::uintptr_t page_size() {
  static const auto size = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  return size;
}

Pages pages_of(std::span<const std::byte> memory) {
  const auto begin = reinterpret_cast<std::uintptr_t>(memory.data());
  const auto first = (begin + page_size() - 1) / page_size() * page_size();
  const auto end = (begin + memory.size()) / page_size() * page_size();
  return {first, end > first ? end : first};
}

bool allow(std::uintptr_t first, std::uintptr_t end, int access) {
  // The page belongs to the subject and was writable before; no object changes.
  return mprotect(reinterpret_cast<void*>(first), end - first, access) == 0;
}

Pages watched;
volatile std::sig_atomic_t opened = 0;
struct sigaction outer_action;

void open_page(int signal, siginfo_t* info, void*) {
  const auto at = reinterpret_cast<std::uintptr_t>(info->si_addr);
  const std::uintptr_t page = at / page_size() * page_size();
  if (at < watched.first || at >= watched.end ||
      !allow(page, page + page_size(), PROT_READ | PROT_WRITE)) {
    // A fault elsewhere: restore the old action and retry the access.
    sigaction(signal, &outer_action, nullptr);
    return;
  }
  opened = opened + 1;
}

}  // namespace

std::size_t pages_in(std::span<const std::byte> memory) {
  const Pages pages = pages_of(memory);
  return (pages.end - pages.first) / page_size();
}

std::size_t pages_opened(std::span<const std::byte> memory, const std::function<void()>& work) {
  watched = pages_of(memory);
  opened = 0;
  struct sigaction action;
  std::memset(&action, 0, sizeof action);
  action.sa_sigaction = open_page;
  action.sa_flags = SA_SIGINFO;
  sigemptyset(&action.sa_mask);
  if (sigaction(SIGSEGV, &action, &outer_action) != 0) return pages_in(memory);
  allow(watched.first, watched.end, PROT_NONE);
  work();
  allow(watched.first, watched.end, PROT_READ | PROT_WRITE);
  sigaction(SIGSEGV, &outer_action, nullptr);
  return static_cast<std::size_t>(opened);
}

}  // namespace clay::extreme
