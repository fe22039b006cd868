// compare_drawings COUNT: imports COUNT generated drawings, a third of each format, and compares
// them with the pictures of librsvg. CONTRIBUTING.md has the command.

#include "tests/app/import/generated_drawings.hpp"

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: compare_drawings COUNT\n");
    return 2;
  }
  const auto count = static_cast<unsigned>(std::strtoul(argv[1], nullptr, 10));
  unsigned wrong = 0;
  for (unsigned i = 0; i < count; ++i) {
    const char* const format = i % 3 == 0 ? "svg" : i % 3 == 1 ? "dxf" : "csv";
    const std::string found = clay::importing::generated::difference(format, i / 3);
    if (found.empty()) continue;
    ++wrong;
    std::printf("%s\n", found.c_str());
  }
  std::printf("%u drawings, %u differ\n", count, wrong);
  return wrong == 0 ? 0 : 1;
}
