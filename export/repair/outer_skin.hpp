#pragma once
// The boundary of the region that a soup of closed sheets encloses, by exact winding numbers.

#include "claystack/core/result.hpp"
#include "export/repair/exact_soup.hpp"

#include <vector>

namespace clay::solid::inline repair {

struct OuterSkin {
  std::vector<Triangle> triangles;  ///< on the points of the soup, each once, outward
  std::size_t inner = 0;            ///< triangles of the soup that are not part of it
  bool reversed = false;            ///< a part is turned inside out
};

/// A region is inside if its winding number is at least 1: overlapping bodies are united, a part
/// that is turned inside out counts as empty. `original` is the soup before the refinement. An
/// error (`unsound`) if the sheets are not closed, because then no winding number exists.
Result<OuterSkin> outer_skin(const ExactSoup& soup, const TriangleMesh& original);

}  // namespace clay::solid::inline repair
