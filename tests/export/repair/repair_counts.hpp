#pragma once
#include "claystack/export/repair.hpp"

#include <cstddef>
#include <string>

namespace clay::solid {

/// How often this was repaired.
inline std::size_t times(const RepairedMesh& result, const std::string& what) {
  for (const Repair& repair : result.repaired)
    if (repair.what == what) return repair.count;
  return 0;
}

}  // namespace clay::solid
