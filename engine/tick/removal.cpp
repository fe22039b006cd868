#include "engine/tick/removal.hpp"

#include "engine/clay/packs.hpp"
#include "engine/tick/yielding.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace clay {
namespace {

/// A ring keeps a quantum of clay and the smallest radius in spite of rounding.
Quanta spare_outside(const Ring& ring) noexcept {
  return ring.outer2 - std::max(ring.inner2 + 1, kSmallestOuter2);
}
Quanta spare_inside(const Ring& ring) noexcept { return ring.volume() - 1; }

/// Loads a slice of the rings that one tool touches, as they are before the tool, and computes
/// their depths after yielding.
void load_and_yield(const RemovalPlan& plan, std::span<const Ring> rings, double dt_s, bool outside,
                    const TouchedRings::Slice& slice, Yielding& block) noexcept {
  const std::size_t count = slice.size();
  in_packs([=, from = &rings[slice.ring], touched = &slice.rows, first = slice.begin,
            outward = outside ? 1.0 : -1.0, to = &block](auto n) CLAYSTACK_INLINE {
    const auto of_slice = [=](const TouchedRings::Row& row, std::size_t k) CLAYSTACK_INLINE {
      return load_doubles<n>(&row[first + k], count - k);
    };
    for (std::size_t k = 0; k < count; k += n) {
      const RingPack<n> pack = load_rings<n>(from + k, count - k);
      const auto opposite = root(doubles_of(outside ? pack.inner2 : pack.outer2) * kMm2PerQuantum);
      const Doubles<n> depth = of_slice(touched->depth, k);
      const Doubles<n> wall = outward * (of_slice(touched->surface, k) - opposite);
      store(&to->depth[k], depth);
      store(&to->advance[k], of_slice(touched->advance, k));
      store(&to->since[k], of_slice(touched->since, k));
      store(&to->wall[k], wall);
      store(&to->target[k], Doubles<n>(wall - depth));
    }
  });
  yield(plan, dt_s, block, count);
}

void yield_to_tool(const RemovalPlan& plan, std::span<const Ring> rings, double dt_s, bool outside,
                   const TouchedRings::Slice& slice, Quanta* removed) noexcept {
  const double min_wall = plan.min_wall_mm;
  const std::size_t count = slice.size(), first = slice.begin;
  TouchedRings::Block& rows = slice.rows;
  Yielding block;
  TouchedRings::Row eps;
  load_and_yield(plan, rings, dt_s, outside, slice, block);
  for (std::size_t k = 0; k < count; ++k) {
    const double gone = block.depth[k] - block.left[k], spare = block.wall[k] - min_wall;
    const double most = spare > 0.0 ? spare : 0.0;
    eps[k] = gone < most ? gone : most;
    rows.depth[first + k] = block.depth[k] - eps[k];
  }
  for (std::size_t k = 0; k < count; ++k) {
    const Ring& ring = rings[slice.ring + k];
    const double surface = rows.surface[first + k];
    removed[k] = outside ? take_outside(ring, surface, eps[k]) : take_inside(ring, surface, eps[k]);
  }
}

/// Rings of a slice, the distance by which each is squeezed [mm], and the clay that this removes
/// [quanta]. Whole packs.
struct Squeezed {
  static constexpr std::size_t kRows = TouchedRings::kBlock;
  alignas(kPackBytes) RawRings<kRows> raw;
  alignas(kPackBytes) double near[kRows], eps[kRows];
  Quanta removed[kRows];

