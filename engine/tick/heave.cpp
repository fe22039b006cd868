#include "engine/tick/heave.hpp"

#include "engine/clay/packs.hpp"
#include "engine/tick/beside_tool.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

constexpr double kSteepest = 0.5;  // of a growth over the way along the wall
// The slope is that over such a way at least, or the limit would depend on the height of rings.
constexpr double kSlopeWayMm = 0.17;
constexpr std::size_t kMostApart = 64;  // rings
constexpr std::size_t kRows = 64;

/// Some neighbouring rings, and the walls beside them that their slope is measured to.
struct Block {
  static constexpr std::size_t kAll = kRows + 2 * kWidestPack;
  alignas(kPackBytes) double outer2[kAll], inner2[kAll];       ///< [quanta]
  alignas(kPackBytes) float per_outer[kAll], per_inner[kAll];  ///< [1/mm]
  alignas(kPackBytes) double walls[kAll + 2 * kMostApart];     ///< [mm]; see `wall`
  alignas(kPackBytes) double outside_to[kAll],
      inside_to[kAll];                         ///< whole quanta that lie up to a ring's lower face
  alignas(kPackBytes) RawRings<kAll> changes;  ///< of R^2 and r^2, by a ring's share
  alignas(kPackBytes) double clear[kAll];      ///< of the tool [mm]
  double lack[kAll];                           ///< above 0: does not take its share
  std::size_t first_lack, lacks_end;           ///< outside of these rings all take their shares

  /// Of the first ring; those of up to kMostApart rings lie before it, and after the last.
  [[nodiscard]] double* wall() noexcept { return walls + kMostApart; }
};

/// Rings from..last and, beyond the last, the last again.
template <std::size_t n>
CLAYSTACK_INLINE inline RingPack<n> load_up_to(const Ring* rings, std::size_t from,
                                               std::size_t last) noexcept {
  const std::size_t i = from < last ? from : last;
  return load_rings<n>(rings + i, last + 1 - i);
}

template <std::size_t n>
CLAYSTACK_INLINE inline Doubles<n> thickness(Floats<n> outer, Floats<n> inner) noexcept {
  return doubles<n>(outer) - doubles<n>(inner);
}

/// Walls of the rings from `first` on, as `measure` has them.
template <std::size_t n>
CLAYSTACK_INLINE inline void measure_walls(double* walls, const Ring* rings, std::size_t first,
                                           std::size_t last, std::size_t count) noexcept {
  for (std::size_t k = 0; k < count; k += n) {
    const RingPack<n> pack = load_up_to<n>(rings, first + k, last);
    const Doubles<n> outer2 = doubles_of(pack.outer2) * kMm2PerQuantum;
    const Doubles<n> inner2 = doubles_of(pack.inner2) * kMm2PerQuantum;
    store(walls + k, thickness<n>(root(floats(outer2)), root(floats(inner2))));
  }
}

