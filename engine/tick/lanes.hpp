#pragma once
// Plain loops over arrays: the compiler takes two doubles at a time, and four where the machine
// has AVX2. No multiplication is fused with an addition, so that both round alike.

#define CLAYSTACK_INLINE __attribute__((always_inline))

namespace clay {

#if defined(__x86_64__)
/// Only a test or a benchmark that compares the two writes this.
inline bool four_lanes = __builtin_cpu_supports("avx2") != 0;

template <class Loop>
__attribute__((target("avx2"))) void in_four_lanes(const Loop& loop) noexcept {
  loop();
}
#else
inline bool four_lanes = false;
#endif

/// A loop that is inline, as is all that it calls: else it stays with two.
template <class Loop>
void in_lanes(const Loop& loop) noexcept {
#if defined(__x86_64__)
  if (four_lanes) return in_four_lanes(loop);
#endif
  loop();
}

}  // namespace clay
