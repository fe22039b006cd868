#include "engine/tick/heave.hpp"

#include "engine/clay/packs.hpp"
#include "engine/tick/beside_tool.hpp"
#include "engine/tick/shell.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

constexpr std::size_t kRows = 64;
// A share fills at most this part of r^2. The radii are those before the shift, which leaves at
// least a quarter of r^2, so that the bore stays open.
constexpr float kMostOfBore = 0.2f;
// Rings beyond this part of the largest radius get no share.
constexpr float kMostOfRadius = 0.999f;

// If r^2 loses x <= r^2 / 2, r becomes smaller by at most this times x / r: 2 - sqrt(2).
constexpr double kBoreMoves = 0.586;

/// The shares of a heap for some neighbouring rings.
struct Block {
  static constexpr std::size_t kAll = kRows + kWidestFloats;
  /// The part of the heap up to the lower face of each ring [whole quanta].
  alignas(kPackBytes) double outside_to[kAll], inside_to[kAll];
  alignas(kPackBytes) RawRings<kAll> changes;  ///< of R^2 and r^2, by a ring's share
  alignas(kPackBytes) float clear[kAll];       ///< distance from the surface to the tool [mm]
  float lack[kAll];                            ///< above 0: does not take its share
  std::size_t first_lack, lacks_end;           ///< outside of these rings all take their shares
};

/// Radii and walls of neighbouring rings, from the first one on; see `WallRadii`.
struct Rows {
  const float *outer, *inner, *wall;
  std::ptrdiff_t apart;
  float spare;  ///< growth over them

  /// Maximum growth of the k-th ring, and of those above it in the same pack, before a ring stands
  /// out too steeply [mm].
  template <class F>
  [[nodiscard]] CLAYSTACK_INLINE F room(std::ptrdiff_t k) const noexcept {
    return spare + lesser(F(lead<F>(k, k - apart)), F(lead<F>(k, k + apart)));
  }

 private:
  /// Difference in thickness of another ring from the k-th [mm]; beside a solid ring, which has no
  /// wall, the difference in radius.
  template <class F>
  [[nodiscard]] CLAYSTACK_INLINE F lead(std::ptrdiff_t k, std::ptrdiff_t other) const noexcept {
    const F thicker = load<F>(wall + other) - load<F>(wall + k);
    const F wider = load<F>(outer + other) - load<F>(outer + k);
    return lesser(load<F>(inner + k), load<F>(inner + other)) > 0.0f ? thicker : wider;
  }
};

/// A heap on its way from the band: the part of it up to each face of a ring, in whole quanta. Up
/// to a distance t of the reach, from 0 to 1, it is the part t^3 (10 - 15 t + 6 t^2); each half
/// from its own end, so that rounding cannot make it fall.
struct Way {
  float start, step;       ///< of the faces, in parts of the reach: below 0 downward
  float first, last;       ///< first and last face of the block, counted from the face of `start`
  double outside, inside;  ///< below 0 downward

  /// Of the 2 n faces from the block's k-th on.
  template <std::size_t n>
  CLAYSTACK_INLINE void lay_faces(Block& b, std::size_t k) const noexcept {
    using F = TwiceFloats<n>;
    const F face = lesser(F(load_floats<n>(&kFloatLevels[k]) + first), F(F{} + last));
    const F x = start + face * step, t = lesser(F(x > 0.0f ? x : F{}), F(F{} + 1.0f));
    const F far = 1.0f - t, s = lesser(t, far);
    const F half = s * s * s * (10.0f - 15.0f * s + 6.0f * s * s);
    const auto parts = halves<n>(t < far ? half : F(1.0f - half));
    for (std::size_t i = 0; i < 2; ++i) {
      store(b.outside_to + k + i * n, nearest(Doubles<n>(outside * parts[i])));
      store(b.inside_to + k + i * n, nearest(Doubles<n>(inside * parts[i])));
    }
  }
};

