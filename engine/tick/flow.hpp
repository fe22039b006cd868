#pragma once
#include "claystack/engine/clay.hpp"

#include <cstddef>
#include <cstdint>

namespace clay {

/// The effect of a tick's flow on the stack.
struct Flow {
  std::size_t lowest = 0;  ///< rings lowest..highest may have changed
  std::size_t highest = 0;
  std::size_t grown = 0;  ///< rings added
  std::size_t sunk = 0;   ///< rings taken out; then none is added
  WideQuanta grown_volume = 0, sunk_volume = 0;
  std::size_t lip = SIZE_MAX;  ///< rings from here on have moved up by `grown`, down by `sunk`
  bool weak = true;            ///< some of the changed rings may not touch their neighbours
  bool ring_limit = false;     ///< clay waits for a ring that max_rings does not allow
};

}  // namespace clay
