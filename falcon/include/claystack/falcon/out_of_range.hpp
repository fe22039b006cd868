#pragma once

namespace clay::falcon {

/// A setting out of its range, by the name it has in its struct.
struct OutOfRange {
  const char* setting;
  double low, high, found;
};

}  // namespace clay::falcon
