#include "app/import/hollowing.hpp"

#include "app/import/deviation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace clay::importing {
namespace {

/// The radius of the bore at each height: the outside, eroded by a disc of the wall's radius. That
/// is the least r(z + d) - sqrt(wall^2 - d^2) of the outside r over |d| < wall. Nothing is outside
/// above the rim, where the bore is open.
class BoreRadius {
 public:
  BoreRadius(const std::vector<Slab>& slabs, double wall_mm) : slabs_(slabs), wall_mm_(wall_mm) {
    if (slabs.empty()) return;
    least_mm_.resize(2 * slabs.size() - 1);
    note_least({0, slabs});
  }

  [[nodiscard]] double operator()(double height_mm) const {
    double radius = kOpen;
    if (!slabs_.empty()) lower(radius, height_mm, {0, slabs_});
    return radius;
  }

 private:
  static constexpr double kOpen = 1e300;  ///< no slab limits the bore

  /// A range of neighbouring slabs: a node of a binary tree that halves it down to single slabs.
  /// `least_mm_` holds the tree in preorder: a range, its first half with all parts of that, its
  /// second half.
  struct Part {
    std::size_t number = 0;
    std::span<const Slab> slabs;

    [[nodiscard]] bool single() const { return slabs.size() == 1; }
    [[nodiscard]] std::size_t half() const { return slabs.size() / 2; }
    [[nodiscard]] Part first() const { return {number + 1, slabs.first(half())}; }
    [[nodiscard]] Part second() const { return {number + 2 * half(), slabs.subspan(half())}; }
  };

  double note_least(const Part& part) {
    const Slab& slab = part.slabs.front();
    return least_mm_[part.number] =
               part.single() ? std::min(slab.outer_from_mm, slab.outer_to_mm)
                             : std::min(note_least(part.first()), note_least(part.second()));
  }

  /// Lowers the radius to the largest that the slabs of a part allow. Begins with the half whose
  /// bound is smaller.
  void lower(double& radius, double height_mm, const Part& part) const {
    if (part.single()) {
      if (in_reach(part, height_mm)) radius = std::min(radius, beside(part.slabs[0], height_mm));
      return;
    }
    Part one = part.first(), other = part.second();
    double one_mm = bound_of(one, height_mm), other_mm = bound_of(other, height_mm);
    if (other_mm < one_mm) {
      std::swap(one, other);
      std::swap(one_mm, other_mm);
    }
    if (one_mm < radius) lower(radius, height_mm, one);
    if (other_mm < radius) lower(radius, height_mm, other);
  }

  [[nodiscard]] bool in_reach(const Part& part, double height_mm) const {
    return part.slabs.back().to_mm > height_mm - wall_mm_ &&
           part.slabs.front().from_mm < height_mm + wall_mm_;
  }

  /// Lower bound of the radius that the slabs of the part allow.
  [[nodiscard]] double bound_of(const Part& part, double height_mm) const {
    if (!in_reach(part, height_mm)) return kOpen;
    constexpr double kRoundingMm = 1e-6;  // error of `beside` on slabs that are almost level
    const double d = std::max(
        {0.0, part.slabs.front().from_mm - height_mm, height_mm - part.slabs.back().to_mm});
    return least_mm_[part.number] - std::sqrt(std::max(0.0, wall_mm_ * wall_mm_ - d * d)) -
           kRoundingMm;
  }

  /// The radius that this slab alone allows. Along a straight outside, the limit is convex in d,
  /// and smallest where the disc touches the outside.
  [[nodiscard]] double beside(const Slab& slab, double height_mm) const {
    const double slope = (slab.outer_to_mm - slab.outer_from_mm) / (slab.to_mm - slab.from_mm);
    const double low = std::max(-wall_mm_, slab.from_mm - height_mm);
    const double high = std::min(wall_mm_, slab.to_mm - height_mm);
    // Rounding may put `low` above `high` at the edge of the disc.
    const double d = std::max(low, std::min(-slope * wall_mm_ / std::hypot(1.0, slope), high));
    return slab.outer_from_mm + slope * (height_mm + d - slab.from_mm) -
           std::sqrt(std::max(0.0, wall_mm_ * wall_mm_ - d * d));
  }

