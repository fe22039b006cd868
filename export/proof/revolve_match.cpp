#include "export/proof/revolve_match.hpp"

#include "core/cancel.hpp"
#include "core/text.hpp"
#include "export/formats/glb.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace clay::solid::inline proof {
namespace {

/// A vertex of the layout; sector 0 for poles.
struct VertexName {
  std::uint32_t shell = 0, point = 0, sector = 0;
};

std::string place(const glm::dvec3& p) {
  return std::string("(") + nine_digit_text(p.x) + ", " + nine_digit_text(p.y) + ", " +
         nine_digit_text(p.z) + ") mm";
}

/// A circle or a pole of a revolve: its point in the half-plane of a sector.
struct Parallel {
  std::array<double, 2> at{};  ///< distance from the axis, height [mm]
  std::uint32_t shell = 0, point = 0;
  std::size_t split = 0;  ///< the coordinate that divides the part of which this is the median
};

/// Finds vertices of a revolve in logarithmic time: a k-d tree of the parallels, with the median of
/// every part in its middle. Distances are to the vertices as the format rounds them, so that files
/// that hold exactly these are matched for any vertex spacing.
class VertexFinder {
 public:
  VertexFinder(const RevolveLayout& rule, double reach_mm, MeshFormat format)
      : rule_(rule),
        reach_(reach_mm),
        format_(format),
        rounding_(2.0 * roundings_of(format) * float_rounding_mm(rule)) {
    const double factor = equal_area_factor(rule.segments());
    for (std::uint32_t shell = 0; shell < rule.shells().size(); ++shell) {
      const auto& points = rule.shells()[shell].points;
      for (std::uint32_t i = 0; i < points.size(); ++i)
        parallels_.push_back({{factor * points[i].rho, points[i].y}, shell, i, 0});
    }
    sort(parallels_);
  }

  /// The nearest vertex within reach; keeps the largest distance in `farthest`.
  std::optional<VertexName> find(const glm::dvec3& p) {
    const double steps =
        std::atan2(p.y, p.x) * static_cast<double>(rule_.segments()) / (2.0 * std::numbers::pi);
    const auto n = static_cast<long>(rule_.segments());
    const auto sector = static_cast<std::uint32_t>((std::lround(steps) + n) % n);
    const glm::dvec2 radial = glm::normalize(rule_.circle()[sector]);
    Search search{p, {p.x * radial.x + p.y * radial.y, p.z}, sector};
    seek(search, parallels_);
    if (!search.nearest) return std::nullopt;
    const double away = glm::distance(p, vertex(*search.nearest, sector));
    if (away > reach_) return std::nullopt;
    farthest_ = std::max(farthest_, away);
    const bool pole = search.nearest->at[0] == 0.0;
    return VertexName{search.nearest->shell, search.nearest->point, pole ? 0 : sector};
  }

  [[nodiscard]] double farthest() const noexcept { return farthest_; }

 private:
  struct Search {
    glm::dvec3 p;
    std::array<double, 2> at{};  ///< of p, like Parallel::at
    std::size_t sector = 0;
    const Parallel* nearest = nullptr;
    double away = std::numeric_limits<double>::infinity();
  };

  [[nodiscard]] glm::dvec3 vertex(const Parallel& parallel, std::size_t sector) const {
    return rule_.vertex(rule_.shells()[parallel.shell].points[parallel.point], sector);
  }

  /// Splits along the longer side.
  static void sort(std::span<Parallel> stretch) {
    if (stretch.size() < 2) return;
    step_of_loop();
    const auto length = [&](std::size_t axis) {
      const auto [low, high] = std::minmax_element(
          stretch.begin(), stretch.end(),
          [axis](const Parallel& a, const Parallel& b) { return a.at[axis] < b.at[axis]; });
      return high->at[axis] - low->at[axis];
    };
    const std::size_t axis = length(0) > length(1) ? 0 : 1, middle = stretch.size() / 2;
    std::nth_element(
        stretch.begin(), stretch.begin() + static_cast<std::ptrdiff_t>(middle), stretch.end(),
        [axis](const Parallel& a, const Parallel& b) { return a.at[axis] < b.at[axis]; });
    stretch[middle].split = axis;
    sort(stretch.first(middle));
    sort(stretch.subspan(middle + 1));
  }

  /// The nearer side first, so that most other vertices are too far away to be placed.
  void seek(Search& search, std::span<const Parallel> stretch) const {
    if (stretch.empty()) return;
    const std::size_t middle = stretch.size() / 2;
    const Parallel& parallel = stretch[middle];
    const double beyond = search.at[parallel.split] - parallel.at[parallel.split];
    const auto below = stretch.first(middle), above = stretch.subspan(middle + 1);
    seek(search, beyond < 0.0 ? below : above);
    if (std::abs(beyond) - rounding_ >= search.away) return;
    const double away =
        glm::distance(search.p, held_point(vertex(parallel, search.sector), format_));
    if (away < search.away) search.nearest = &parallel, search.away = away;
    seek(search, beyond < 0.0 ? above : below);
  }

