#pragma once
// Reads the files of samples.

#include "claystack/core/atomic_file.hpp"

#include <string>

namespace clay::samples {

/// The parsed file; throws if it cannot be read or parsed, which fails the test.
template <class Parse>
auto parse_file(const std::string& path, Parse parse) {
  return read_file(path)
      .and_then([&](const std::string& text) { return parse(text, path); })
      .value();
}

}  // namespace clay::samples
