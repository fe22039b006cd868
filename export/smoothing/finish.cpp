// The finish of a section: set-back for glaze, foot ring, fillet of the floor; and its guard.

#include "claystack/export/proof.hpp"
#include "claystack/export/smoothing.hpp"
#include "claystack/export/walls.hpp"
#include "core/size_text.hpp"
#include "core/text.hpp"
#include "export/smoothing/lip_fillet.hpp"
#include "export/smoothing/set_back.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace clay::solid::inline smoothing {
namespace {

constexpr int kDecimals = 2;

std::string mm(double value) { return size_text(value, kDecimals) + " mm"; }

/// A limit as text that itself keeps the limit: rounded down.
std::string at_most_mm(double value) { return bound_text(value, kDecimals) + " mm"; }
/// The same, rounded up.
std::string at_least_mm(double value) { return mm(std::ceil(100.0 * value) / 100.0); }

tl::unexpected<Error> wrong(const std::string& part, const std::string& why) {
  return failure(ErrorKind::bad_input, part + ": " + why);
}

// ---- foot ring -----------------------------------------------------------------------

class FootCut {
 public:
  FootCut(const WallLines& lines, const FootRing& ring)
      : lines_(lines),
        ring_(ring),
        low_(lines.outer.front().y),
        high_(low_ + ring.depth_mm),
        outside_(ring.diameter_mm ? 0.5 * *ring.diameter_mm : lines.outer.front().rho) {}

  Result<Polygon> run() const {
    return check().map([&] {
      const double inside = outside_ - ring_.width_mm;
      Polygon section{{inside, high_}, {inside, low_}};
      if (ring_.diameter_mm) {
        section.push_back({outside_, low_});
        section.push_back({outside_, high_});
        section.push_back({radius_at_depth(), high_});
      }
      for (const ProfilePoint& p : lines_.outer)
        if (!ring_.diameter_mm || p.y > high_) section.push_back(p);
      section.insert(section.end(), lines_.bore.rbegin(), lines_.bore.rend());
      section.back() = {0.0, high_};
      section.erase(std::unique(section.begin(), section.end()), section.end());
      return section;
    });
  }

 private:
  [[nodiscard]] Result<void> check() const {
    const ProfilePoint& axis = lines_.bore.front();
    if (axis.rho > 0.0 || axis.y > low_ || lines_.bore.size() < 2)
      return wrong("foot ring", "expected a solid foot, found a pot that is open or hollow below");
    // The clay on the axis above the foot.
    if (const double floor = lines_.bore[1].y - low_; !(floor > ring_.depth_mm))
      return wrong("foot ring", below("depth", floor, "thickness of the floor", ring_.depth_mm));
    if (!(outside_ > ring_.width_mm))
      return wrong("foot ring", below("width", outside_, "radius of the ring", ring_.width_mm));
    const double narrowest = narrowest_mm();
    if (ring_.diameter_mm && outside_ > narrowest)
      return wrong("foot ring",
                   "expected a diameter of at most " + at_most_mm(2.0 * narrowest) +
                       ", the narrowest of the pot within the depth of the ring, found " +
                       mm(2.0 * outside_));
    // A ring as wide as the foot, of a pot that narrows above it.
    if (outside_ - ring_.width_mm >= narrowest)
      return wrong("foot ring", "expected a width above " + at_least_mm(outside_ - narrowest) +
                                    ", because the pot narrows by that much within the depth of "
                                    "the ring, found " +
                                    mm(ring_.width_mm));
    return {};
  }

  /// With the decimals that distinguish both sizes.
  static std::string below(const std::string& name, double limit_mm, const std::string& meaning,
                           double found_mm) {
    const bool apart = mm(limit_mm) != mm(found_mm) || limit_mm == found_mm;
    const int decimals = decimals_apart(limit_mm, found_mm, kDecimals);
    const auto text = [&](double size_mm) {
      return apart ? mm(size_mm) : fixed(size_mm, decimals) + " mm";
    };
    return "expected a " + name + " below " + text(limit_mm) + ", the " + meaning + ", found " +
           text(found_mm);
  }