/// Each ring's share, the difference of its two faces, and which rings do not take it. An upper
/// bound of the motion of each surface decides this without a root.
template <std::size_t n>
CLAYSTACK_INLINE inline void divide(Block& b, const Rows& rows, std::size_t count,
                                    const Way& way) noexcept {
  using D = Doubles<n>;
  using F = TwiceFloats<n>;
  constexpr auto kMm2 = static_cast<float>(kMm2PerQuantum);
  constexpr auto kLeastBore2 = static_cast<float>(kLeastBoreMm * kLeastBoreMm);
  constexpr auto kLargest = kMostOfRadius * static_cast<float>(kMaxRadiusMm);
  for (std::size_t k = 0; k <= in_packs_of(count); k += 2 * n) way.lay_faces<n>(b, k);
  F first_lack = F{} + static_cast<float>(count), last_lack = F{} - 1.0f;
  for (std::size_t k = 0; k < count; k += 2 * n) {
    D outsides[2], insides[2];
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t at = k + i * n;
      outsides[i] = load_doubles<n>(b.outside_to + at + 1) - load_doubles<n>(b.outside_to + at);
      insides[i] = load_doubles<n>(b.inside_to + at + 1) - load_doubles<n>(b.inside_to + at);
      store(b.changes.data() + at, RingPack<n>{quanta_of(outsides[i]), -quanta_of(insides[i])});
    }
    const F outside = kMm2 * floats(outsides[0], outsides[1]);
    const F inside = kMm2 * floats(insides[0], insides[1]);
    const F outer = load_floats<n>(rows.outer + k), inner = load_floats<n>(rows.inner + k);
    const F moved =
        0.5f * outside / outer + static_cast<float>(kBoreMoves) * inside / (inner + 1e-20f);
    const F slope = rows.room<F>(static_cast<std::ptrdiff_t>(k));
    const F over = moved - lesser(slope, load_floats<n>(b.clear + k));
    const F bore = inside > 0.0f ? inside - kMostOfBore * (inner * inner - kLeastBore2) : F{};
    const F wide = outer - kLargest;
    const F lacks = greater(over, greater(bore, wide));
    const F lack = moved > 0.0f ? lacks : F{}, row = load_floats<n>(&kFloatLevels[k]);
    first_lack = lesser(first_lack, F(lack > 0.0f ? row : first_lack));
    last_lack = greater(last_lack, F(lack > 0.0f ? row : last_lack));
    store(b.lack + k, lack);
  }
  b.first_lack = static_cast<std::size_t>(least_of(first_lack));
  b.lacks_end = static_cast<std::size_t>(most_of(last_lack) + 1.0f);
}

/// One end of a band and the way from there.
class Heaving {
 public:
  Heaving(const Tool& tool, const ClayStack& stack, WallRadii& walls, double hip_y,
          const Contact& contact, const Band& band, const Heap& heap, StackWriter& writer) noexcept
      : tool_(tool),
        stack_(stack),
        walls_(walls),
        contact_(contact),
        writer_(writer),
        heap_(heap),
        h_(stack.ring_height_mm()),
        steepest_mm_(heap.slope * static_cast<double>(walls.apart()) * h_),
        hip_y_(hip_y),
        from_mm_(heap.up ? band.high_mm : band.low_mm),
        per_reach_(1.0 / heap.reach_mm) {}

  Quanta run() noexcept {
    const double level = from_mm_ / h_, size = static_cast<double>(stack_.size());
    if (heap_.up ? !(level < size) : !(level > 0.0)) return heap_.inside + heap_.outside;
    std::size_t ring =
        heap_.up ? static_cast<std::size_t>(level) : static_cast<std::size_t>(std::ceil(level)) - 1;
    first_face_ = ring + (heap_.up ? 0 : 1);
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
  static constexpr float kFar = 1e30f;
  struct Portion {
    Quanta inside = 0, outside = 0;
  };
  [[nodiscard]] Quanta carried() const noexcept { return carry_.inside + carry_.outside; }
  /// Rings to the end of the reach; if clay is carried, to the end of twice the reach.
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

  /// Number of consecutive rings that take their share, from the n-th ring of the block on the way.
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
    placed_ += static_cast<Quanta>(total);
  }

  void prepare(std::size_t first, std::size_t count) noexcept {
    const double faces = heap_.up ? static_cast<double>(first) - static_cast<double>(first_face_)
                                  : -static_cast<double>(first_face_ - first);
    const double step = h_ * per_reach_,
                 start = per_reach_ * way_to(heap_.up ? first_face_ : first_face_ - 1);
    const double end = heap_.up ? faces + static_cast<double>(count) : -faces;
    reached_end_ = start + end * step >= 1.0;
    walls_.cover(stack_, first, first + count);
    find_clearance(first, count);
    const auto single = [](double x) { return static_cast<float>(x); };
    const double sign = heap_.up ? 1.0 : -1.0;
    const Way way{single(start),
                  single(sign * step),
                  single(faces),
                  single(faces + static_cast<double>(count)),
                  sign * static_cast<double>(heap_.outside),
                  sign * static_cast<double>(heap_.inside)};
    const Rows rows = rows_from(first);
    in_packs([=, b = &block_](auto n) CLAYSTACK_INLINE { divide<n>(*b, rows, count, way); });
  }

