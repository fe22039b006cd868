#include "tests/support/allocation_counter.hpp"

#include <malloc.h>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<std::size_t> calls{0}, live_bytes{0}, peak_bytes{0};

void give_back(void* memory) noexcept {
  if (memory != nullptr) live_bytes -= malloc_usable_size(memory);
  std::free(memory);
}
}  // namespace

void* operator new(std::size_t size) {
  ++calls;
  void* memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  const std::size_t live = live_bytes += malloc_usable_size(memory);
  std::size_t peak = peak_bytes;
  while (live > peak && !peak_bytes.compare_exchange_weak(peak, live)) {
  }
  return memory;
}
void operator delete(void* memory) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t) noexcept { give_back(memory); }

namespace clay {
std::size_t allocation_count() noexcept { return calls; }
std::size_t restart_allocation_peak() noexcept { return peak_bytes = live_bytes.load(); }
std::size_t allocation_peak_bytes() noexcept { return peak_bytes; }
}  // namespace clay
