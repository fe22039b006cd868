// libFuzzer over one reader, which CMake selects.

#include "tests/fuzz/mesh_promise.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clay::solid;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (const auto broken = samples::broken_promise(bytes, MeshFormat::FUZZED_FORMAT)) {
    std::fprintf(stderr, "%s\n", broken->c_str());
    std::abort();
  }
  return 0;
}