/// Lengths of the rings from `first` on to single precision, of which a machine takes twice as many
/// at once. Beyond an end of the stack a wall is compared with that of the end ring.
template <std::size_t n>
CLAYSTACK_INLINE inline void measure(Block& b, const Ring* rings, std::size_t first,
                                     std::size_t last, std::size_t count,
                                     std::size_t apart) noexcept {
  const std::size_t before = apart < first ? apart : first;
  measure_walls<n>(b.wall() - before, rings, first - before, last, before);
  for (std::size_t k = 0; k < count; k += 2 * n) {
    const RingPack<n> low = load_up_to<n>(rings, first + k, last);
    const RingPack<n> high = load_up_to<n>(rings, first + k + n, last);
    const auto low_outer2 = doubles_of(low.outer2), high_outer2 = doubles_of(high.outer2);
    const auto low_inner2 = doubles_of(low.inner2), high_inner2 = doubles_of(high.inner2);
    const TwiceFloats<n> outer = root(
        floats(Doubles<n>(low_outer2 * kMm2PerQuantum), Doubles<n>(high_outer2 * kMm2PerQuantum)));
    const TwiceFloats<n> inner = root(
        floats(Doubles<n>(low_inner2 * kMm2PerQuantum), Doubles<n>(high_inner2 * kMm2PerQuantum)));
    store(b.outer2 + k, low_outer2);
    store(b.outer2 + k + n, high_outer2);
    store(b.inner2 + k, low_inner2);
    store(b.inner2 + k + n, high_inner2);
    store(b.wall() + k, thickness<n>(low_half<n>(outer), low_half<n>(inner)));
    store(b.wall() + k + n, thickness<n>(high_half<n>(outer), high_half<n>(inner)));
    store(b.per_outer + k, TwiceFloats<n>(1.0f / outer));
    store(b.per_inner + k, TwiceFloats<n>(1.0f / (inner + 1e-30f)));
  }
  measure_walls<n>(b.wall() + count, rings, first + count, last, apart);
  for (std::size_t k = before; k < apart; ++k)
    b.wall()[-1 - static_cast<std::ptrdiff_t>(k)] = b.wall()[-static_cast<std::ptrdiff_t>(before)];
}

/// A heap on its way from the band: what of it lies up to each face of a ring, in whole quanta. Up
/// to a distance t of the reach, from 0 to 1, it is the part t^3 (10 - 15 t + 6 t^2); each half
/// from its own end, so that rounding cannot make it fall.
struct Way {
  double start, step, last;  ///< of the faces, in parts of the reach: below 0 downward; last face
  double outside, inside;

  template <std::size_t n>
  struct Faces {
    Doubles<n> outside_to, inside_to;
  };
  template <std::size_t n>
  CLAYSTACK_INLINE Faces<n> faces(std::size_t k) const noexcept {
    using D = Doubles<n>;
    const D x = start + lesser(load<D>(&kLevels[k]), last) * step;
    const D t = lesser(greater(x, 0.0), 1.0), far = 1.0 - t, s = lesser(t, far);
    const D half = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
    const D part = t < far ? half : 1.0 - half;
    return {nearest(D(outside * part)), nearest(D(inside * part))};
  }
};

/// Rows moved by one, the last from the next rows. In registers: a load of rows that have just been
/// written apart would wait until the writes are done.
template <class Vector>
CLAYSTACK_INLINE inline Vector after(Vector pack, Vector next) noexcept {
  if constexpr (kRowsOf<Vector> == 4)
    return __builtin_shufflevector(pack, next, 1, 2, 3, 4);
  else
    return __builtin_shufflevector(pack, next, 1, 2);
}

/// Each ring's share, the difference of its two faces, and which rings do not take it: without a
/// root, by what is more than each surface moves. A share leaves a bore open.
template <std::size_t n>
CLAYSTACK_INLINE inline void divide(Block& b, std::size_t count, const Way& way, double sign,
                                    std::size_t apart, double spare, double largest2) noexcept {
  using D = Doubles<n>;
  const std::size_t rows = (count + n - 1) / n * n;
  for (std::size_t k = 0; k <= rows; k += n) {
    const Way::Faces<n> faces = way.faces<n>(k);
    store(b.outside_to + k, faces.outside_to);
    store(b.inside_to + k, faces.inside_to);
  }
  D outside_to = load<D>(b.outside_to), inside_to = load<D>(b.inside_to);
  D first_lack = all_of<D>(way.last), last_lack = all_of<D>(-1.0);
  for (std::size_t k = 0; k < count; k += n) {
    const D next_outside = load<D>(b.outside_to + k + n),
            next_inside = load<D>(b.inside_to + k + n);
    const D outside = sign * (after(outside_to, next_outside) - outside_to);
    const D inside = sign * (after(inside_to, next_inside) - inside_to);
    const D per_outer = doubles<n>(load<Floats<n>>(b.per_outer + k));
    const D per_inner = doubles<n>(load<Floats<n>>(b.per_inner + k));
    const D moved = kMm2PerQuantum * (0.5 * outside * per_outer + inside * per_inner);
    const double* const wall = b.wall() + k;
    const D thinner = lesser(load<D>(wall - apart), load<D>(wall + apart));
    const D slope = thinner + spare - load<D>(wall);
    const D over = moved - lesser(slope, load<D>(b.clear + k));
    const D bore = inside > 0.0 ? inside + 1.0 - load<D>(b.inner2 + k) : D{};
    const D wide = load<D>(b.outer2 + k) + outside - largest2;
    const D lacks = greater(over, greater(bore, wide));
    const D lack = moved > 0.0 ? lacks : D{}, row = load<D>(&kLevels[k]);
    first_lack = lesser(first_lack, lack > 0.0 ? row : first_lack);
    last_lack = greater(last_lack, lack > 0.0 ? row : last_lack);
    store(b.lack + k, lack);
    store(b.changes.data() + k, RingPack<n>{quanta_of(outside), -quanta_of(inside)});
    outside_to = next_outside;
    inside_to = next_inside;
  }
  b.first_lack = static_cast<std::size_t>(least_of(first_lack));
  b.lacks_end = static_cast<std::size_t>(-least_of(D(-last_lack)) + 1.0);
}

