#include "export/solid/revolved_brep.hpp"

#include "core/text.hpp"
#include "export/section/stack_section.hpp"
#include "export/section/swept_volume.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace clay::solid {
namespace {

const double kSharpCosine = std::cos(std::numbers::pi / 6.0);

double on_grid(double mm, double grid_mm = kBrepGridMm) {
  return std::round(mm / grid_mm) * grid_mm + 0.0;
}
ProfilePoint on_grid(const ProfilePoint& p, double grid_mm = kBrepGridMm) {
  return {on_grid(p.rho, grid_mm), on_grid(p.y, grid_mm)};
}

/// A power of ten, well below the tolerance: the grid moves the curves.
double control_grid_mm(double tolerance_mm) {
  constexpr double kPart = 0.05;
  const double fine_mm = std::pow(10.0, std::floor(std::log10(kPart * tolerance_mm)));
  return std::clamp(fine_mm, kBrepGridMm, kControlGridMm);
}

/// A part of a section that sweeps one shell.
struct Line {
  Polygon points;
  bool round = false;
};

Line line_of(const Polygon& polygon, const Chain& chain) {
  Line line{{}, chain.round};
  const std::size_t count = chain.edges + (chain.round ? 0 : 1);
  for (std::size_t i = 0; i < count; ++i)
    line.points.push_back(on_grid(polygon[(chain.first + i) % polygon.size()]));
  return line;
}

/// A point where two surfaces meet: a sharp corner, or an end of a flat part.
bool is_corner(const ProfilePoint& before, const ProfilePoint& at, const ProfilePoint& after) {
  if (before.y == at.y || at.y == after.y) return true;
  const double ux = at.rho - before.rho, uy = at.y - before.y;
  const double vx = after.rho - at.rho, vy = after.y - at.y;
  return ux * vx + uy * vy < kSharpCosine * std::hypot(ux, uy) * std::hypot(vx, vy);
}

/// The points where walls end, from the first to the last; `line` is turned to begin at one.
std::vector<std::size_t> corners_of(Line& line) {
  const std::size_t n = line.points.size();
  const auto corner = [&](std::size_t i) {
    return is_corner(line.points[(i + n - 1) % n], line.points[i], line.points[(i + 1) % n]);
  };
  std::vector<std::size_t> corners;
  if (!line.round) {
    corners.push_back(0);
    for (std::size_t i = 1; i + 1 < n; ++i)
      if (corner(i)) corners.push_back(i);
    corners.push_back(n - 1);
    return corners;
  }
  std::size_t first = 0;
  while (first < n && !corner(first)) ++first;
  if (first < n)
    std::rotate(line.points.begin(), line.points.begin() + std::ptrdiff_t(first),
                line.points.end());
  for (std::size_t i = 0; i < n; ++i)
    if (i == 0 || corner(i)) corners.push_back(i);
  if (corners.size() == 1) corners.push_back(n / 2);
  line.points.push_back(line.points.front());
  corners.push_back(n);
  return corners;
}

BrepWall curved(const Polygon& points, double tolerance_mm, double grid_mm) {
  BrepWall wall{points.front(), points.back(), fitted(points, tolerance_mm)};
  auto& control = wall.curve->control;
  control.front() = on_grid(control.front()), control.back() = on_grid(control.back());
  for (std::size_t i = 1; i + 1 < control.size(); ++i) control[i] = on_grid(control[i], grid_mm);
  return wall;
}

BrepShell shell_of(Line line, StepWalls walls, double tolerance_mm, double grid_mm) {
  BrepShell shell;
  if (walls == StepWalls::lines) {
    if (line.round) line.points.push_back(line.points.front());
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
      shell.push_back({line.points[i], line.points[i + 1], std::nullopt});
    return shell;
  }
  const std::vector<std::size_t> corners = corners_of(line);
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Polygon points(line.points.begin() + std::ptrdiff_t(corners[i]),
                         line.points.begin() + std::ptrdiff_t(corners[i + 1]) + 1);
    shell.push_back(points.size() == 2 ? BrepWall{points.front(), points.back(), std::nullopt}
                                       : curved(points, tolerance_mm, grid_mm));
  }
  return shell;
}

double volume_of(const BrepWall& wall) {
  return wall.curve ? swept_volume(*wall.curve)
                    : section::swept_volume(Polygon{wall.from, wall.to}, false);
}

double volume_of(const BrepBody& body) {
  CompensatedSum sum;
  for (const BrepShell& shell : body)
    for (const BrepWall& wall : shell) sum.add(volume_of(wall));
  return sum.value();
}

/// The curve with its inner control points farther from the axis.
WallCurve moved(WallCurve curve, double out_mm, double grid_mm) {
  for (std::size_t i = 1; i + 1 < curve.control.size(); ++i)
    curve.control[i].rho = on_grid(curve.control[i].rho + out_mm, grid_mm);
  return curve;
}

/// The curve with only its middle control point farther from the axis.
WallCurve middle_moved(WallCurve curve, double out_mm) {
  ProfilePoint& middle = curve.control[curve.control.size() / 2];
  middle.rho = on_grid(middle.rho + out_mm);
  return curve;
}

/// Moves a curve until it encloses this volume. The volume is a quadratic function of the move;
/// three steps of Newton's method reach the grid.
template <class Move>
WallCurve enclosing(const WallCurve& curve, double volume_mm3, Move move) {
  constexpr double kStepMm = 1e-3;
  double out = 0.0;
  for (int step = 0; step < 3; ++step) {
    const double slope =
        (swept_volume(move(curve, out + kStepMm)) - swept_volume(move(curve, out - kStepMm))) /
        (2.0 * kStepMm);
    if (slope == 0.0) break;
    out += (volume_mm3 - swept_volume(move(curve, out))) / slope;
  }
  return move(curve, out);
}

