// libFuzzer over one reader of Claystack's own files, which CMake selects by its name.

#include "tests/fuzz/program_readers.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clay::samples;
  static const std::vector<TextReader> readers = program_readers(CLAYSTACK_SAMPLES);
  static const auto reader = std::ranges::find(readers, FUZZED_READER, &TextReader::name);
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (const auto broken = reader->broken_promise(bytes)) {
    std::fprintf(stderr, "%s\n", broken->c_str());
    std::abort();
  }
  return 0;
}
