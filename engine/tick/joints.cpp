#include "engine/tick/joints.hpp"

#include "engine/clay/packs.hpp"
#include "engine/tick/contact.hpp"
#include "engine/tick/heave.hpp"

#include <algorithm>

namespace clay {
namespace {

// Rings that one stretch may take from the top.
constexpr std::size_t kMostTaken = 64;

/// Clay that a ring can get: the crown, and the rings above it.
WideQuanta spare_above(const ClayStack& stack, std::size_t ring) noexcept {
  const auto rings = stack.rings();
  WideQuanta spare = stack.crown();
  const std::size_t count = std::min(rings.size() - 1 - ring, kMostTaken);
  for (std::size_t k = 1; k <= count; ++k) spare += rings[rings.size() - k].volume();
  return spare;
}

double least_overlap(double least_mm, const Ring& a, const Ring& b) noexcept {
  return std::min(least_mm, 0.5 * std::min(wall_mm(a), wall_mm(b)));
}

/// `ring` where it overlaps its neighbour by enough, after a motion outward. A solid bottom becomes
/// wider, with clay of the crown.
Ring outward_of(const Following& following, const Ring& neighbour, const Ring& ring) noexcept {
  const double outer = neighbour.inner_mm() + least_overlap(following.least_mm, neighbour, ring);
  if (!(outer < kMaxRadiusMm)) return ring;
  const Quanta by = quanta_from_radius(outer) - ring.outer2;
  if (by <= 0) return ring;
  if (ring.inner2 == 0) return {ring.outer2 + by, 0};
  Ring moved{ring.outer2 + by, ring.inner2 + by};
  const double thick = std::min(wall_mm(ring), following.min_wall_mm);
  if (wall_mm(moved) < thick) moved.inner2 = quanta_from_radius(moved.outer_mm() - thick);
  return moved;
}

/// The same inward. The ring becomes thicker, and its bore stays open.
Ring inward_of(const Following& following, const Ring& neighbour, const Ring& ring) noexcept {
  const double inner = neighbour.outer_mm() - least_overlap(following.least_mm, neighbour, ring);
  const Quanta by = ring.inner2 - quanta_from_radius(inner);
  const Ring moved{ring.outer2 - by, ring.inner2 - by};
  return by > 0 && moved.inner2 > 0 && moved.outer2 >= kSmallestOuter2 ? moved : ring;
}

/// `ring`, as thick as it has to be to overlap its neighbour by enough.
Ring thickened_to(double least_mm, const Ring& neighbour, const Ring& ring) noexcept {
  if (ring.inner2 == 0) return ring;
  const double least = least_overlap(least_mm, neighbour, ring);
  const double outer = neighbour.inner_mm() + least, inner = neighbour.outer_mm() - least;
  Ring thicker = ring;
  if (outer < kMaxRadiusMm) thicker.outer2 = std::max(ring.outer2, quanta_from_radius(outer));
  if (inner > kLeastBoreMm) thicker.inner2 = std::min(ring.inner2, quanta_from_radius(inner));
  return thicker;
}

/// Gives a ring another shape, if there is clay for it.
bool reshape(const ClayStack& stack, std::size_t i, const Ring& shape,
             StackWriter& writer) noexcept {
  const Ring& ring = stack.rings()[i];
  const WideQuanta more = shape.volume() - ring.volume();
  if (shape == ring || (more > 0 && more > spare_above(stack, i))) return false;
  writer.reshape(i, shape);
  return true;
}

/// Whether a tool would be deeper in ring i if the ring had this shape. At an end of the tool, only
/// the part of the ring that the tool covers counts.
bool enters(const Hands& hands, double h, std::size_t i, const Ring& ring,
            const Ring& shape) noexcept {
  const double bottom = static_cast<double>(i) * h - hands.hip_y;
  const double from = std::max(bottom, hands.tool.low());
  const double to = std::min(bottom + h, hands.tool.high());
  if (!(from < to)) return false;
  const double f = hands.tool.radius(0.5 * (from + to));
  return std::ranges::any_of(hands.removals, [&](const ToolRemoval& removal) {
    const double before = depth_of(ring, f, removal.contact);
    return depth_of(shape, f, removal.contact) > std::max(before, 0.0);
  });
}

}  // namespace

/// Neighbours overlap from r to R. R^2 - r^2 is at most 2 R times the overlap, so no root is
/// needed. Most stacks have strong joints only, which the least overlap and the widest ring show.
bool has_weak_joint(std::span<const Ring> rings, double least_mm) noexcept {
  if (rings.size() < 2) return false;
  const double least = std::max(4.0 * least_mm * least_mm * kQuantaPerMm2, 1e-6);
  bool weak = false;
  in_packs(
      [=, from = rings.data(), joints = rings.size() - 1, to = &weak](auto n) CLAYSTACK_INLINE {
        using D = Doubles<n>;
        const auto overlap = [=](std::size_t k) CLAYSTACK_INLINE {
          const RingPack<n> a = load_rings<n>(from + k, joints - k);
          const RingPack<n> b = load_rings<n>(from + k + 1, joints - k);
          return RingPack<n>{lesser(a.outer2, b.outer2), greater(a.inner2, b.inner2)};
        };
        Quantas<n> smallest = overlap(0).outer2, widest{};
        for (std::size_t k = 0; k < joints; k += n) {
          const RingPack<n> both = overlap(k);
          smallest = lesser(smallest, Quantas<n>(both.outer2 - both.inner2));
          widest = greater(widest, both.outer2);
        }
        const auto all = static_cast<double>(least_of(smallest));
        if (all > 0.0 && all * all >= least * static_cast<double>(most_of(widest))) return;
        Quantas<n> found{};
        for (std::size_t k = 0; k < joints; k += n) {
          const auto [outer, inner] = overlap(k);
          const D shared = doubles_of(Quantas<n>(outer > inner ? outer - inner : Quantas<n>{}));
          found |= D(shared * shared) < D(least * doubles_of(outer));
        }
        *to = any(found);
      });
  return weak;
}

std::optional<std::size_t> lowest_gap(std::span<const Ring> rings, std::size_t first,
                                      std::size_t last) noexcept {
  if (!has_weak_joint(rings.subspan(first, last + 1 - first), 0.0)) return std::nullopt;
  for (std::size_t i = first; i < last; ++i)
    if (!rings[i].touches(rings[i + 1])) return i;
  return std::nullopt;
}

/// One way up and one way down are enough: a ring that has followed overlaps the one that it
/// followed, and reaches no farther than that one on the side of the press.
void join_rings(const ClayStack& stack, std::size_t first, std::size_t last,
                const Following& following, StackWriter& writer) noexcept {
  const auto rings = stack.rings();
  const auto follow = [&](std::size_t neighbour, std::size_t i) {
    reshape(stack, i,
            following.outward ? outward_of(following, rings[neighbour], rings[i])
                              : inward_of(following, rings[neighbour], rings[i]),
            writer);
  };
  for (std::size_t i = std::max<std::size_t>(first, 1); i <= last; ++i) follow(i - 1, i);
  for (std::size_t i = std::min(last + 1, rings.size() - 1); i-- > first;) follow(i + 1, i);
}

void thicken_joints(const ClayStack& stack, std::size_t first, std::size_t last, double least_mm,
                    const Hands& hands, StackWriter& writer) noexcept {
  const auto rings = stack.rings();
  const auto thicken = [&](std::size_t i, std::size_t neighbour) {
    if (i < first || i > last) return false;
    const Ring shape = thickened_to(least_mm, rings[neighbour], rings[i]);
    return !enters(hands, stack.ring_height_mm(), i, rings[i], shape) &&
           reshape(stack, i, shape, writer);
  };
  const std::size_t end = std::min(last + 2, rings.size());
  for (std::size_t i = std::max<std::size_t>(first, 1); i < end; ++i)
    if (!thicken(i, i - 1)) thicken(i - 1, i);
}

}  // namespace clay