  const std::vector<Slab>& slabs_;
  double wall_mm_;
  std::vector<double> least_mm_;  ///< radius of each part
};

/// A straight piece of the bore's outline. Radii are negative where there is no bore.
struct BorePiece {
  double from_mm = 0.0, to_mm = 0.0;  ///< heights
  double radius_from_mm = 0.0, radius_to_mm = 0.0;
};

/// Appends chords within about kFlatMm of the bore, which is continuous between the ends.
void append_chords(std::vector<BorePiece>& pieces, const BoreRadius& bore, const BorePiece& chord) {
  constexpr double kLowestMm = 1e-4;
  const double height = chord.to_mm - chord.from_mm;
  bool straight = true;
  for (const double part : {0.25, 0.5, 0.75})
    straight =
        straight && std::abs(bore(chord.from_mm + part * height) -
                             std::lerp(chord.radius_from_mm, chord.radius_to_mm, part)) <= kFlatMm;
  if (straight || height < kLowestMm) {
    pieces.push_back(chord);
    return;
  }
  const double middle = 0.5 * (chord.from_mm + chord.to_mm), radius = bore(middle);
  append_chords(pieces, bore, {chord.from_mm, middle, chord.radius_from_mm, radius});
  append_chords(pieces, bore, {middle, chord.to_mm, radius, chord.radius_to_mm});
}

/// From the floor to the rim. A level face of the outside breaks the bore a wall above or below it.
std::vector<BorePiece> bore_pieces(const HalfSection& solid, double wall_mm, double floor_mm) {
  constexpr double kMostSteps = 100'000.0;
  const double rim = solid.height_mm;
  std::vector<double> breaks{floor_mm, rim};
  const double step = std::max(0.125 * wall_mm, rim / kMostSteps);
  for (double z = floor_mm; z < rim; z += step) breaks.push_back(z);
  for (std::size_t i = 1; i < solid.slabs.size(); ++i) {
    const Slab &below = solid.slabs[i - 1], &above = solid.slabs[i];
    if (below.outer_to_mm == above.outer_from_mm) continue;
    const double level = above.from_mm;
    breaks.push_back(below.outer_to_mm < above.outer_from_mm ? level + wall_mm : level - wall_mm);
  }
  std::sort(breaks.begin(), breaks.end());
  const BoreRadius bore(solid.slabs, wall_mm);
  std::vector<BorePiece> pieces;
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double from = breaks[i - 1], to = breaks[i], inside = 1e-6 * (to - from);
    if (from < floor_mm || to > rim || !(from < to)) continue;
    append_chords(pieces, bore, {from, to, bore(from + inside), bore(to - inside)});
  }
  return pieces;
}

/// The pieces with a bore. Refuses a bore that is closed between them or at the rim.
Result<std::vector<BorePiece>> open_bore(const std::vector<BorePiece>& pieces, double rim_mm,
                                         double wall_mm, const std::string& name) {
  std::vector<BorePiece> open;
  double ends_mm = rim_mm;  // of the bore below
  const auto refused = [&](const std::string& why) {
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: wall: expected a wall that leaves a bore up to the rim, found "
                               "{:g} mm; {}",
                               name, wall_mm, why));
  };
  const auto closed_at = [&](double height_mm) {
    return refused(fmt::format("the bore would close {:.3g} mm above the foot", height_mm));
  };
  for (BorePiece piece : pieces) {
    if (!(std::max(piece.radius_from_mm, piece.radius_to_mm) > 0.0)) continue;
    const double part = piece.radius_from_mm / (piece.radius_from_mm - piece.radius_to_mm);
    const double axis_mm = std::lerp(piece.from_mm, piece.to_mm, part);
    if (piece.radius_from_mm < 0.0) piece.from_mm = axis_mm, piece.radius_from_mm = 0.0;
    if (piece.radius_to_mm < 0.0) piece.to_mm = axis_mm, piece.radius_to_mm = 0.0;
    if (!(piece.from_mm < piece.to_mm)) continue;  // rounded to nothing: it has no slope
    if (!open.empty() && ends_mm < piece.from_mm) return closed_at(ends_mm);
    ends_mm = piece.to_mm;
    open.push_back(piece);
  }
  if (open.empty()) return refused("there would be no bore");
  if (ends_mm < rim_mm) return closed_at(ends_mm);
  return open;
}