  const RevolveLayout& rule_;
  double reach_;
  MeshFormat format_;
  double rounding_;  ///< upper bound of a vertex's displacement by float32
  std::vector<Parallel> parallels_;
  double farthest_ = 0.0;
};

/// Marks the triangles of the layout that were found.
class Roll {
 public:
  explicit Roll(const RevolveLayout& rule) : rule_(rule) {
    std::size_t next = 0;
    for (const Shell& shell : rule.shells()) {
      std::vector<std::size_t>& band_of = band_from_.emplace_back(shell.points.size(), kNone);
      for (std::size_t b = 0; b < shell.bands.size(); ++b) band_of[shell.bands[b].from] = b;
      first_.push_back(next);
      next += 2 * shell.bands.size() * rule.segments();
    }
    present_.resize(next, false);
  }

  /// Whether these corners, in this orientation, are a triangle of the layout not found before.
  bool tick(std::array<VertexName, 3> corners) {
    for (int turn = 0; turn < 3; ++turn) {
      if (const auto place = place_of(corners); place && !present_[*place]) {
        present_[*place] = true;
        return true;
      }
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    }
    return false;
  }

 private:
  static constexpr std::size_t kNone = SIZE_MAX;

  /// For corners in the order of the layout, starting at `from`.
  std::optional<std::size_t> place_of(const std::array<VertexName, 3>& c) const {
    if (c[1].shell != c[0].shell || c[2].shell != c[0].shell) return std::nullopt;
    const Shell& shell = rule_.shells()[c[0].shell];
    const std::size_t b = band_from_[c[0].shell][c[0].point];
    if (b == kNone) return std::nullopt;
    const auto [from, to] = shell.bands[b];
    const bool lower = c[1].point == from && c[2].point == to && !shell.pole(from);
    const bool upper = c[1].point == to && c[2].point == to && !shell.pole(to);
    if (!lower && !upper) return std::nullopt;
    // A pole has no sector; in both kinds of triangle another corner gives it.
    const std::size_t s = upper ? c[2].sector : c[0].sector;
    const std::size_t next = s + 1 < rule_.segments() ? s + 1 : 0;
    const auto in = [&](const VertexName& v, std::size_t sector) {
      return shell.pole(v.point) || v.sector == sector;
    };
    if (!in(c[0], lower ? s : next) || !in(c[1], next) || !in(c[2], s)) return std::nullopt;
    return first_[c[0].shell] + 2 * (b * rule_.segments() + s) + (upper ? 1 : 0);
  }

  const RevolveLayout& rule_;
  std::vector<std::vector<std::size_t>> band_from_;  ///< by shell and point
  std::vector<std::size_t> first_;                   ///< place of a shell's first triangle
  std::vector<bool> present_;
};

}  // namespace

Result<double> match_revolve(const TriangleMesh& decoded, const RevolveLayout& rule,
                             double reach_mm, MeshFormat format, std::string_view name) {
  const auto wrong = [&](const std::string& what) {
    return failure(ErrorKind::unsound, std::string(name).append(": ").append(what));
  };
  if (decoded.triangles.size() != rule.triangles())
    return wrong("expected " + std::to_string(rule.triangles()) + " triangles, found " +
                 std::to_string(decoded.triangles.size()));
  // The counts agree: so no vertex occurs twice, because every vertex has triangles.
  if (decoded.points.size() != rule.vertices())
    return wrong("expected " + std::to_string(rule.vertices()) + " points, found " +
                 std::to_string(decoded.points.size()));
  VertexFinder finder(rule, reach_mm, format);
  std::vector<VertexName> names;
  names.reserve(decoded.points.size());
  for (std::size_t i = 0; i < decoded.points.size(); ++i) {
    step_of_loop();
    const auto found = finder.find(decoded.points[i]);
    if (!found)
      return wrong("point " + std::to_string(i + 1) + ": expected a vertex of the solid within " +
                   nine_digit_text(reach_mm) + " mm, found none of " + place(decoded.points[i]));
    names.push_back(*found);
  }
  Roll roll(rule);
  for (std::size_t t = 0; t < decoded.triangles.size(); ++t) {
    step_of_loop();
    const auto& [a, b, c] = decoded.triangles[t];
    if (!roll.tick({names[a], names[b], names[c]}))
      return wrong("triangle " + std::to_string(t + 1) + " at " + place(decoded.points[a]) +
                   ": expected one of the solid, once, found one that is not, or is there twice");
  }
  return finder.farthest();
}

}  // namespace clay::solid::inline proof
