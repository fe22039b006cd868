#include "export/job/section_measures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace clay::solid::inline job {
namespace {

/// Distances from the axis at which the boundary crosses a height, farthest first.
std::vector<double> crossings(const Profile& profile, double height) {
  std::vector<double> found;
  for (const Polygon& piece : profile.pieces)
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const ProfilePoint &a = piece[i], &b = piece[i + 1 == piece.size() ? 0 : i + 1];
      if ((a.y <= height) != (b.y <= height))
        found.push_back(a.rho + (height - a.y) / (b.y - a.y) * (b.rho - a.rho));
    }
  std::ranges::sort(found, std::greater<>());
  return found;
}

}  // namespace

SectionMeasures::SectionMeasures(const Profile& profile) : profile_(profile) {
  for (const Polygon& piece : profile.pieces)
    for (const ProfilePoint& p : piece) {
      radius_mm_ = std::max(radius_mm_, p.rho);
      top_mm_ = std::max(top_mm_, p.y);
    }
}

double SectionMeasures::widest_at_mm() const {
  double height = 0.0;
  for (const Polygon& piece : profile_.pieces)
    for (const ProfilePoint& p : piece)
      if (p.rho == radius_mm_) height = p.y;
  return height;
}

double SectionMeasures::mouth_mm() const {
  double mouth = radius_mm_;
  for (const Polygon& piece : profile_.pieces)
    for (const ProfilePoint& p : piece)
      if (p.y == top_mm_) mouth = std::min(mouth, p.rho);
  return mouth;
}

double SectionMeasures::bore_between_mm(double low, double high) const {
  double bore = radius_mm_;
  for (const ProfilePoint& p : profile_.pieces.back())
    if (p.y > low && p.y < high && p.rho > 0.0) bore = std::min(bore, p.rho);
  for (const double height : {low + 1e-6, high})
    if (const auto at = crossings(profile_, height); !at.empty()) bore = std::min(bore, at.back());
  return bore;
}

double SectionMeasures::floor_mm() const {
  double floor = 0.0;
  for (const ProfilePoint& p : profile_.pieces.back())
    if (p.rho == 0.0) floor = std::max(floor, p.y);
  return floor;
}

double SectionMeasures::below_floor_mm() const {
  const double floor = floor_mm();
  double below = 0.0;
  for (const ProfilePoint& p : profile_.pieces.back())
    if (p.rho == 0.0 && p.y < floor) below = std::max(below, p.y);
  return below;
}

double SectionMeasures::bore_at_mm(double height) const {
  double bore = 0.0;
  for (const ProfilePoint& p : profile_.pieces.back())
    if (p.y == height) bore = std::max(bore, p.rho);
  return bore;
}

std::array<CaliperRow, 5> caliper_rows(const Profile& profile) {
  const double top = SectionMeasures(profile).top_mm();
  std::array<CaliperRow, 5> rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double height = top * static_cast<double>(i + 1) / 6.0;
    rows[i].height = top > 12.0 ? std::round(height) : height;
    const std::vector<double> at = crossings(profile, rows[i].height);
    if (!at.empty()) rows[i].outer = 2.0 * at[0];
    if (at.size() > 1) rows[i].bore = 2.0 * at[1];
  }
  return rows;
}

}  // namespace clay::solid::inline job