/// Moves the largest curve so that the body holds this volume: first the whole curve, then one
/// point for the difference that the coarser grid leaves.
void correct_volume(BrepBody& body, double target_mm3, double grid_mm) {
  BrepWall* largest = nullptr;
  for (BrepShell& shell : body)
    for (BrepWall& wall : shell)
      if (wall.curve && (!largest || std::abs(volume_of(wall)) > std::abs(volume_of(*largest))))
        largest = &wall;
  if (!largest) return;
  const double wanted = target_mm3 - (volume_of(body) - swept_volume(*largest->curve));
  const WallCurve near = enclosing(
      *largest->curve, wanted,
      [&](const WallCurve& curve, double out_mm) { return moved(curve, out_mm, grid_mm); });
  largest->curve = enclosing(near, wanted, middle_moved);
}

/// Upper bound of the distance [mm] between the walls of a shell and its line.
double deviation_of(const BrepShell& shell, Line line, StepWalls walls) {
  constexpr double kRounding = kBrepGridMm;
  if (walls == StepWalls::lines) return kRounding;
  const std::vector<std::size_t> corners = corners_of(line);
  double farthest = 0.0;
  for (std::size_t i = 0; i < shell.size(); ++i)
    if (shell[i].curve)
      farthest = std::max(
          farthest, distance_bound(*shell[i].curve,
                                   {line.points.begin() + std::ptrdiff_t(corners[i]),
                                    line.points.begin() + std::ptrdiff_t(corners[i + 1]) + 1}));
  return farthest + kRounding;
}

Result<void> check_poles(const Polygon& points) {
  for (const std::size_t end : {std::size_t{0}, points.size() - 1}) {
    const ProfilePoint &pole = points[end], &next = points[end == 0 ? 1 : end - 1];
    if (pole.rho == 0.0 && pole.y != next.y)
      return failure(ErrorKind::unsound,
                     "expected a flat surface at the axis, found a cone at "
                     "height " +
                         nine_digit_text(pole.y) + " mm");
  }
  return {};
}

/// The body of a polygon, its outer shell first, and its distance from the polygon.
Result<std::pair<BrepBody, double>> body_of(const Polygon& polygon, StepWalls walls,
                                            double tolerance_mm) {
  std::vector<Line> lines;
  for (const Chain& chain : chains_of(polygon)) {
    lines.push_back(line_of(polygon, chain));
    if (lines.back().round) continue;
    if (auto poles = check_poles(lines.back().points); !poles)
      return tl::make_unexpected(poles.error());
  }
  std::stable_partition(lines.begin(), lines.end(), [](const Line& line) {
    return section::swept_volume(line.points, line.round) > 0.0;
  });
  const double target = volume_of(Profile{{polygon}}), grid_mm = control_grid_mm(tolerance_mm);
  for (const double part : {0.97, 0.9, 0.6, 0.3}) {
    BrepBody body;
    for (const Line& line : lines)
      body.push_back(shell_of(line, walls, part * tolerance_mm, grid_mm));
    correct_volume(body, target, grid_mm);
    double deviation = 0.0;
    for (std::size_t i = 0; i < lines.size(); ++i)
      deviation = std::max(deviation, deviation_of(body[i], lines[i], walls));
    if (deviation <= std::max(tolerance_mm, 2.0 * kBrepGridMm)) return std::pair(body, deviation);
  }
  return failure(ErrorKind::bad_input, "expected a tolerance that curves can keep, found " +
                                           nine_digit_text(tolerance_mm) + " mm; " +
                                           kLinesAreExact);
}

}  // namespace

std::size_t RevolvedBrep::faces() const noexcept {
  std::size_t faces = 0;
  for (const BrepBody& body : bodies)
    for (const BrepShell& shell : body)
      for (const BrepWall& wall : shell) faces += wall.flat() ? 1 : 2;
  return faces;
}

bool RevolvedBrep::curved() const noexcept {
  for (const BrepBody& body : bodies)
    for (const BrepShell& shell : body)
      if (std::ranges::any_of(shell, [](const BrepWall& wall) { return wall.curve.has_value(); }))
        return true;
  return false;
}

Profile RevolvedBrep::flattened(double error_mm) const {
  Profile profile;
  for (const BrepBody& body : bodies) {
    Polygon& polygon = profile.pieces.emplace_back();
    // Cavities lie above each other between the axis segments of the outer shell's polygon: the
    // boundary goes up the outer shell and down the axis past each of them.
    std::vector<const BrepShell*> shells;
    for (const BrepShell& shell : body) shells.push_back(&shell);
    std::sort(shells.begin() + 1, shells.end(), [](const BrepShell* a, const BrepShell* b) {
      return a->front().from.y > b->front().from.y;
    });
    for (const BrepShell* shell : shells) {
      for (const BrepWall& wall : *shell) {
        polygon.push_back(wall.from);
        if (!wall.curve) continue;
        const Polygon points = solid::flattened(*wall.curve, error_mm);
        polygon.insert(polygon.end(), points.begin() + 1, points.end() - 1);
      }
      if (shell->back().to != shell->front().from) polygon.push_back(shell->back().to);
    }
  }
  return profile;
}

Result<RevolvedBrep> revolved_brep(const Profile& profile, StepWalls walls, double tolerance_mm) {
  RevolvedBrep brep;
  for (const Polygon& polygon : profile.pieces) {
    auto body = body_of(polygon, walls, tolerance_mm);
    if (!body) return tl::make_unexpected(body.error());
    brep.volume_mm3 += volume_of(body->first);
    brep.deviation_mm = std::max(brep.deviation_mm, body->second);
    brep.bodies.push_back(std::move(body->first));
  }
  return brep;
}

}  // namespace clay::solid
