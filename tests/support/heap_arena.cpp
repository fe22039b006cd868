#include "tests/support/heap_arena.hpp"

#include <sys/mman.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

// Address space; only used pages take memory.
constexpr std::size_t kSize = std::size_t{1} << 31;
constexpr std::size_t kAlignment = 16, kPage = 4096;

std::byte* arena = nullptr;
std::size_t used = 0;
std::atomic<bool> open{false};

bool in_arena(const void* memory) {
  const auto at = reinterpret_cast<std::uintptr_t>(memory);
  const auto begin = reinterpret_cast<std::uintptr_t>(arena);
  return arena != nullptr && at >= begin && at < begin + kSize;
}

void* allocate(std::size_t size) {
  if (!open) return std::malloc(size > 0 ? size : 1);
  if (size > kSize - used - kAlignment) return nullptr;
  void* const memory = arena + used;
  used = (used + size + kAlignment - 1) / kAlignment * kAlignment;
  return memory;
}

void release(void* memory) noexcept {
  if (!in_arena(memory)) std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
  if (void* memory = allocate(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }

namespace clay {

std::span<const std::byte> allocate_together(const std::function<void()>& work) {
  if (arena == nullptr) {
    void* const memory = mmap(nullptr, kSize, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    arena = static_cast<std::byte*>(memory);
  }
  used = (used + kPage - 1) / kPage * kPage;
  const std::size_t begin = used;
  open = true;
  work();
  open = false;
  used = (used + kPage - 1) / kPage * kPage;
  return {arena + begin, used - begin};
}

}  // namespace clay
