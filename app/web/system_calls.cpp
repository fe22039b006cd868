// Functions that Emscripten's library lacks, or computes differently from the C library of the
// native program.

#include <fcntl.h>

#include <cmath>

/// A hint to begin writing to the disk. A page has none.
extern "C" int sync_file_range(int, off_t, off_t, unsigned) { return 0; }

/// The nearest double, as glibc's; the result of musl is often wrong by one unit in the last place,
/// which changes figures of certificates. `long double` has 113 bits here.
extern "C" double hypot(double x, double y) {
  if (std::isinf(x) || std::isinf(y)) return HUGE_VAL;
  const long double a = x, b = y;
  return static_cast<double>(sqrtl(a * a + b * b));
}
