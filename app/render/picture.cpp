#include "app/render/picture.hpp"

#include "app/render/circle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace clay::render {
namespace {

constexpr double kDefaultAzimuth = 0.6, kDefaultElevation = 0.42, kDefaultFov = 0.42;
constexpr double kFilled = 0.80;  // fraction of the picture's width or height that the pot fills
constexpr double kWheelBeyond = 1.45;  // radii of the clay
constexpr std::size_t kCircles = 64, kCirclePoints = 24;
constexpr double kFlange = 1.01;  // times as wide as the circles beside it

/// Points on circles of the outside, in the wheel's coordinates: their hull is that of the pot.
std::vector<glm::dvec3> outline_points(const PotView& pot) {
  std::vector<glm::dvec3> points;
  const std::size_t count = pot.rows.size();
  const std::size_t stride = std::max<std::size_t>(1, count / kCircles);
  const double height = count > 0 ? pot.height_mm / static_cast<double>(count) : 0.0;
  const std::vector<glm::dvec2> directions = directions_around(kCirclePoints);
  const auto add = [&](std::size_t row, double y) {
    for (const glm::dvec2& direction : directions) {
      const double radius = static_cast<double>(pot.rows[row].outer_mm);
      const glm::dvec3 point{radius * direction.y, y, radius * direction.x};
      const bool fell = pot.fallen && row >= pot.fallen->first_row;
      points.push_back(fell ? glm::dvec3(pot.fallen->place * glm::dvec4(point, 1.0)) : point);
    }
  };
  for (std::size_t row = 0; row < count; row += stride) {
    add(row, height * static_cast<double>(row));
    // A flange may be narrower than a stride.
    const std::size_t next = std::min(row + stride, count - 1);
    const auto widest = static_cast<std::size_t>(
        std::max_element(pot.rows.begin() + static_cast<std::ptrdiff_t>(row),
                         pot.rows.begin() + static_cast<std::ptrdiff_t>(next) + 1,
                         [](const Row& a, const Row& b) { return a.outer_mm < b.outer_mm; }) -
        pot.rows.begin());
    const auto radius = [&](std::size_t at) { return static_cast<double>(pot.rows[at].outer_mm); };
    if (radius(widest) < kFlange * std::max(radius(row), radius(next))) continue;
    add(widest, height * static_cast<double>(widest));
    add(widest, height * static_cast<double>(widest + 1));
  }
  if (count > 0) add(count - 1, pot.height_mm);
  return points;
}

}  // namespace

const Row* row_at(const PotView& pot, double y_mm) {
  if (pot.rows.empty() || !(y_mm >= 0.0 && y_mm < pot.height_mm)) return nullptr;
  const double rows = static_cast<double>(pot.rows.size());
  return &pot.rows[static_cast<std::size_t>(std::min(y_mm / pot.height_mm * rows, rows - 1.0))];
}

std::optional<Floor> floor_of(const PotView& pot) {
  const auto is_open = [](const Row& row) { return static_cast<double>(row.inner_mm) > kBoreMm; };
  const auto end = pot.rows.end();
  auto bottom = std::find_if_not(pot.rows.begin(), end, is_open);
  if (bottom == end) bottom = pot.rows.begin();  // a tube
  const auto top = std::find_if(bottom, end, is_open);
  if (top == end) return std::nullopt;
  const auto height_mm = [&](auto row) {
    return pot.height_mm * static_cast<double>(row - pot.rows.begin()) /
           static_cast<double>(pot.rows.size());
  };
  return Floor{height_mm(bottom), height_mm(top)};
}

double wheel_radius_mm(const PotView& pot) noexcept {
  double reach = 0.0;
  for (const glm::dvec3& p : outline_points(pot)) reach = std::max(reach, std::hypot(p.x, p.z));
  if (!(reach > 0.0)) return 150.0;
  constexpr std::array<double, 10> kPreferred{1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0};
  const double wanted = kWheelBeyond * reach;
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double step : kPreferred)
    if (step * decade >= wanted) return step * decade;
  return 10.0 * decade;
}

Extent extent_of(const PotView& pot) noexcept {
  float radius = 0.0f;
  for (const Row& row : pot.rows) radius = std::max(radius, row.outer_mm);
  const float foot = pot.rows.empty() ? 0.0f : pot.rows.front().outer_mm;
  return {static_cast<double>(radius), pot.height_mm, static_cast<double>(foot)};
}

Camera framed(const PotView& pot, double aspect, Camera camera) noexcept {
  const std::vector<glm::dvec3> points = outline_points(pot);
  if (points.empty()) return camera;
  glm::dvec3 low = points.front(), high = low;
  for (const glm::dvec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  camera.target_mm = 0.5 * (low + high);
  camera.distance_mm = 1.0;
  const glm::dmat4 view = view_matrix(camera);
  const double across = kFilled * std::tan(0.5 * camera.fov_rad);
  const double free_aspect = aspect / (1.0 - camera.covered);
  double distance = 0.0;
  for (const glm::dvec3& p : points) {
    const glm::dvec4 seen = view * glm::dvec4(p, 1.0);
    const double nearer = seen.z + 1.0;  // than the target
    distance = std::max({distance, nearer + std::abs(seen.y) / across,
                         nearer + std::abs(seen.x) / (across * free_aspect)});
  }
  camera.distance_mm = distance;
  return camera;
}

Camera framed(const PotView& pot, double aspect, double covered) noexcept {
  Camera camera;
  camera.covered = covered;
  camera.azimuth_rad = kDefaultAzimuth;
  camera.elevation_rad = kDefaultElevation;
  camera.fov_rad = kDefaultFov;
  return framed(pot, aspect, camera);
}

}  // namespace clay::render
