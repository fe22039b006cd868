#pragma once
#include "claystack/export/proof.hpp"

#include <new>

namespace clay::solid::inline proof {

/// As check_mesh, but throws std::bad_alloc where the check ran out of memory: that is no fault of
/// the mesh.
[[nodiscard]] inline MeshReport completed_check(const TriangleMesh& mesh) {
  MeshReport report = check_mesh(mesh);
  if (report.out_of_memory) throw std::bad_alloc();
  return report;
}

}  // namespace clay::solid::inline proof
