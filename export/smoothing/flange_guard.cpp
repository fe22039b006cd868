#include "export/smoothing/flange_guard.hpp"

#include "core/cancel.hpp"
#include "export/smoothing/fair_wall.hpp"
#include "export/walls/vertex_walls.hpp"

#include <algorithm>
#include <cmath>

namespace clay::solid::inline smoothing {
namespace {

constexpr double kOnLine = 1e-9;  ///< of the radii and heights
constexpr int kRoundsOfOneRing = 2;

double distance2(const ProfilePoint& p, const ProfilePoint& a, const ProfilePoint& b) {
  const double rho = b.rho - a.rho, y = b.y - a.y, length2 = rho * rho + y * y;
  const double along = length2 > 0.0 ? ((p.rho - a.rho) * rho + (p.y - a.y) * y) / length2 : 0.0;
  const double t = std::clamp(along, 0.0, 1.0);
  const double off_rho = p.rho - a.rho - t * rho, off_y = p.y - a.y - t * y;
  return off_rho * off_rho + off_y * off_y;
}

bool lies_on(const ProfilePoint& p, const Polygon& line) {
  const double reach = kOnLine * (std::abs(p.rho) + std::abs(p.y));
  for (std::size_t e = 0; e + 1 < line.size(); ++e)
    if (distance2(p, line[e], line[e + 1]) <= reach * reach) return true;
  return false;
}

/// Such walls are those that the wall guard compares: from the outer wall to the bore, or across
/// the axis.
bool joins_both_walls(const Wall& wall, const WallLines& lines) {
  if (wall.to.rho < 0.0) return true;
  return (lies_on(wall.from, lines.outer) && lies_on(wall.to, lines.bore)) ||
         (lies_on(wall.to, lines.outer) && lies_on(wall.from, lines.bore));
}

}  // namespace

double FlangeGuard::required_mm() {
  if (!required_mm_)
    required_mm_ = std::min(limit_mm_, min_wall_mm({{outline_of(stepped_lines(piece_))}}));
  return *required_mm_;
}

std::size_t FlangeGuard::ring_at(double y) const {
  const auto above = std::upper_bound(piece_.level.begin(), piece_.level.end(), y);
  const auto ring = std::max<std::ptrdiff_t>(above - piece_.level.begin(), 1) - 1;
  return std::min(static_cast<std::size_t>(ring), piece_.size() - 1);
}

/// By ring; `required_mm` where walls are not thinner.
std::vector<double> FlangeGuard::walls_below(double required_mm, const Profile& profile,
                                             const Wall& thinnest) const {
  std::vector<double> walls_mm(piece_.size(), required_mm);
  const auto add = [&](const ProfilePoint& p, double wall_mm) {
    double& at = walls_mm[ring_at(p.y)];
    at = std::min(at, wall_mm);
  };
  add(thinnest.from, thinnest.thickness_mm);
  add(thinnest.to, thinnest.thickness_mm);
  const std::vector<double> walls = thin_vertex_walls(profile.pieces.front(), required_mm);
  for (std::size_t v = 0; v < walls.size(); ++v) {
    step_of_loop();
    if (walls[v] < required_mm) add(profile.pieces.front()[v], walls[v]);
  }
  return walls_mm;
}

std::vector<ThinRing> FlangeGuard::thin_rings(const WallLines& lines, const Profile& profile,
                                              const Wall& thinnest) {
  if (thinnest.thickness_mm >= limit_mm_ * kWallRounding || thinnest.compact) return {};
  const double required = required_mm() * kWallRounding;
  if (thinnest.thickness_mm >= required || joins_both_walls(thinnest, lines)) return {};
  const std::vector<double> walls_mm = walls_below(required, profile, thinnest);
  std::vector<ThinRing> rings;
  std::size_t next = 0;  // the first ring that has not been added
  for (std::size_t i = 0; i < walls_mm.size(); ++i) {
    if (walls_mm[i] >= required) continue;
    const std::size_t last = std::min(i + reach_, walls_mm.size() - 1);
    for (next = std::max(next, i - std::min(i, reach_)); next <= last; ++next)
      rings.push_back({next, std::min(walls_mm[i], walls_mm[next])});
  }
  if (++rounds_ > kRoundsOfOneRing) reach_ = 2 * reach_ + 1;
  return rings;
}

std::vector<ThinRing> FlangeGuard::rings_below(double required_mm, const Profile& profile,
                                               const Wall& thinnest) const {
  if (thinnest.thickness_mm >= required_mm || thinnest.compact) return {};
  const std::vector<double> walls_mm = walls_below(required_mm, profile, thinnest);
  std::vector<ThinRing> rings;
  for (std::size_t i = 0; i < walls_mm.size(); ++i)
    if (walls_mm[i] < required_mm) rings.push_back({i, walls_mm[i]});
  return rings;
}

}  // namespace clay::solid::inline smoothing
