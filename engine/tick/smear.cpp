#include "engine/tick/smear.hpp"

#include "engine/clay/packs.hpp"
#include "engine/tick/beside_tool.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace clay {
namespace {

constexpr double kFilmMm = 0.012;
constexpr double kSpongeFilmMm = 0.05;  // wetter than a finger
constexpr double kMostOfStep = 0.25;    // of a difference, for a diffusion that does not oscillate
constexpr std::size_t kRows = 32;

/// The slope of a surface from which a sponge takes nothing: the difference in radius of the k-th
/// pair of places is `middle` + `bend` (k - `at`) [mm].
struct Slope {
  double middle = 0.0, bend = 0.0, at = 0.0;
};

/// Of the parabola through both ends of the pairs' surface, with the same area below it. Because
/// the ends stay in place and clay moves only between them, the sponge comes to rest on this
/// parabola, and the surface goes on at the ends without a ledge.
Slope slope_of(std::span<const Ring> rings, bool outside, std::size_t count,
               std::size_t stride) noexcept {
  const auto n = static_cast<double>(count), middle = 0.5 * (n - 1.0);
  double sum = 0.0, moment = 0.0;
  for (std::size_t k = 0; k < count + stride; ++k) {
    const Ring& ring = rings[k];
    const double radius = outside ? ring.outer_mm() : ring.inner_mm();
    const double x = static_cast<double>(k) - middle, apart = static_cast<double>(stride);
    if (k >= stride) sum += radius, moment += (x - apart) * radius;
    if (k < count) sum -= radius, moment -= x * radius;
  }
  const double spread = n * (n * n - 1.0) / 12.0;  // of the numbers of the pairs
  return {sum / n, count > 1 ? moment / spread : 0.0, middle};
}

/// Pairs of places on a surface, `stride` rings apart.
class Smear {
 public:
  Smear(const Tool& tool, const ClayStack& stack, double hip_y, const Contact& contact,
        const Band& band, const Smearing& how, StackWriter& writer) noexcept
      : tool_(tool),
        stack_(stack),
        contact_(contact),
        writer_(writer),
        hip_y_(hip_y),
        min_wall_(how.min_wall_mm),
        sponge_(how.sponge),
        middle_(0.5 * (band.low_mm + band.high_mm)),
        per_c_(1.0 / std::max(band.height_mm(), stack.ring_height_mm())),
        outside_(contact.side == Side::compressive) {
    const double h = stack.ring_height_mm(), size = static_cast<double>(stack.size());
    const auto ring_at = [&](double y) {
      return static_cast<std::size_t>(std::clamp(y / h, 0.0, size));
    };
    beside_from_ = std::min(ring_at(hip_y + tool.low()), contact.rings.from());
    beside_to_ = std::max(ring_at(hip_y + tool.high() + h), contact.rings.to());
  }

  /// Pairs whose lower place is of rings first..end-1; `k` of the difference in the window's
  /// middle.
  void run(std::size_t first, std::size_t end, std::size_t stride, double k) noexcept {
    for (; first < end; first += kRows)
      pairs<false>(first, std::min(kRows, end - first), stride, k);
  }

  /// As run(), but only what is not the slope of the surface. The window ends more smoothly.
  void follow(std::size_t first, std::size_t end, std::size_t stride, double k) noexcept {
    slope_ = slope_of(stack_.rings().subspan(first), outside_, end - first, stride);
    for (; first < end; first += kRows, slope_.at -= static_cast<double>(kRows))
      pairs<true>(first, std::min(kRows, end - first), stride, k);
  }

 private:
  /// Places, the clay that a ring there may give before it is too thin, and the clay that it may
  /// get before it is in the tool's way: half of each, because each ring is in two pairs. [quanta]
  /// The rows from `apart` on are the upper places of the pairs; where they overlap the lower ones,
  /// a place has one row.
  struct Places {
    static constexpr std::size_t kAll = 2 * kRows + kWidestPack;
    alignas(kPackBytes) double surface[kAll], give[kAll], get[kAll];
    double depth[kAll];  ///< of the tool [mm]; for a sponge alone
  };

