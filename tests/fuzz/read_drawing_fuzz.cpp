// Arbitrary bytes give a drawing or an error: tests the reader and the use of its lines.
#include "app/import/drawn_pot.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#define CLAYSTACK_TEXT_(word) #word
#define CLAYSTACK_TEXT(word) CLAYSTACK_TEXT_(word)

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clay::importing;
  const std::string name = "x." CLAYSTACK_TEXT(FUZZED_FORMAT);
  auto drawing = read_drawing({reinterpret_cast<const char*>(data), size}, name);
  if (!drawing) return 0;
  const auto section = half_section(std::move(*drawing), {}, name);
  if (!section) return 0;
  const auto pot = drawn_pot(*section, {section->height_mm / 50.0, {}, 1.9}, name);
  if (pot && pot->stack.recount() != pot->ledger.initial) std::abort();
  return 0;
}
