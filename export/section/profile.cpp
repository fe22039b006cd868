#include "claystack/export/section.hpp"

#include "core/compensated_sum.hpp"
#include "core/text.hpp"
#include "export/section/stack_section.hpp"
#include "export/section/swept_volume.hpp"

#include <algorithm>
#include <span>
#include <string>

namespace clay::solid::inline section {
namespace {

tl::unexpected<Error> touching_in_a_circle(const ClayStack& stack, std::size_t upper) {
  const Ring& below = stack.rings()[upper - 1];
  const Ring& above = stack.rings()[upper];
  return failure(
      ErrorKind::unsound,
      "rings " + std::to_string(upper - 1) + " and " + std::to_string(upper) +
          ": expected them to share clay at y = " + nine_digit_text(level_mm(stack, upper)) +
          " mm or to stand apart, found that they touch in the circle of radius " +
          nine_digit_text(std::min(below.outer_mm(), above.outer_mm())) + " mm only");
}

/// The parts of a piece in which all rings have a bore.
std::vector<RingRange> bores_of(const ClayStack& stack, RingRange piece) {
  std::vector<RingRange> bores;
  for (std::size_t i = piece.first; i <= piece.last; ++i) {
    if (stack.rings()[i].inner2 == 0) continue;
    if (!bores.empty() && bores.back().last + 1 == i)
      bores.back().last = i;
    else
      bores.push_back({i, i});
  }
  return bores;
}

Cavity cavity_of(const ClayStack& stack, RingRange bore) {
  WideQuanta trapped = 0;
  for (std::size_t i = bore.first; i <= bore.last; ++i) trapped += stack.rings()[i].inner2;
  return {level_mm(stack, bore.first), level_mm(stack, bore.last + 1),
          static_cast<double>(trapped) * stack.mm3_per_quantum()};
}

PieceShape shape_of(const ClayStack& stack, RingRange piece) {
  PieceShape shape{Topology::solid, piece.first, piece.last, {}};
  for (const RingRange bore : bores_of(stack, piece)) {
    const bool open_below = bore.first == piece.first;
    const bool open_above = bore.last == piece.last;
    if (open_below && open_above)
      shape.topology = Topology::tube;
    else if (open_below || open_above)
      shape.topology = Topology::cup;
    else
      shape.cavities.push_back(cavity_of(stack, bore));
  }
  if (shape.topology == Topology::solid && !shape.cavities.empty())
    shape.topology = Topology::cavity;
  return shape;
}

}  // namespace

std::vector<PieceShape> shapes_of(const ClayStack& stack) {
  std::vector<PieceShape> shapes;
  if (stack.size() == 0) return shapes;
  for (const RingRange piece : pieces_of(stack, {0, stack.size() - 1}))
    shapes.push_back(shape_of(stack, piece));
  return shapes;
}

Result<StackProfile> profile_of(const ClayStack& stack, double min_step_mm) {
  const std::span<const Ring> rings = stack.rings();
  if (rings.empty()) return failure(ErrorKind::unsound, "expected at least one ring, found none");
  for (std::size_t upper = 1; upper < rings.size(); ++upper)
    if (contact_of(rings[upper - 1], rings[upper]) == Contact::circle)
      return touching_in_a_circle(stack, upper);
  StackProfile result;
  for (const RingRange piece : pieces_of(stack, {0, rings.size() - 1}))
    result.profile.pieces.push_back(section_of(stack, piece, min_step_mm));
  result.shapes = shapes_of(stack);
  return result;
}

double volume_of(const Profile& profile) noexcept {
  CompensatedSum sum;
  for (const Polygon& polygon : profile.pieces) sum.add(swept_volume(polygon, true));
  return sum.value();
}

}  // namespace clay::solid::inline section
