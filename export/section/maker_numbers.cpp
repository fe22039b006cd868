#include "claystack/export/maker.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace clay::solid::inline section {
namespace {

/// Integrals of rho^2 dy and of rho^2 y dy along the straight line from `a` to `b`.
struct Integrals {
  double area_height = 0.0;
  double moment = 0.0;

  void add(const ProfilePoint& a, const ProfilePoint& b) noexcept {
    const double aa = a.rho * a.rho, ab = a.rho * b.rho, bb = b.rho * b.rho;
    const double height = b.y - a.y, all = aa + ab + bb;
    area_height += height * all / 3.0;
    // y = a.y + t height; the integral of t rho^2 is (aa + 2 ab + 3 bb) / 12.
    moment += height * (a.y * all / 3.0 + height * (aa + 2.0 * ab + 3.0 * bb) / 12.0);
  }

  [[nodiscard]] RevolvedBody body() const noexcept {
    if (!(area_height > 0.0)) return {};
    return {std::numbers::pi * area_height, moment / area_height};
  }
};

/// The part of the line from `a` to `b` below `level`.
void add_below(Integrals& sum, ProfilePoint a, ProfilePoint b, double level) noexcept {
  if (a.y > level && b.y > level) return;
  const auto cut = [&](const ProfilePoint& above, const ProfilePoint& below) {
    const double t = (level - below.y) / (above.y - below.y);
    return ProfilePoint{below.rho + t * (above.rho - below.rho), level};
  };
  if (a.y > level)
    a = cut(a, b);
  else if (b.y > level)
    b = cut(b, a);
  sum.add(a, b);
}

/// The last vertex on the highest level: there the bore begins.
std::size_t brim_of(const Polygon& piece) noexcept {
  std::size_t brim = 0;
  for (std::size_t i = 1; i < piece.size(); ++i)
    if (piece[i].y >= piece[brim].y) brim = i;
  // The polygon may begin in the middle of a flat rim.
  const auto next = [&](std::size_t i) { return i + 1 == piece.size() ? 0 : i + 1; };
  for (std::size_t turns = 0; turns < piece.size() && piece[next(brim)].y == piece[brim].y; ++turns)
    brim = next(brim);
  return brim;
}

PotSize size_of(const Profile& profile) noexcept {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  PotSize size;
  for (const Polygon& piece : profile.pieces) {
    for (const ProfilePoint& p : piece) {
      highest = std::max(highest, p.y);
      size.diameter_mm = std::max(size.diameter_mm, 2.0 * p.rho);
      if (p.y > lowest) continue;
      size.foot_diameter_mm =
          p.y < lowest ? 2.0 * p.rho : std::max(size.foot_diameter_mm, 2.0 * p.rho);
      lowest = p.y;
    }
  }
  size.height_mm = highest - lowest;
  return size;
}

double foot_level(const Profile& profile) noexcept {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Polygon& piece : profile.pieces)
    for (const ProfilePoint& p : piece) lowest = std::min(lowest, p.y);
  return lowest;
}

PotState scaled(const PotState& thrown, double factor, double weight) noexcept {
  const double volume = factor * factor * factor;
  const PotSize& size = thrown.size;
  return {{factor * size.diameter_mm, factor * size.height_mm, factor * size.foot_diameter_mm},
          weight * thrown.weight_g,
          volume * thrown.capacity_ml,
          volume * thrown.to_line_ml,
          factor * factor * thrown.inside_cm2,
          factor * factor * thrown.outside_cm2};
}

Balance balance(double centre_mm, double foot_diameter_mm) noexcept {
  return {centre_mm, std::atan2(0.5 * foot_diameter_mm, centre_mm) * 180.0 / std::numbers::pi};
}

std::string in_percent(double part) { return nine_digit_text(100.0 * part) + " %"; }

/// NaN is not within any limits.
Result<void> check_part(std::string_view name, double value, double most) {
  if (value >= 0.0 && value <= most) return {};
  return failure(ErrorKind::bad_input, std::string(name) + ": expected 0 % to " + in_percent(most) +
                                           ", found " + in_percent(value));
}