  /// Maximum growth of each ring before it touches the tool [mm]; very large for a ring that is not
  /// beside the tool.
  void find_clearance(std::size_t first, std::size_t count) noexcept {
    std::fill_n(block_.clear, in_packs_of(count), kFar);
    beside_tool(first, count);
    if (heap_.finger != nullptr && heap_.up) beside_finger(*heap_.finger, first, count);
  }

  void beside_tool(std::size_t first, std::size_t count) noexcept {
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
        const Doubles<n> far = all_of<Doubles<n>>(double{kFar});
        store(to + k, floats(Doubles<n>(radius < 0.0 ? far : greater(near, 0.0))));
      }
    });
  }

  /// No clay is laid into a finger. If a wall yields to it only in part, there is some room.
  void beside_finger(const Finger& finger, std::size_t first, std::size_t count) noexcept {
    for (std::size_t k = 0; k < count; ++k) {
      const double middle = (static_cast<double>(first + k) + 0.5) * h_;
      const double bore = finger.bore_at(middle);
      if (middle < finger.from_mm || middle > finger.to_mm || !(bore > 0.0)) continue;
      const double part = finger.part(static_cast<double>(*walls_.thickness(first + k)));
      if (!(part > 0.0)) continue;
      const double near = static_cast<double>(*walls_.inner(first + k)) - bore;
      const double room = greater(near, 0.0) + 1.0 / part - 1.0;
      block_.clear[k] = lesser(block_.clear[k], static_cast<float>(room));
    }
  }

  /// Places on ring i the part of the carried clay for which there is room, the same part on both
  /// surfaces. Clay that a bore cannot hold is carried on; where there is no bore, it goes outside.
  void place(std::size_t i, std::size_t k) noexcept {
    const Ring& ring = stack_.rings()[i];
    if (ring.inner2 == 0) carry_ = {0, carry_.inside + carry_.outside};
    const double room = rows_from(i).room<float>(0);
    if (!(room > 0.0)) return;
    // At most these, even if the radii are small.
    const double out =
        0.5 * kMm2PerQuantum * static_cast<double>(carry_.outside) / *walls_.outer(i);
    const double in =
        kMm2PerQuantum * static_cast<double>(carry_.inside) / (*walls_.inner(i) + 1e-20);
    const bool presses_outside = contact_.side == Side::compressive;
    const double clear = block_.clear[k], part = std::min(1.0, room / (out + in));
    const auto part_of = [](double share, Quanta q) {
      return std::min(static_cast<Quanta>(share * static_cast<double>(q)), q);
    };
    const double out_part = presses_outside ? std::min(part, clear / out) : part;
    const double in_part = presses_outside ? part : std::min(part, clear / in);
    constexpr Quanta least = quanta_from_radius(kLeastBoreMm);
    const Quanta room_inside = std::max<Quanta>(ring.inner2 - least, 0) / 2;
    const Quanta inside =
        writer_.put_inside(i, std::min(part_of(in_part, carry_.inside), room_inside));
    const Quanta outside = writer_.put_outside(i, part_of(out_part, carry_.outside));
    carry_.inside -= inside;
    carry_.outside -= outside;
    placed_ += inside + outside;
    walls_.thicken(i, out_part * out, in_part * in);
  }
  [[nodiscard]] Rows rows_from(std::size_t first) const noexcept {
    return {walls_.outer(first), walls_.inner(first), walls_.thickness(first),
            static_cast<std::ptrdiff_t>(walls_.apart()), static_cast<float>(steepest_mm_)};
  }

  const Tool& tool_;
  const ClayStack& stack_;
  WallRadii& walls_;
  const Contact& contact_;
  StackWriter& writer_;
  const Heap& heap_;
  double h_;
  double steepest_mm_;  ///< growth over `WallRadii::apart` rings
  double hip_y_, from_mm_, per_reach_;
  std::size_t first_face_ = 0;  ///< lower or upper face of the first ring on the way
  bool reached_end_ = false;    ///< the whole heap is shared out
  Portion carry_;
  Quanta placed_ = 0;
  Block block_;
};

}  // namespace

double heave_reach(const Tool& tool, const ClayStack& stack, const Band& band) noexcept {
  const Ring& ring = stack.rings()[std::min(band.ring, stack.size() - 1)];
  const double wall = wall_mm(ring), width = 2.0 * tool.widest();
  const double reach = 0.8 * (band.height_mm() + std::min(wall, width));
  return std::min(std::max(reach, stack.ring_height_mm()), kLongestShellMm);
}

Quanta heave(const Tool& tool, const ClayStack& stack, WallRadii& walls, double hip_y,
             const Contact& contact, const Band& band, const Heap& heap,
             StackWriter& writer) noexcept {
  return Heaving(tool, stack, walls, hip_y, contact, band, heap, writer).run();
}

}  // namespace clay