  /// Rings first..first+count-1, from row `to` on.
  void load(std::size_t first, std::size_t count, Places& places, std::size_t to) noexcept {
    in_packs([=, at = &places, rings = stack_.rings().data() + first, least_wall = min_wall_,
              outside = outside_](auto n) CLAYSTACK_INLINE {
      for (std::size_t k = 0; k < count; k += n) {
        const RingPack<n> pack = load_rings<n>(rings + k, count - k);
        const auto outer2 = doubles_of(pack.outer2), inner2 = doubles_of(pack.inner2);
        const Doubles<n> surface = outside ? outer2 : inner2;
        const auto other = root((outside ? inner2 : outer2) * kMm2PerQuantum);
        // A ring narrower than the minimum wall has none to give to its bore.
        const Doubles<n> thinnest =
            outside ? other + least_wall : greater(Doubles<n>(other - least_wall), 0.0);
        const Doubles<n> kept = thinnest * thinnest * kQuantaPerMm2;
        const Doubles<n> spare = outside ? outer2 - kept : kept - inner2;
        store(at->surface + to + k, surface);
        store(at->give + to + k, spare > 0.0 ? 0.5 * spare : Doubles<n>{});
        store(at->get + to + k, all_of<Doubles<n>>(1e300));
      }
    });
    const TouchedRings& touched = contact_.rings;
    const std::size_t end = first + count;
    double* const get = places.get + to;
    find_room(std::max(first, beside_from_), std::min(end, touched.from()), first, get);
    find_room(std::max(first, touched.to()), std::min(end, beside_to_), first, get);
    for (std::size_t i = std::max(first, touched.from()); i < std::min(end, touched.to()); ++i)
      get[i - first] = sponge_ ? 1e300 : 0.0;
    if (!sponge_) return;
    for (std::size_t k = 0; k < count; ++k)
      places.depth[to + k] = contact_.rings.get(first + k).depth_mm;
  }

  /// Of the rings from..end-1, beside the tool but not touched.
  void find_room(std::size_t from, std::size_t end, std::size_t first, double* get) noexcept {
    if (!(from < end)) return;
    assert(end - from <= kMostBeside);
    alignas(kPackBytes) double radii[kMostBeside], rooms[kMostBeside];
    radii_beside(tool_, stack_.ring_height_mm(), hip_y_, from, end - from, radii);
    in_packs([f = radii, to = rooms, d = contact_.axis_distance_mm, count = end - from,
              rings = stack_.rings().data() + from, outside = outside_](auto n) CLAYSTACK_INLINE {
      using D = Doubles<n>;
      for (std::size_t k = 0; k < count; k += n) {
        const RingPack<n> pack = load_rings<n>(rings + k, count - k);
        const D radius = load_doubles<n>(f + k);
        const D surface = root(doubles_of(outside ? pack.outer2 : pack.inner2) * kMm2PerQuantum);
        const D depth = outside ? surface + radius - d : d + radius - surface;
        const D room = -0.5 * depth * (outside ? 2.0 * surface : surface) * kQuantaPerMm2;
        store(to + k, radius < 0.0 ? all_of<D>(1e300) : depth < 0.0 ? room : D{});
      }
    });
    std::copy_n(rooms, end - from, get + (from - first));
  }

  template <bool follows>
  void pairs(std::size_t first, std::size_t count, std::size_t stride, double k0) noexcept {
    Places places;
    const std::size_t apart = std::min(stride, kRows);
    load(first, stride > kRows ? count : count + stride, places, 0);
    if (stride > kRows) load(first + stride, count, places, kRows);
    const double h = stack_.ring_height_mm();
    const double start = (static_cast<double>(2 * first + stride + 1) * 0.5 * h - middle_) * per_c_;
    alignas(kPackBytes) double amounts[kRows];
    alignas(kPackBytes) Quanta whole[kRows];
    const Slope slope = slope_;
    in_packs([=, p = &places, to = amounts, rounded = whole, per_c = per_c_,
              sign = outside_ ? 1.0 : -1.0](auto n) CLAYSTACK_INLINE {
      using D = Doubles<n>;
      for (std::size_t k = 0; k < count; k += n) {
        const D z = start + load_doubles<n>(&kLevels[k]) * h * per_c;
        const D window = 1.0 - z * z, share = window > 0.0 ? k0 * window : D{};
        const D low = load_doubles<n>(p->surface + k),
                high = load_doubles<n>(p->surface + k + apart);
        D up = sign * share * (low - high);
        if constexpr (follows) {
          const D leans = slope.middle + slope.bend * (load_doubles<n>(&kLevels[k]) - slope.at);
          const D radii = root(low * kMm2PerQuantum) + root(high * kMm2PerQuantum);
          up = greater(window, 0.0) * (up + sign * share * leans * radii * kQuantaPerMm2);
        }
        const D most_up = lesser(load_doubles<n>(p->give + k), load_doubles<n>(p->get + k + apart));
        const D most_down =
            lesser(load_doubles<n>(p->give + k + apart), load_doubles<n>(p->get + k));
        const D flow = greater(lesser(up, most_up), D(-most_down));
        const D most = greater(lesser(flow, kMostLaneQuanta), -kMostLaneQuanta);
        const D amount = lesser(low, high) > 0.0 ? most : D{};  // none into a closed bore
        store(to + k, amount);
        store(rounded + k, quanta_below(amount));
      }
    });
    if (sponge_) {
      level(places, apart, {amounts, count});
      for (std::size_t k = 0; k < count; ++k) whole[k] = static_cast<Quanta>(amounts[k]);
    }
    writer_.smear(first, first + stride, {whole, count}, outside_);
  }

