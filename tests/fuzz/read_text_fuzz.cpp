// libFuzzer over one reader of Claystack's own files, which CMake selects by its name.

#include "tests/fuzz/program_readers.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

using namespace clay::samples;

static const TextReader& reader() {
  static const std::vector<TextReader> readers = program_readers(CLAYSTACK_SAMPLES);
  static const auto selected = std::ranges::find(readers, FUZZED_READER, &TextReader::name);
  return *selected;
}

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  size = LLVMFuzzerMutate(data, size, most);
  if (!reader().error || seed % 4 == 0) return size;
  const std::string bytes = reader().with_checksums({reinterpret_cast<const char*>(data), size});
  std::memcpy(data, bytes.data(), size);  // a checksum has the same size
  return size;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (const auto broken = reader().broken_promise(bytes)) {
    std::fprintf(stderr, "%s\n", broken->c_str());
    std::abort();
  }
  return 0;
}