  /// The outer radius at the upper end of the cut; at a step, of the clay above it.
  [[nodiscard]] double radius_at_depth() const {
    const Polygon& line = lines_.outer;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      if (line[i].y <= high_ && high_ < line[i + 1].y) {
        const double t = (high_ - line[i].y) / (line[i + 1].y - line[i].y);
        return line[i].rho + t * (line[i + 1].rho - line[i].rho);
      }
    return line.back().rho;
  }

  /// The smallest outer radius along the cut.
  [[nodiscard]] double narrowest_mm() const {
    double narrowest = radius_at_depth();
    for (const ProfilePoint& p : lines_.outer)
      if (p.y <= high_) narrowest = std::min(narrowest, p.rho);
    return narrowest;
  }

  const WallLines& lines_;
  const FootRing& ring_;
  double low_, high_, outside_;
};

// ---- fillet of the floor -------------------------------------------------------------

/// The bore upside down, from the rim to the floor: the air inside it then lies like the clay at a
/// lip.
Polygon turned(const Polygon& line) {
  Polygon result(line.rbegin(), line.rend());
  for (ProfilePoint& p : result) p.y = -p.y;
  return result;
}

class FloorFillet {
 public:
  FloorFillet(const WallLines& lines, double tolerance_mm)
      : lines_(lines), tolerance_mm_(tolerance_mm) {
    while (floor_ < lines.bore.size() && lines.bore[floor_].rho == 0.0) ++floor_;
    if (has_floor())
      wall_ = turned({lines.bore.begin() + std::ptrdiff_t(floor_), lines.bore.end()});
  }

  Result<Polygon> run(double radius_mm) const {
    if (!has_floor())
      return wrong("floor fillet", "expected a flat floor under an open bore, found none");
    if (!fits(radius_mm))
      return wrong("floor fillet", "expected a radius of at most " + at_most_mm(largest_mm()) +
                                       ", with which it meets floor and wall, found " +
                                       mm(radius_mm));
    WallLines lines = lines_;
    const Polygon rounded = turned(with_rounded_edge(wall_, radius_mm, tolerance_mm_).line);
    lines.bore.resize(floor_);
    lines.bore.insert(lines.bore.end(), rounded.begin(), rounded.end());
    return outline_of(lines);
  }