/// Visits the lines from the brim down the bore, each by its ends in reverse order. Returns whether
/// they reach the axis: then there is a floor.
template <class Visit>
bool along_bore(const Polygon& piece, std::size_t brim, Visit visit) noexcept {
  std::size_t at = brim;
  for (std::size_t steps = 0; steps < piece.size() && piece[at].rho > 0.0; ++steps) {
    const std::size_t next = at + 1 == piece.size() ? 0 : at + 1;
    visit(piece[next], piece[at]);
    at = next;
  }
  return !(piece[at].rho > 0.0);
}

/// Of the frustum between two points of the section [mm2].
double revolved_area(const ProfilePoint& a, const ProfilePoint& b) noexcept {
  return std::numbers::pi * (a.rho + b.rho) * std::hypot(b.rho - a.rho, b.y - a.y);
}

/// Calls edge(a, b) for the edges of the outer chain of a piece: around the whole polygon or from
/// axis to axis. The other chains bound closed cavities.
void along_outside(const Polygon& piece, auto edge) {
  const auto widest = std::ranges::max_element(piece, {}, &ProfilePoint::rho) - piece.begin();
  const std::size_t n = piece.size(), start = static_cast<std::size_t>(widest);
  std::size_t i = start;
  do {
    edge(piece[i], piece[(i + 1) % n]);
    i = (i + 1) % n;
  } while (i != start && piece[i].rho > 0.0);
  if (i == start) return;
  for (i = start; piece[i].rho > 0.0; i = (i + n - 1) % n) edge(piece[(i + n - 1) % n], piece[i]);
}

/// The surfaces that glaze may cover.
void measure_surface(const Profile& profile, PotState& pot) noexcept {
  constexpr double kPerCm2 = 1e-2;
  const double foot = foot_level(profile);
  double all = 0.0, inside = 0.0;
  for (const Polygon& piece : profile.pieces)
    along_outside(piece, [&](const ProfilePoint& a, const ProfilePoint& b) {
      if (a.y > foot || b.y > foot) all += revolved_area(a, b);
    });
  const Polygon& top = profile.pieces.back();
  const bool floor =
      along_bore(top, brim_of(top), [&](const ProfilePoint& low, const ProfilePoint& high) {
        inside += revolved_area(low, high);
      });
  pot.inside_cm2 = floor ? kPerCm2 * inside : 0.0;
  pot.outside_cm2 = kPerCm2 * all - pot.inside_cm2;
}

}  // namespace

Result<void> ClayFigures::check() const {
  if (!(density_g_cm3 > 0.0 && density_g_cm3 < 100.0))
    return failure(ErrorKind::bad_input,
                   "density: expected more than 0 and less than 100 g/cm3, found " +
                       nine_digit_text(density_g_cm3));
  return check_part("shrinkage", shrinkage, kMostShrinkage)
      .and_then([&] { return check_part("water", water, kMostWeightLoss); })
      .and_then([&] { return check_part("loss on ignition", ignition_loss, kMostWeightLoss); })
      .and_then([&]() -> Result<void> {
        const double drying = drying_shrinkage.value_or(0.0);
        if (drying >= 0.0 && drying <= shrinkage) return {};
        return failure(ErrorKind::bad_input,
                       "drying shrinkage: expected 0 % to the shrinkage in total, " +
                           in_percent(shrinkage) + ", found " + in_percent(drying));
      });
}

std::vector<std::pair<std::string, std::string>> assumptions_of(const ClayFigures& clay) {
  std::vector<std::pair<std::string, std::string>> rows{
      {"wet density", nine_digit_text(clay.density_g_cm3) + " g/cm3"}};
  if (!(clay.shrinkage > 0.0)) return rows;
  const double drying = clay.drying_shrinkage.value_or(0.5 * clay.shrinkage);
  rows.emplace_back("shrinkage", in_percent(clay.shrinkage) + " of each length");
  rows.emplace_back("of it in drying", in_percent(drying));
  rows.emplace_back("water", in_percent(clay.water) + " of the wet weight");
  rows.emplace_back("ignition loss", in_percent(clay.ignition_loss) + " of the dry weight");
  return rows;
}