/// One end of a band and the way from there.
class Heaving {
 public:
  Heaving(const Tool& tool, const ClayStack& stack, double hip_y, const Contact& contact,
          const Band& band, const Heap& heap, StackWriter& writer) noexcept
      : tool_(tool),
        stack_(stack),
        contact_(contact),
        writer_(writer),
        heap_(heap),
        h_(stack.ring_height_mm()),
        apart_(static_cast<std::size_t>(
            std::clamp(kSlopeWayMm / h_, 1.0, static_cast<double>(kMostApart)))),
        steepest_mm_(kSteepest * static_cast<double>(apart_) * h_),
        hip_y_(hip_y),
        from_mm_(heap.up ? band.high_mm : band.low_mm),
        per_reach_(1.0 / heap.reach_mm) {}

  Quanta run() noexcept {
    const double level = from_mm_ / h_, size = static_cast<double>(stack_.size());
    if (heap_.up ? !(level < size) : !(level > 0.0)) return heap_.inside + heap_.outside;
    std::size_t ring =
        heap_.up ? static_cast<std::size_t>(level) : static_cast<std::size_t>(std::ceil(level)) - 1;
    while (!reached_end_ || carried() > 0) {
      const std::size_t left = heap_.up ? stack_.size() - ring : ring + 1;
      const std::size_t count = std::min({left, kRows, rings_to_end(ring)});
      if (count == 0) break;
      lay(heap_.up ? ring : ring + 1 - count, count);
      if (count == left) break;
      ring = heap_.up ? ring + count : ring - count;
    }
    return heap_.inside + heap_.outside - placed_;
  }

 private:
  static constexpr double kFar = 1e300;
  struct Portion {
    Quanta inside = 0, outside = 0;
  };
  [[nodiscard]] Quanta carried() const noexcept { return carry_.inside + carry_.outside; }
  /// Rings to the end of the reach; where something is carried, to that of twice the reach.
  [[nodiscard]] std::size_t rings_to_end(std::size_t ring) const noexcept {
    const double x = way_to(ring), most = (carried() > 0 ? 2.0 : 1.0) / per_reach_;
    return x < most ? static_cast<std::size_t>((most - x) / h_) + 1 : 0;
  }
  /// From the band's end to the near face of a ring.
  [[nodiscard]] double way_to(std::size_t ring) const noexcept {
    const double face = static_cast<double>(heap_.up ? ring : ring + 1) * h_;
    return heap_.up ? face - from_mm_ : from_mm_ - face;
  }