/// Slabs with the bore, split where either outline has an end.
std::vector<Slab> bored(const std::vector<Slab>& solid, const std::vector<BorePiece>& bore) {
  std::vector<Slab> slabs;
  std::size_t next = 0;
  for (const Slab& slab : solid) {
    double from = slab.from_mm;
    const double floor = std::clamp(bore.front().from_mm, slab.from_mm, slab.to_mm);
    if (floor > from) slabs.push_back(part_of(slab, from, floor));
    for (from = floor; from < slab.to_mm;) {
      const BorePiece& piece = bore[next];
      const bool last = next + 1 == bore.size();
      const double to = last ? slab.to_mm : std::min(slab.to_mm, piece.to_mm);
      const auto radius_at = [&](double z) {
        return std::lerp(piece.radius_from_mm, piece.radius_to_mm,
                         (z - piece.from_mm) / (piece.to_mm - piece.from_mm));
      };
      Slab wall = part_of(slab, from, to);
      wall.inner_from_mm = radius_at(from), wall.inner_to_mm = radius_at(to);
      slabs.push_back(wall);
      if (to >= piece.to_mm && !last) ++next;
      from = to;
    }
  }
  return slabs;
}

/// The outside and foot of solid slabs, without level parts at the rim.
std::vector<Segment> below_rim(const std::vector<Slab>& solid, double height_mm) {
  std::vector<Segment> outline = outline_of(solid);
  std::erase_if(outline, [&](const Segment& s) { return std::min(s.from.y, s.to.y) >= height_mm; });
  return outline;
}

}  // namespace

Slab part_of(const Slab& slab, double from, double to) {
  const auto along = [&](double a, double b, double y) {
    return a + (b - a) * ((y - slab.from_mm) / (slab.to_mm - slab.from_mm));
  };
  return {from,
          to,
          along(slab.outer_from_mm, slab.outer_to_mm, from),
          along(slab.outer_from_mm, slab.outer_to_mm, to),
          along(slab.inner_from_mm, slab.inner_to_mm, from),
          along(slab.inner_from_mm, slab.inner_to_mm, to)};
}

Result<HalfSection> hollowed(const HalfSection& solid, double wall_mm, const std::string& name,
                             double more_mm) {
  for (const Slab& slab : solid.slabs)
    if (slab.inner_from_mm > 0.0 || slab.inner_to_mm > 0.0)
      return failure(ErrorKind::bad_input,
                     name + ": wall: expected a drawing of the outside alone, found a bore in it");
  if (!(wall_mm < solid.height_mm))
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: wall: expected less than the height of {:g} mm, found {:g} mm",
                               name, solid.height_mm, wall_mm));
  const auto bore =
      open_bore(bore_pieces(solid, wall_mm + more_mm, wall_mm), solid.height_mm, wall_mm, name);
  if (!bore) return tl::make_unexpected(bore.error());
  HalfSection section = solid;
  section.slabs = bored(solid.slabs, *bore);
  return section;
}

// Two lines that do not cross are nearest at an end of one of them.
ThinnestWall thinnest_wall(const HalfSection& section) {
  std::vector<Slab> solid = section.slabs, bore;
  for (Slab& slab : solid) {
    if (slab.inner_from_mm > 0.0 || slab.inner_to_mm > 0.0)
      bore.push_back({slab.from_mm, slab.to_mm, slab.inner_from_mm, slab.inner_to_mm, 0.0, 0.0});
    slab.inner_from_mm = slab.inner_to_mm = 0.0;
  }
  const auto outside = below_rim(solid, section.height_mm),
             inside = below_rim(bore, section.height_mm);
  ThinnestWall thinnest{1e300, 0.0, 0.0};
  for (const auto& [ends, other] : {std::pair(&inside, &outside), {&outside, &inside}}) {
    std::vector<glm::dvec2> points;
    for (const Segment& s : *ends) points.insert(points.end(), {s.from, s.to});
    const std::vector<double> distances = distances_from(*other, points);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (distances[i] < thinnest.mm) thinnest = {distances[i], points[i].x, points[i].y};
  }
  return thinnest;
}

}  // namespace clay::importing
