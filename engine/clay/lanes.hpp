#pragma once
// Plain loops over arrays: the compiler takes two doubles at a time, and four where the machine
// has AVX2. No multiplication is fused with an addition, so that both round alike.

#define CLAYSTACK_INLINE __attribute__((always_inline))

#include "claystack/engine/clay.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <utility>

namespace clay {

// No std::min, whose references keep a loop from being done in lanes.
CLAYSTACK_INLINE inline double lesser(double a, double b) noexcept { return a < b ? a : b; }
CLAYSTACK_INLINE inline double greater(double a, double b) noexcept { return a > b ? a : b; }

/// 0, 1, 2, ... as doubles. To convert a counter, a loop would take eight rows at a time, and the
/// remaining ones one by one.
alignas(64) inline constexpr auto kLevels = [] {
  std::array<double, 128> levels{};
  for (std::size_t k = 0; k < levels.size(); ++k) levels[k] = static_cast<double>(k);
  return levels;
}();

alignas(64) inline constexpr auto kFloatLevels = [] {
  std::array<float, kLevels.size()> levels{};
  for (std::size_t k = 0; k < levels.size(); ++k) levels[k] = static_cast<float>(k);
  return levels;
}();

/// The halves of a whole number behind these exponents are 2^52 + low and 2^84 + 2^32 high.
inline constexpr std::uint64_t kLowExponent = std::bit_cast<std::uint64_t>(0x1p52);
inline constexpr std::uint64_t kHighExponent = std::bit_cast<std::uint64_t>(0x1p84);
inline constexpr double kBothExponents = 0x1p84 + 0x1p52;

/// The largest size of a number that packs.hpp rounds to quanta.
inline constexpr double kMostLaneQuanta = 0x1p50;

/// Number of doubles that loops process at a time.
class Lanes {
 public:
  /// Four, as on any machine with AVX2; otherwise two.
  [[nodiscard]] static bool four() noexcept { return four_; }

 private:
  friend class TwoLanesScope;
#if defined(__x86_64__)
  static inline bool four_ = __builtin_cpu_supports("avx2") != 0;
#else
  static inline bool four_ = false;
#endif
};

/// As long as it exists, loops take two at a time, as on a machine without AVX2: for the tests and
/// benchmarks that compare the two. `two` = false changes nothing.
class TwoLanesScope {
 public:
  explicit TwoLanesScope(bool two = true) noexcept
      : before_(std::exchange(Lanes::four_, Lanes::four_ && !two)) {}
  ~TwoLanesScope() { Lanes::four_ = before_; }
  TwoLanesScope(const TwoLanesScope&) = delete;
  TwoLanesScope& operator=(const TwoLanesScope&) = delete;

 private:
  bool before_;
};

#if defined(__x86_64__)
/// A copy of the loop: its captures are then in registers, not read again after every store.
template <class Loop>
__attribute__((target("avx2"))) void in_four_lanes(const Loop& loop) noexcept {
  const Loop own = loop;
  own();
}
#endif

/// Runs the loop four doubles at a time where the machine has AVX2, else two. The loop and all that
/// it calls must be inline; otherwise it runs two at a time.
template <class Loop>
void in_lanes(const Loop& loop) noexcept {
#if defined(__x86_64__)
  if (Lanes::four()) return in_four_lanes(loop);
#endif
  loop();
}

}  // namespace clay