  void lay(std::size_t first, std::size_t count) noexcept {
    prepare(first, count);
    for (std::size_t n = 0; n < count;) {
      const std::size_t even = carried() == 0 ? rings_that_take(n, count) : 0;
      if (even > 0) {
        give_shares(first, heap_.up ? n : count - n - even, even);
        n += even;
        continue;
      }
      const std::size_t k = heap_.up ? n : count - 1 - n;
      carry_.inside -= block_.changes.data()[k].inner2;
      carry_.outside += block_.changes.data()[k].outer2;
      if (carried() > 0) place(first + k, k);
      ++n;
    }
  }

  /// From the n-th ring of the block on its way: how many take their share.
  [[nodiscard]] std::size_t rings_that_take(std::size_t n, std::size_t count) const noexcept {
    const Block& b = block_;
    if (heap_.up ? n >= b.lacks_end : count - n <= b.first_lack) return count - n;
    if (heap_.up ? n < b.first_lack : count - n > b.lacks_end)
      return heap_.up ? b.first_lack - n : count - n - b.lacks_end;
    const std::size_t begin = n;
    while (!(b.lack[heap_.up ? n : count - 1 - n] > 0.0)) ++n;
    return n - begin;
  }

  void give_shares(std::size_t first, std::size_t k, std::size_t count) noexcept {
    const Block& b = block_;
    writer_.change(first + k, {b.changes.data() + k, count});
    const double total =
        b.inside_to[k + count] - b.inside_to[k] + (b.outside_to[k + count] - b.outside_to[k]);
    placed_ += static_cast<Quanta>(heap_.up ? total : -total);
  }

  void prepare(std::size_t first, std::size_t count) noexcept {
    static const double largest2 = static_cast<double>(quanta_from_radius(kMaxRadiusMm));
    const double away = heap_.up ? per_reach_ : -per_reach_, step = away * h_;
    const double start = away * (static_cast<double>(first) * h_ - from_mm_);
    const double end = start + (heap_.up ? static_cast<double>(count) * step : 0.0);
    reached_end_ = end >= 1.0;
    find_clearance(first, count);
    const Way way{start, step, static_cast<double>(count), static_cast<double>(heap_.outside),
                  static_cast<double>(heap_.inside)};
    const Ring* const rings = stack_.rings().data();
    in_packs([=, b = &block_, last = std::min(first + count + apart_ - 1, stack_.size() - 1),
              sign = heap_.up ? 1.0 : -1.0, apart = apart_, spare = steepest_mm_,
              most = largest2](auto n) CLAYSTACK_INLINE {
      measure<n>(*b, rings, first, last, count, apart);
      divide<n>(*b, count, way, sign, apart, spare, most);
    });
  }

  /// How far each ring may grow before it stands in the tool [mm]; one that is not beside it: a
  /// long way.
  void find_clearance(std::size_t first, std::size_t count) noexcept {
    std::fill_n(block_.clear, in_packs_of(count), kFar);
    const double low = (hip_y_ + tool_.low()) / h_, high = (hip_y_ + tool_.high()) / h_;
    const double from = std::max(low - 1.0, static_cast<double>(first));
    const double to = std::min(high + 1.0, static_cast<double>(first + count));
    if (!(from < to)) return;
    const auto begin = static_cast<std::size_t>(from), end = static_cast<std::size_t>(to);
    alignas(kPackBytes) double radii[in_packs_of(kRows)];
    radii_beside(tool_, h_, hip_y_, begin, end - begin, radii);
    in_packs([=, f = radii, to = block_.clear + (begin - first), d = contact_.axis_distance_mm,
              rings = stack_.rings().data() + begin, count = end - begin,
              outside = contact_.side == Side::compressive](auto n) CLAYSTACK_INLINE {
      for (std::size_t k = 0; k < count; k += n) {
        const RingPack<n> pack = load_rings<n>(rings + k, count - k);
        const auto radius = load_doubles<n>(f + k);
        const auto surface =
            rough_roots<n>(doubles_of(outside ? pack.outer2 : pack.inner2) * kMm2PerQuantum);
        const Doubles<n> near = outside ? d - radius - surface : surface - (d + radius);
        store(to + k, radius < 0.0 ? all_of<Doubles<n>>(kFar) : greater(near, 0.0));
      }
    });
  }

