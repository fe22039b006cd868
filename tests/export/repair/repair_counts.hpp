#pragma once
#include "claystack/export/repair.hpp"

#include <cstddef>
#include <string>

namespace clay::solid {

/// Number of repairs of this kind.
inline std::size_t times(const RepairedMesh& result, const std::string& what) {
  for (const Repair& repair : result.repaired)
    if (repair.what == what) return repair.count;
  return 0;
}

}  // namespace clay::solid