 private:
  [[nodiscard]] bool has_floor() const {
    return floor_ > 0 && floor_ < lines_.bore.size() &&
           lines_.bore[floor_].y == lines_.bore[floor_ - 1].y;
  }
  [[nodiscard]] bool fits(double radius_mm) const {
    return radius_mm < wall_.back().y - wall_.front().y &&
           with_rounded_edge(wall_, radius_mm, radius_mm).touch_rho > 0.0;
  }
  [[nodiscard]] double largest_mm() const {
    constexpr int kHalvings = 30;
    double low = 0.0, high = wall_.back().y - wall_.front().y;
    for (int k = 0; k < kHalvings; ++k)
      (fits(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
    return low;
  }

  const WallLines& lines_;
  double tolerance_mm_;
  std::size_t floor_ = 0;  ///< the first point of the bore off the axis
  Polygon wall_;
};

// ---- all of it -----------------------------------------------------------------------

/// Refuses NaN, infinity and negative lengths; 0 unless `zero_allowed`.
Result<void> check_length(const std::string& name, double mm, bool zero_allowed) {
  if (std::isfinite(mm) && (mm > 0.0 || (zero_allowed && mm == 0.0))) return {};
  return wrong(name, std::string("expected ") + (zero_allowed ? "0 mm or more" : "more than 0 mm") +
                         ", found " + nine_digit_text(mm) + " mm");
}

Result<void> check(const Finish& finish, double tolerance_mm) {
  const std::optional<FootRing>& foot = finish.foot;
  return check_length("tolerance", tolerance_mm, false)
      .and_then([&] { return check_length("glaze allowance", finish.glaze_mm, true); })
      .and_then([&] { return check_length("floor fillet", finish.floor_fillet_mm, true); })
      .and_then([&] { return check_length("foot ring width", foot ? foot->width_mm : 1.0, false); })
      .and_then([&] { return check_length("foot ring depth", foot ? foot->depth_mm : 1.0, false); })
      .and_then([&] {
        return check_length("foot ring diameter", foot ? foot->diameter_mm.value_or(1.0) : 1.0,
                            false);
      });
}

class Finisher {
 public:
  Finisher(const Profile& profile, std::optional<double> min_wall_mm, double tolerance_mm)
      : made_{profile, {}}, min_wall_mm_(min_wall_mm), tolerance_mm_(tolerance_mm) {}

  Result<FinishedProfile> run(const Finish& finish) {
    if (made_.profile.pieces.size() != 1)
      return wrong("finish",
                   "expected one piece, found " + std::to_string(made_.profile.pieces.size()));
    return set_back_for_glaze(finish.glaze_mm)
        .and_then([&] { return fill_floor(finish.floor_fillet_mm); })
        .and_then([&] { return cut_foot(finish.foot); })
        .map([&] { return std::move(made_); });
  }

 private:
  Result<void> set_back_for_glaze(double glaze_mm) {
    if (glaze_mm == 0.0) return {};
    const Wall wall = min_wall(made_.profile);
    if (!(wall.thickness_mm > 2.0 * glaze_mm))
      return too_thin("glaze allowance", "more than", 2.0 * glaze_mm, wall);
    return apply("glaze allowance", set_back(lines(), glaze_mm, 0.5 * tolerance_mm_),
                 min_wall_mm_.value_or(0.0), made_.ledger.glaze_trimmed_mm3, -1.0);
  }
  Result<void> cut_foot(const std::optional<FootRing>& foot) {
    if (!foot) return {};
    const double limit = min_wall_mm_.value_or(0.0);
    const double before = min_wall(made_.profile).thickness_mm;
    const std::string part = before < limit
                                 ? "foot ring of a pot whose thinnest wall, " + mm(before) +
                                       ", is below the limit of " + mm(limit) + " already"
                                 : "foot ring";
    return apply(part, FootCut(lines(), *foot).run(), std::min(before, limit),
                 made_.ledger.foot_trimmed_mm3, -1.0);
  }
  /// Adds clay in a corner: no wall becomes thinner.
  Result<void> fill_floor(double radius_mm) {
    if (radius_mm == 0.0) return {};
    return apply("floor fillet", FloorFillet(lines(), tolerance_mm_).run(radius_mm), 0.0,
                 made_.ledger.floor_added_mm3, 1.0);
  }

  [[nodiscard]] WallLines lines() const { return lines_of(made_.profile.pieces.front()); }

  /// Takes the section over if it is sound and its walls are thick enough. `clay_mm3`: its change,
  /// times `sign`.
  Result<void> apply(const std::string& part, Result<Polygon> section, double required_mm,
                     double& clay_mm3, double sign) {
    if (!section) return tl::make_unexpected(section.error());
    Profile changed{{std::move(*section)}};
    if (auto sound = certify(changed); !sound)
      return failure(ErrorKind::unsound, part + ": " + sound.error().message);
    const Wall wall = min_wall(changed);
    WallLimit required;
    required.min_wall_mm = required_mm;
    if (!required.met_by(wall.thickness_mm)) return too_thin(part, "at least", required_mm, wall);
    clay_mm3 = sign * (volume_of(changed) - volume_of(made_.profile));
    made_.profile = std::move(changed);
    return {};
  }

  /// The error for a wall that is too thin. Both figures get enough decimals to differ.
  static tl::unexpected<Error> too_thin(const std::string& part, const std::string& comparison,
                                        double required_mm, const Wall& wall) {
    const bool smaller = wall.thickness_mm < required_mm;
    const int decimals =
        smaller ? decimals_apart(required_mm, wall.thickness_mm, kDecimals) : kDecimals;
    return failure(ErrorKind::unsound, part + ": expected walls of " + comparison + " " +
                                           size_text(required_mm, decimals) + " mm, found " +
                                           bound_text(wall.thickness_mm, decimals) +
                                           " mm at a height of " + mm(wall.from.y) + ", " +
                                           mm(wall.from.rho) + " from the axis");
  }

  FinishedProfile made_;
  std::optional<double> min_wall_mm_;
  double tolerance_mm_;
};

}  // namespace

Result<FinishedProfile> finished(const Profile& profile, const Finish& finish,
                                 std::optional<double> min_wall_mm, double tolerance_mm) {
  return check(finish, tolerance_mm).and_then([&] {
    return Finisher(profile, min_wall_mm, tolerance_mm).run(finish);
  });
}

}  // namespace clay::solid::inline smoothing