  /// As much of what is carried as ring i takes.
  void place(std::size_t i, std::size_t k) noexcept {
    const Ring& ring = stack_.rings()[i];
    if (carry_.inside > ring.inner2) {  // a bore holds no more than itself
      carry_.outside += carry_.inside - ring.inner2;
      carry_.inside = ring.inner2;
    }
    double* const wall = block_.wall() + k;
    const double least = std::min(*(wall - apart_), wall[apart_]);
    const double room = least + steepest_mm_ - *wall;
    if (!(room > 0.0)) return;
    const double R = rough_root(block_.outer2[k] * kMm2PerQuantum);
    const double r = rough_root(block_.inner2[k] * kMm2PerQuantum), clear = block_.clear[k];
    double out = 0.0, in = 0.0;
    const Portion taken = fitting(room, clear, R, r, out, in);
    const Quanta inside = writer_.put_inside(i, taken.inside);
    const Quanta outside = writer_.put_outside(i, taken.outside);
    carry_.inside -= inside;
    carry_.outside -= outside;
    placed_ += inside + outside;
    *wall += out + in;
  }

  /// The part of what is carried for which there is room, in the same proportion.
  [[nodiscard]] Portion fitting(double room, double clear, double R, double r, double& out,
                                double& in) const noexcept {
    const double outside2 = static_cast<double>(carry_.outside) * kMm2PerQuantum;
    const double inside2 = static_cast<double>(carry_.inside) * kMm2PerQuantum;
    // No root where there is plenty of room.
    out = 0.5 * outside2 / R;
    in = inside2 > 0.0 ? inside2 / r : 0.0;
    if (out + in <= std::min(room, clear)) return carry_;
    out = std::sqrt(R * R + outside2) - R;
    in = inside2 > 0.0 ? r - std::sqrt(std::max(r * r - inside2, 0.0)) : 0.0;
    const bool presses_outside = contact_.side == Side::compressive;
    const double most_out = presses_outside ? std::min(out, clear) : out;
    const double most_in = presses_outside ? in : std::min(in, clear);
    if (out + in <= room && out <= most_out && in <= most_in) return carry_;
    const double part = out + in > room ? room / (out + in) : 1.0;
    out = std::min(out * part, most_out);
    in = std::min(in * part, most_in);
    const auto least = [](double mm2, Quanta most) {
      return std::min(quanta_from_mm2(std::max(mm2, 0.0)), most);
    };
    return {least(in * (2.0 * r - in), carry_.inside),
            least(out * (2.0 * R + out), carry_.outside)};
  }

  const Tool& tool_;
  const ClayStack& stack_;
  const Contact& contact_;
  StackWriter& writer_;
  const Heap& heap_;
  double h_;
  std::size_t apart_;   ///< rings between which a slope is measured
  double steepest_mm_;  ///< growth over them
  double hip_y_, from_mm_, per_reach_;
  bool reached_end_ = false;  ///< the whole heap is shared out
  Portion carry_;
  Quanta placed_ = 0;
  Block block_;
};

}  // namespace

double heave_reach(const Tool& tool, const ClayStack& stack, const Band& band) noexcept {
  const Ring& ring = stack.rings()[std::min(band.ring, stack.size() - 1)];
  const double wall = ring.outer_mm() - ring.inner_mm(), width = 2.0 * tool.widest();
  const double reach = 0.8 * (band.height_mm() + std::min(wall, width));
  return std::clamp(reach, stack.ring_height_mm(), kLongestShellMm);
}

Quanta heave(const Tool& tool, const ClayStack& stack, double hip_y, const Contact& contact,
             const Band& band, const Heap& heap, StackWriter& writer) noexcept {
  return Heaving(tool, stack, hip_y, contact, band, heap, writer).run();
}

}  // namespace clay
