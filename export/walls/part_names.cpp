#include "export/walls/part_names.hpp"

#include "core/size_text.hpp"
#include "export/walls/tangent_ball.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

namespace clay::solid::inline walls {
namespace {

/// A lip ends where the boundary over the rim is this many diameters long: some four thicknesses
/// below the rim.
constexpr double kLipSpan = 3.0 * kSpan;

double distance_between(const Edge& edge, const Vec2& point, double& along) {
  const Vec2 way = edge.to - edge.from;
  const double length = glm::length(way);
  along = length > 0.0 ? std::clamp(glm::dot(point - edge.from, way) / length, 0.0, length) : 0.0;
  return glm::length(point - edge.from - (length > 0.0 ? along / length : 0.0) * way);
}

}  // namespace

PartNames::PartNames(const EdgeTree& tree, std::uint32_t piece) : tree_(tree), piece_(piece) {
  Vec2 foot{0.0}, rim{0.0};
  double arc = 0.0;
  const std::uint32_t begin = tree.first_edge(piece);
  std::uint32_t i = begin;
  do {
    const Vec2& p = tree.point(i);
    if (i == begin || p.y < foot.y || (p.y == foot.y && p.x > foot.x)) foot = p, foot_arc_ = arc;
    if (i == begin || p.y > rim.y || (p.y == rim.y && p.x > rim.x)) rim = p, rim_arc_ = arc;
    arc += tree.arc_length(tree.edge(i, piece));
    i = tree.after(i, piece);
  } while (i != begin);
}

WallPart PartNames::of(double from_arc, double to_arc, double diameter_mm) const {
  const double low = std::min(from_arc, to_arc), high = std::max(from_arc, to_arc);
  // The axis counts as longer than all else, so the shorter way does not contain it.
  const double perimeter = tree_.perimeter(piece_);
  const bool direct = 2.0 * (high - low) <= perimeter;
  const double cut_off = direct ? high - low : perimeter - (high - low);
  const auto contains = [&](double arc) { return (arc >= low && arc <= high) == direct; };
  if (contains(foot_arc_)) return WallPart::wall;
  if (!contains(rim_arc_)) return WallPart::flange;
  return cut_off <= kLipSpan * diameter_mm ? WallPart::lip : WallPart::wall;
}

WallPart PartNames::of(const Vec2& from, const Vec2& to) const {
  if (to.x < 0.0) return WallPart::wall;
  return of(nearest(from).arc, nearest(to).arc, glm::length(to - from));
}

PartNames::Place PartNames::nearest(const Vec2& point) const {
  Place best{std::numeric_limits<double>::infinity(), 0.0};
  double arc = 0.0;
  const std::uint32_t begin = tree_.first_edge(piece_);
  std::uint32_t i = begin;
  do {
    const Edge edge = tree_.edge(i, piece_);
    double along = 0.0;
    const double distance = distance_between(edge, point, along);
    if (!edge.on_axis() && distance < best.distance) best = {distance, arc + along};
    arc += tree_.arc_length(edge);
    i = tree_.after(i, piece_);
  } while (i != begin);
  return best;
}

std::string_view name_of(WallPart part) {
  constexpr std::array<std::string_view, 3> kNames{"wall", "lip", "flange"};
  return kNames.at(static_cast<std::size_t>(part));
}

WallPart part_of(const Profile& profile, const Wall& wall) {
  if (wall.compact) return WallPart::wall;
  const EdgeTree tree(profile, 1.0);
  const Vec2 from{wall.from.rho, wall.from.y}, to{wall.to.rho, wall.to.y};
  double least = std::numeric_limits<double>::infinity();
  WallPart part = WallPart::wall;
  for (std::uint32_t piece = 0; piece < tree.piece_count(); ++piece) {
    const PartNames names(tree, piece);
    const double distance = names.distance_to(from);
    if (distance < least) least = distance, part = names.of(from, to);
  }
  return part;
}

std::vector<PartWall> walls_by_part(const Profile& profile, const std::vector<WallSample>& field,
                                    const Wall& thinnest, double least_mm) {
  std::vector<PartWall> parts{{part_of(profile, thinnest), least_mm, thinnest.from}};
  for (const WallSample& sample : field) {
    const auto part = std::ranges::find(parts, sample.part, &PartWall::part);
    // No sample is thinner than the thinnest place, apart from facets and rounding.
    if (part == parts.end())
      parts.push_back({sample.part, std::max(sample.thickness_mm, least_mm), sample.at});
    else if (sample.thickness_mm < part->thickness_mm)
      *part = {sample.part, std::max(sample.thickness_mm, least_mm), sample.at};
  }
  std::ranges::sort(parts, {}, &PartWall::part);
  return parts;
}

std::string text_of(const std::vector<PartWall>& parts) {
  std::string text;
  for (const auto& [part, thickness_mm, at] : parts)
    text += fmt::format("{}{} {} mm at a height of {} mm", text.empty() ? "" : ", ", name_of(part),
                        bound_text(thickness_mm, 3), size_text(at.y, 1));
  return text;
}

}  // namespace clay::solid::inline walls
