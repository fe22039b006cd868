#include "export/job/drain.hpp"

#include "claystack/export/section.hpp"
#include "core/text.hpp"

#include <string>
#include <utility>
#include <vector>

namespace clay::solid::inline job {
namespace {

/// Rings below the bottom of the uppermost closed cavity; 0 where there is none.
std::size_t rings_to_drill(const ClayStack& stack, const std::vector<PieceShape>& shapes) {
  std::size_t rings = 0;
  for (const PieceShape& shape : shapes)
    for (const Cavity& cavity : shape.cavities)
      rings = static_cast<std::size_t>(cavity.bottom_mm / stack.ring_height_mm() + 0.5);
  return rings;
}

}  // namespace

Result<DrainedStack> drain(const ClayStack& stack, double diameter_mm) {
  const auto section = profile_of(stack);
  if (!section) return tl::make_unexpected(section.error());
  const std::size_t depth = rings_to_drill(stack, section->shapes);
  if (depth == 0)
    return failure(ErrorKind::bad_input, "drain: expected a closed cavity, found none");
  const Quanta hole2 = quanta_from_radius(0.5 * diameter_mm);
  std::vector<Ring> rings(stack.rings().begin(), stack.rings().end());
  for (std::size_t i = 0; i < depth; ++i) {
    if (rings[i].outer2 <= hole2)
      return failure(ErrorKind::bad_input, "drain: expected a hole narrower than ring " +
                                               std::to_string(i) + " (" +
                                               in_mm(2.0 * rings[i].outer_mm()) + " mm), found " +
                                               in_mm(diameter_mm) + " mm");
    rings[i].inner2 = std::max(rings[i].inner2, hole2);
  }
  return ClayStack::from_rings(stack.ring_height_mm(), std::move(rings), stack.crown(),
                               stack.max_rings())
      .map([&](ClayStack drained) {
        const double drilled =
            static_cast<double>(stack.volume() - drained.volume()) * stack.mm3_per_quantum();
        return DrainedStack{std::move(drained), drilled};
      });
}

}  // namespace clay::solid::inline job