RevolvedBody revolved_body(const Profile& profile) noexcept {
  Integrals sum;
  for (const Polygon& piece : profile.pieces)
    for (std::size_t i = 0; i < piece.size(); ++i)
      sum.add(piece[i], piece[i + 1 == piece.size() ? 0 : i + 1]);
  return sum.body();
}

RevolvedBody room_of(const Profile& profile, double depth_mm) noexcept {
  if (profile.pieces.empty() || profile.pieces.back().size() < 3) return {};
  const Polygon& piece = profile.pieces.back();
  const std::size_t brim = brim_of(piece);
  Integrals sum;
  // From the bottom up, so that the room is positive.
  const bool floor =
      along_bore(piece, brim, [&](const ProfilePoint& low, const ProfilePoint& high) {
        add_below(sum, low, high, piece[brim].y - depth_mm);
      });
  return floor ? sum.body() : RevolvedBody{};
}

namespace {

/// Dry and fired, by the shrinkage, if that is known.
void add_later_states(MakerNumbers& numbers) {
  const ClayFigures& clay = numbers.clay;
  if (!(clay.shrinkage > 0.0)) return;
  const double drying = clay.drying_shrinkage.value_or(0.5 * clay.shrinkage);
  numbers.dry = scaled(numbers.thrown, 1.0 - drying, 1.0 - clay.water);
  numbers.fired =
      scaled(numbers.thrown, 1.0 - clay.shrinkage, (1.0 - clay.water) * (1.0 - clay.ignition_loss));
}

constexpr double kPerMl = 1e-3;

std::string no_capacity_of(const Profile& profile) {
  if (profile.pieces.size() > 1)
    return "the pot is in " + std::to_string(profile.pieces.size()) + " pieces";
  const Polygon& top = profile.pieces.back();
  return top[brim_of(top)].rho > 0.0 ? "no floor under an open bore" : "no opening at the top";
}

}  // namespace

MakerNumbers fallen_numbers(const PotSize& size, double volume_mm3, const ClayFigures& clay,
                            double fill_line_mm) {
  MakerNumbers numbers;
  numbers.clay = clay;
  numbers.fill_line_mm = fill_line_mm;
  numbers.thrown.size = size;
  numbers.thrown.weight_g = kPerMl * volume_mm3 * clay.density_g_cm3;
  add_later_states(numbers);
  return numbers;
}

MakerNumbers maker_numbers(const Profile& profile, const ClayFigures& clay, double fill_line_mm) {
  MakerNumbers numbers;
  numbers.clay = clay;
  numbers.fill_line_mm = fill_line_mm;
  const double fired = 1.0 - clay.shrinkage;
  const RevolvedBody body = revolved_body(profile), room = room_of(profile);
  PotState& thrown = numbers.thrown;
  thrown.size = size_of(profile);
  thrown.weight_g = kPerMl * body.volume_mm3 * clay.density_g_cm3;
  thrown.capacity_ml = kPerMl * room.volume_mm3;
  thrown.to_line_ml = kPerMl * room_of(profile, fill_line_mm / fired).volume_mm3;
  measure_surface(profile, thrown);
  if (!(thrown.capacity_ml > 0.0)) numbers.no_capacity = no_capacity_of(profile);
  add_later_states(numbers);
  const PotState& used = numbers.in_use();
  const double foot = foot_level(profile), centre = fired * (body.centre_mm - foot);
  numbers.empty = balance(centre, used.size.foot_diameter_mm);
  if (used.capacity_ml > 0.0) {
    const double contents_g = kContentsDensity * used.capacity_ml;
    const double both = (used.weight_g * centre + contents_g * fired * (room.centre_mm - foot)) /
                        (used.weight_g + contents_g);
    numbers.full = balance(both, used.size.foot_diameter_mm);
  }
  return numbers;
}

void add_glaze(MakerNumbers& numbers, const Profile& section) {
  numbers.glazed = maker_numbers(section, numbers.clay, numbers.fill_line_mm).in_use();
  numbers.glazed->weight_g = numbers.in_use().weight_g;
}

}  // namespace clay::solid::inline section
