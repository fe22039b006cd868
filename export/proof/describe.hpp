#pragma once
// Formats findings as messages.

#include "claystack/export/proof.hpp"
#include "core/text.hpp"

#include <string>

namespace clay::solid::inline proof {

/// "open edge (3): triangle 12 at (1, 2, 3) mm"
inline std::string describe(const MeshProblem& problem) {
  return problem.what + " (" + std::to_string(problem.count) + "): " + problem.where;
}

}  // namespace clay::solid::inline proof