  void load(const Squeeze& rules, std::span<const Ring> all,
            const TouchedRings::Slice& slice) noexcept {
    const std::size_t count = slice.size();
    Ring* const rings = raw.data();
    std::copy_n(&all[slice.ring], count, rings);
    if (rules.shift != nullptr) rules.shift->move(slice.ring, {rings, count});
    for (std::size_t k = count; k < in_packs_of(count); ++k) rings[k] = rings[count - 1];
  }
};

template <std::size_t n>
CLAYSTACK_INLINE inline void squeeze_rows(Squeezed& s, const TouchedRings::Slice& slice,
                                          bool outside, double min_wall) noexcept {
  const std::size_t count = slice.size(), first = slice.begin;
  TouchedRings::Block& rows = slice.rows;
  const double outward = outside ? 1.0 : -1.0;
  for (std::size_t k = 0; k < count; k += n) {
    const auto of_slice = [&](const TouchedRings::Row& row) CLAYSTACK_INLINE {
      return load_doubles<n>(&row[first + k], count - k);
    };
    const RingPack<n> pack = load_rings<n>(s.raw.data() + k);
    const auto outer = root(doubles_of(pack.outer2) * kMm2PerQuantum);
    const auto inner = root(doubles_of(pack.inner2) * kMm2PerQuantum);
    const Doubles<n> near = outside ? outer : inner;
    const Doubles<n> by = outward * (of_slice(rows.surface) - near);
    const Doubles<n> left = outer - inner - min_wall, asked = of_slice(rows.give) - by;
    const Doubles<n> eps = greater(lesser(asked, greater(left, 0.0)), 0.0);
    const Doubles<n> depth = of_slice(rows.depth) - by - eps;
    store(s.near + k, near);
    store(s.eps + k, eps);
    store(&rows.depth[first + k], greater(depth, 0.0));
  }
}

/// `take_outside` or `take_inside` of each row. False if one of them is too much for packs.
template <std::size_t n>
CLAYSTACK_INLINE inline bool take_rows(Squeezed& s, std::size_t count, bool outside,
                                       Quanta smallest) noexcept {
  Quantas<n> much{};
  for (std::size_t k = 0; k < count; k += n) {
    const RingPack<n> pack = load_rings<n>(s.raw.data() + k);
    const Doubles<n> eps = load_doubles<n>(s.eps + k), twice = 2.0 * load_doubles<n>(s.near + k);
    const Doubles<n> asked = eps * (outside ? twice - eps : twice + eps) * kQuantaPerMm2 + 0.5;
    much |= asked > kMostLaneQuanta;
    const Quantas<n> bore = pack.inner2 + 1, least = all_of<Quantas<n>>(outside ? smallest : 0);
    const Quantas<n> spare = pack.outer2 - (bore < least ? least : bore);
    const Quantas<n> some = spare > 0 ? spare : Quantas<n>{}, all = quanta_below(asked);
    store(s.removed + k, all < some ? all : some);
  }
  return !any(much);
}

/// Of a slice: squeezes out the clay that has given way and was not moved.
void squeeze_slice(const Squeeze& rules, std::span<const Ring> rings, bool outside,
                   const TouchedRings::Slice& slice, Quanta* removed) noexcept {
  const std::size_t count = slice.size();
  Squeezed s;
  s.load(rules, rings, slice);
  const Ring* const shifted = s.raw.data();
  const bool on_floor = !outside && (rules.from_below || slice.ring < rules.floor_rings);
  bool fits = false;
  in_packs([=, to = &s, of = &slice, min_wall = rules.min_wall_mm, smallest = kSmallestOuter2,
            ok = &fits](auto n) CLAYSTACK_INLINE {
    squeeze_rows<n>(*to, *of, outside, min_wall);
    if (!on_floor) *ok = take_rows<n>(*to, count, outside, smallest);
  });
  // On the floor row by row: a ring without a bore stays closed.
  for (std::size_t k = 0; on_floor && k < count; ++k)
    if (shifted[k].inner2 == 0 && rules.of_floor(slice.ring + k, rings))
      slice.rows.depth[slice.begin + k] += std::exchange(s.eps[k], 0.0);
  for (std::size_t k = 0; k < count && !fits; ++k)
    s.removed[k] = outside ? take_outside(shifted[k], s.near[k], s.eps[k])
                           : take_inside(shifted[k], s.near[k], s.eps[k]);
  std::copy_n(s.removed, count, removed);
}

}  // namespace

Quanta take_outside(const Ring& ring, double outer_mm, double eps) noexcept {
  const Quanta asked = quanta_from_mm2(eps * (2.0 * outer_mm - eps));
  return std::clamp<Quanta>(asked, 0, std::max<Quanta>(spare_outside(ring), 0));
}
Quanta take_inside(const Ring& ring, double inner_mm, double eps) noexcept {
  const Quanta asked = quanta_from_mm2(eps * (2.0 * inner_mm + eps));
  return std::clamp<Quanta>(asked, 0, std::max<Quanta>(spare_inside(ring), 0));
}

template <Model model>
void compute_removal(const RemovalPlan& plan, const ClayStack& stack, double dt_s, Contact& contact,
                     std::vector<Quanta>& removed) noexcept {
  const bool outside = contact.side == Side::compressive;
  TouchedRings& touched = contact.rings;
  removed.resize(touched.size());
  if constexpr (model == Model::conserving)
    return touched.each_slice([&](const TouchedRings::Slice& slice) {
      yield_to_tool(plan, stack.rings(), dt_s, outside, slice,
                    &removed[slice.ring - touched.from()]);
    });
  for (std::size_t k = 0; k < touched.size(); ++k) {
    const std::size_t i = touched.from() + k;
    if (!(touched.depth(i) > 0.0)) {
      removed[k] = 0;
      continue;
    }
    const Ring& ring = stack.rings()[i];
    const double outer = ring.outer_mm(), inner = ring.inner_mm();
    const double eps = (outer - inner) * plan.paper_fraction;
    removed[k] = outside ? take_outside(ring, outer, eps) : take_inside(ring, inner, eps);
  }
}

void give_way(const RemovalPlan& plan, const ClayStack& stack, double dt_s,
              Contact& contact) noexcept {
  const bool outside = contact.side == Side::compressive;
  contact.rings.each_slice([&](const TouchedRings::Slice& slice) {
    Yielding block;
    load_and_yield(plan, stack.rings(), dt_s, outside, slice, block);
    for (std::size_t k = 0; k < slice.size(); ++k)
      slice.rows.give[slice.begin + k] = block.depth[k] - block.left[k];
  });
}

void squeeze_out(const Squeeze& rules, const ClayStack& stack, Contact& contact,
                 std::vector<Quanta>& removed) noexcept {
  const bool outside = contact.side == Side::compressive;
  removed.resize(contact.rings.size());
  contact.rings.each_slice([&](const TouchedRings::Slice& slice) {
    squeeze_slice(rules, stack.rings(), outside, slice,
                  &removed[slice.ring - contact.rings.from()]);
  });
}

template void compute_removal<Model::paper>(const RemovalPlan&, const ClayStack&, double, Contact&,
                                            std::vector<Quanta>&) noexcept;
template void compute_removal<Model::conserving>(const RemovalPlan&, const ClayStack&, double,
                                                 Contact&, std::vector<Quanta>&) noexcept;

}  // namespace clay
