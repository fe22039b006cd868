// Walls in words: the table of a section, and its faults.

#include "claystack/export/walls.hpp"
#include "core/size_text.hpp"
#include "export/walls/part_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace clay::solid::inline walls {
namespace {

constexpr std::size_t kMostStretches = 4;  // people read only the first few of a long list

struct Stretch {
  std::size_t piece = 0;
  std::string_view name;
  double low_mm = 0.0, high_mm = 0.0;
};

/// The face, or the part if that is clearer: the face of a sharp lip may face up like a floor.
std::string_view name_of(const WallSample& sample) {
  return sample.part == WallPart::wall ? name_of(sample.face) : name_of(sample.part);
}

std::vector<Stretch> thin_stretches(const Profile& profile, const WallLimit& limit) {
  std::vector<Stretch> stretches;
  bool open = false;
  for (const WallSample& s : wall_field(profile, kWallTableSpacingMm)) {
    const bool thin = !limit.met_by(s.thickness_mm);
    if (open && (stretches.back().name != name_of(s) || stretches.back().piece != s.piece))
      open = false;
    if (thin && !open) stretches.push_back({s.piece, name_of(s), s.at.y, s.at.y});
    if (thin) {
      stretches.back().low_mm = std::min(stretches.back().low_mm, s.at.y);
      stretches.back().high_mm = std::max(stretches.back().high_mm, s.at.y);
    }
    open = thin;
  }
  return stretches;
}

/// "rim at a height of 12.0 mm", "outer from 3.1 to 9.8 mm of height".
std::string text_of(const Stretch& stretch) {
  const std::string low = size_text(stretch.low_mm, 1), high = size_text(stretch.high_mm, 1);
  return low == high ? fmt::format("{} at a height of {} mm", stretch.name, low)
                     : fmt::format("{} from {} to {} mm of height", stretch.name, low, high);
}

}  // namespace

std::string wall_text(double thinnest_mm, const WallLimit& limit) {
  const bool below = thinnest_mm < limit.min_wall_mm;
  const int decimals = below ? decimals_apart(thinnest_mm, limit.min_wall_mm, 3) : 3;
  return fmt::format("{} mm, expected at least {} mm ({}){}", bound_text(thinnest_mm, decimals),
                     size_text(limit.min_wall_mm, decimals), limit.asked_by(),
                     below && limit.met_by(thinnest_mm) ? "; within the allowance" : "");
}

std::string thin_wall_text(const Profile& profile, double thinnest_mm, const WallLimit& limit) {
  std::string text = wall_text(thinnest_mm, limit);
  const std::vector<Stretch> stretches = thin_stretches(profile, limit);
  for (std::size_t i = 0; i < std::min(stretches.size(), kMostStretches); ++i)
    text += (i == 0 ? "; thinner: " : ", ") + text_of(stretches[i]);
  if (stretches.size() > kMostStretches)
    text += fmt::format(", and {} more", stretches.size() - kMostStretches);
  if (!stretches.empty()) return text;
  // Between two samples.
  const Wall thinnest = min_wall(profile);
  return text + fmt::format("; thinnest: {} at a height of {} mm",
                            name_of(part_of(profile, thinnest)), size_text(thinnest.from.y, 1));
}

std::string_view name_of(WallFace face) {
  constexpr std::array<std::string_view, 6> kNames{"foot", "outer", "rim", "bore", "floor", "lid"};
  return kNames.at(static_cast<std::size_t>(face));
}

std::string wall_table(const std::vector<WallSample>& field) {
  std::string text = "piece,face,arc_mm,rho_mm,y_mm,thickness_mm,opposite_rho_mm,opposite_y_mm\n";
  for (const WallSample& s : field) {
    fmt::format_to(std::back_inserter(text), "{},{},{:.6f},{:.6f},{:.6f},", s.piece,
                   name_of(s.face), s.arc_mm, s.at.rho, s.at.y);
    if (std::isfinite(s.thickness_mm))
      fmt::format_to(std::back_inserter(text), "{:.6f},{:.6f},{:.6f}\n", s.thickness_mm,
                     s.opposite.rho, s.opposite.y);
    else
      text += ",,\n";
  }
  return text;
}

}  // namespace clay::solid::inline walls
