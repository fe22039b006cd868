// Arbitrary bytes give a pot or an error: tests the reader and the use of its lines.
#include "tests/fuzz/drawing_promise.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#define CLAYSTACK_TEXT_(word) #word
#define CLAYSTACK_TEXT(word) CLAYSTACK_TEXT_(word)

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto broken = clay::importing::samples::broken_promise(
      {reinterpret_cast<const char*>(data), size}, "x." CLAYSTACK_TEXT(FUZZED_FORMAT));
  if (broken) {
    std::fprintf(stderr, "%s\n", broken->c_str());
    std::abort();
  }
  return 0;
}