  /// A ring that the sponge touches gets clay only until the sponge is as deep in it as in the ring
  /// that gives the clay: the overlap loses energy.
  void level(const Places& p, std::size_t apart, std::span<double> amounts) const noexcept {
    for (std::size_t k = 0; k < amounts.size(); ++k) {
      const bool up = amounts[k] > 0.0;
      const std::size_t from = up ? k : k + apart, to = up ? k + apart : k;
      if (!(p.depth[to] > 0.0)) continue;
      const double surface2 = std::min(p.surface[from], p.surface[to]);
      const double deeper = std::max(p.depth[from] - p.depth[to], 0.0);
      const double most = 0.25 * deeper * std::sqrt(surface2 * kMm2PerQuantum) * kQuantaPerMm2;
      amounts[k] = std::clamp(amounts[k], -most, most);
    }
  }

  const Tool& tool_;
  const ClayStack& stack_;
  const Contact& contact_;
  StackWriter& writer_;
  double hip_y_, min_wall_;
  bool sponge_;
  Slope slope_;  ///< for follow()
  double middle_, per_c_;
  std::size_t beside_from_, beside_to_;  ///< rings that the tool touches or could stand beside
  bool outside_;
};

/// A sponge in its window, of pairs from..to-1. Two strides: the larger one alone would not couple
/// all rings, and leave a zigzag.
void sponge(Smear& pairs, std::span<const Ring> rings, bool outside, std::size_t at,
            std::size_t from, std::size_t to, std::size_t stride, double k) noexcept {
  const auto open = [&](std::size_t i) { return outside || rings[i].inner2 > 0; };
  // The part of the window that is beside one bore.
  std::size_t first = at, last = at;
  while (first > from && open(first - 1)) --first;
  while (last < to + stride - 1 && open(last + 1)) ++last;
  if (!open(at)) return;
  if (last >= first + stride) pairs.follow(first, last + 1 - stride, stride, k);
  if (stride > 1 && last > first) pairs.follow(first, last, 1, kMostOfStep);
}

}  // namespace

void smear(const Tool& tool, const ClayStack& stack, double hip_y, double dt_s,
           const Contact& contact, const Band& band, const Smearing& how,
           StackWriter& writer) noexcept {
  const auto rings = stack.rings();
  const double h = stack.ring_height_mm(), c = std::max(band.height_mm(), h);
  if (!(band.deepest_mm > 0.0 && dt_s > 0.0)) return;
  const Ring& at = rings[std::min(band.ring, rings.size() - 1)];
  const double radius = contact.side == Side::compressive ? at.outer_mm() : at.inner_mm();
  const double wet = std::min(1.0, 4.0 * band.deepest_mm / how.yield_depth_mm);
  const double film = how.sponge ? kSpongeFilmMm : kFilmMm;
  const double spread = film * radius * how.surface_per_s * wet * dt_s;  // D dt
  // Distance of the places at which a step is stable.
  const double apart = std::max(1.0, std::ceil(std::sqrt(spread / kMostOfStep) / h));
  const double middle = 0.5 * (band.low_mm + band.high_mm);
  const double size = static_cast<double>(rings.size());
  const double first = std::clamp((middle - c) / h, 0.0, size);
  const double end = std::clamp((middle + c) / h + 1.0, 0.0, size) - apart;
  if (!(end > first)) return;
  const auto stride = static_cast<std::size_t>(apart), from = static_cast<std::size_t>(first),
             to = static_cast<std::size_t>(end);
  // Between two rings that the tool touches, no clay moves.
  const std::size_t touched = std::clamp(contact.rings.from(), from, to);
  const std::size_t free =
      std::clamp(contact.rings.to() - std::min(stride, contact.rings.to()), touched, to);
  const double k = spread / (apart * apart * h * h);
  Smear pairs(tool, stack, hip_y, contact, band, how, writer);
  if (how.follows)
    return sponge(pairs, rings, contact.side == Side::compressive, std::clamp(band.ring, from, to),
                  from, to, stride, k);
  if (how.sponge) return pairs.run(from, to, stride, k);
  pairs.run(from, touched, stride, k);
  pairs.run(free, to, stride, k);
}

}  // namespace clay
