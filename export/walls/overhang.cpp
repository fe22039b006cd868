#include "claystack/export/walls.hpp"
#include "export/walls/steepest_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

namespace clay::solid::inline walls {
namespace {

constexpr double kUnheld = std::numeric_limits<double>::infinity();
constexpr double kSpacingMm = 0.004;
constexpr double kMostPlaces = 100'000, kMostBands = 100'000;

struct FaceLine {
  ProfilePoint from, to;
  [[nodiscard]] double length() const { return std::hypot(to.rho - from.rho, to.y - from.y); }
  [[nodiscard]] ProfilePoint at(double part) const {
    return {std::lerp(from.rho, to.rho, part), std::lerp(from.y, to.y, part)};
  }
};

std::vector<FaceLine> edges_of(const Profile& profile) {
  std::vector<FaceLine> edges;
  for (const Polygon& polygon : profile.pieces)
    for (std::size_t i = 0; i < polygon.size(); ++i)
      edges.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
  return edges;
}

/// The clay below a place. In a solid of revolution the nearest clay of each level is in the
/// section of the place.
class ClayBelow {
 public:
  explicit ClayBelow(const std::vector<FaceLine>& lines) {
    bed_ = kUnheld;
    double top = -kUnheld;
    edges_.reserve(lines.size());
    for (const FaceLine& line : lines) {
      const Edge& edge = edges_.emplace_back(line);
      bed_ = std::min(bed_, edge.bottom);
      top = std::max(top, edge.top);
    }
    band_mm_ = std::max(kOverhangDepthMm, (top - bed_) / kMostBands);
    bands_.resize(band(top) + 1);
    for (std::size_t i = 0; i < edges_.size(); ++i)
      for (std::size_t b = band(edges_[i].bottom); b <= band(edges_[i].top); ++b)
        bands_[b].push_back(i);
  }

  /// The least slope of a line from the place down to clay or to the bed, if it is below `most`.
  [[nodiscard]] double slope(const ProfilePoint& place, double most) const {
    const double low = place.y - kOverhangDepthMm;
    if (low <= bed_) return 0.0;
    double least = most;
    // From the top down: the nearest clay comes first, and rules out most of the rest.
    const std::size_t lowest = band(low);
    for (std::size_t b = band(place.y) + 1; b-- > lowest;)
      for (const std::size_t i : bands_[b]) {
        const Edge& edge = edges_[i];
        if (edge.beside(place) <= least * std::min(place.y - edge.bottom, kOverhangDepthMm))
          least = std::min(least, slope(place, edge, low));
      }
    return least;
  }

 private:
  /// Its bounds are computed once, as each place compares them.
  struct Edge {
    explicit Edge(const FaceLine& of) : line(of) {
      std::tie(inner, outer) = std::minmax(of.from.rho, of.to.rho);
      std::tie(bottom, top) = std::minmax(of.from.y, of.to.y);
    }

    /// Distance of the edge from the vertical line through the place [mm].
    [[nodiscard]] double beside(const ProfilePoint& place) const {
      return std::max({inner - place.rho, place.rho - outer, 0.0});
    }

    FaceLine line;
    double inner = 0.0, outer = 0.0, bottom = 0.0, top = 0.0;
  };

  [[nodiscard]] std::size_t band(double y) const {
    return static_cast<std::size_t>((y - bed_) / band_mm_);
  }

  /// Along a straight edge the slope is least at an end, or 0 where it passes below the place.
  static double slope(const ProfilePoint& place, const Edge& edge, double low) {
    constexpr double kRoundingMm = 1e-6;  // of the place's own level
    const double high = place.y - kRoundingMm;
    if (edge.bottom > high || edge.top < low) return kUnheld;
    const FaceLine& line = edge.line;
    const double rise = line.to.y - line.from.y;
    const auto part = [&](double y) { return std::clamp((y - line.from.y) / rise, 0.0, 1.0); };
    const ProfilePoint a = rise == 0.0 ? line.from : line.at(part(low));
    const ProfilePoint b = rise == 0.0 ? line.to : line.at(part(high));
    const double aside_a = a.rho - place.rho, aside_b = b.rho - place.rho;
    if (aside_a * aside_b <= 0.0) return 0.0;
    return std::min(std::abs(aside_a) / (place.y - a.y), std::abs(aside_b) / (place.y - b.y));
  }

  std::vector<Edge> edges_;
  double bed_ = 0.0, band_mm_ = 0.0;
  std::vector<std::vector<std::size_t>> bands_;
};

using Underside = UndersidePart<FaceLine>;

/// Of a polygon that runs counterclockwise, the edges that run away from the axis.
std::vector<Underside> undersides(const std::vector<FaceLine>& edges) {
  std::vector<Underside> faces;
  for (const FaceLine& edge : edges) {
    if (!(edge.to.rho > edge.from.rho)) continue;
    const double rise = std::abs(edge.to.y - edge.from.y);
    const double slope = rise > 0.0 ? (edge.to.rho - edge.from.rho) / rise : kUnheld;
    const double area = std::numbers::pi * (edge.from.rho + edge.to.rho) * edge.length();
    faces.push_back({slope, area, edge});
  }
  return faces;
}

/// Pieces of a face, each with the slope of the end that is farther from clay: outside the outer
/// one, in a bore the inner one.
template <class Found>
void examine(const Underside& face, double spacing_mm, const ClayBelow& clay, const Found& found) {
  const double count = std::ceil(face.place.length() / spacing_mm);
  const double most = std::min(face.slope, kSteepestHeld);
  double from_slope = clay.slope(face.place.from, most);
  for (double i = 0.0; i < count; ++i) {
    const FaceLine piece{face.place.at(i / count), face.place.at((i + 1.0) / count)};
    const double to_slope = clay.slope(piece.to, most), held = std::max(from_slope, to_slope);
    found({held < most ? held : face.slope,
           std::numbers::pi * (piece.from.rho + piece.to.rho) * piece.length(), piece});
    from_slope = to_slope;
  }
}

}  // namespace

Overhang steepest_overhang(const Profile& profile) {
  const std::vector<FaceLine> edges = edges_of(profile);
  if (edges.empty()) return {};
  const ClayBelow clay(edges);
  std::vector<Underside> faces = undersides(edges);
  double length_mm = 0.0;
  for (const Underside& face : faces) length_mm += face.place.length();
  const double spacing_mm = std::max(kSpacingMm, length_mm / kMostPlaces);
  const auto steepest = steepest_part(
      std::move(faces),
      [&](const Underside& face, const auto& found) { examine(face, spacing_mm, clay, found); });
  if (!steepest) return {};
  return {std::atan(steepest->slope) * 180.0 / std::numbers::pi, steepest->place.at(0.5)};
}

std::string overhang_text(double angle_deg, double height_mm, const ProcessLimits& process) {
  return fmt::format(
      "overhang of {:.1f} degrees at a height of {:.1f} mm; {}: at most {:g} without support ({})",
      angle_deg, height_mm, process_title(process.name), process.overhang->max_deg,
      process.overhang->source);
}

}  // namespace clay::solid::inline walls
