#include "app/cli/thin_walls.hpp"

#include "app/cli/wall_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace clay::cli {
namespace {

constexpr std::size_t kMostStretches = 4;  // of a long list, people read the first few

struct Stretch {
  std::size_t piece = 0;
  solid::WallFace face = solid::WallFace::outer;
  double low_mm = 0.0, high_mm = 0.0;
};

std::vector<Stretch> thin_stretches(const solid::Profile& profile, double min_wall_mm) {
  std::vector<Stretch> stretches;
  bool open = false;
  for (const solid::WallSample& s : solid::wall_field(profile, kWallSpacingMm)) {
    const bool thin = s.thickness_mm < min_wall_mm;
    if (open && (stretches.back().face != s.face || stretches.back().piece != s.piece))
      open = false;
    if (thin && !open) stretches.push_back({s.piece, s.face, s.at.y, s.at.y});
    if (thin) {
      stretches.back().low_mm = std::min(stretches.back().low_mm, s.at.y);
      stretches.back().high_mm = std::max(stretches.back().high_mm, s.at.y);
    }
    open = thin;
  }
  return stretches;
}

}  // namespace

std::string wall_text(double thinnest_mm, const WallDemand& demand) {
  return fmt::format("{:.3f} mm, expected {:.3f} mm at least ({})", thinnest_mm, demand.min_wall_mm,
                     demand.source);
}

std::string thin_wall_text(const solid::Profile& profile, double thinnest_mm,
                           const WallDemand& demand) {
  std::string text = wall_text(thinnest_mm, demand);
  const std::vector<Stretch> stretches = thin_stretches(profile, demand.min_wall_mm);
  for (std::size_t i = 0; i < std::min(stretches.size(), kMostStretches); ++i)
    text += fmt::format("{} {} from {:.1f} to {:.1f} mm of height", i == 0 ? "; thinner:" : ",",
                        name_of(stretches[i].face), stretches[i].low_mm, stretches[i].high_mm);
  if (stretches.size() > kMostStretches)
    text += fmt::format(", and {} more", stretches.size() - kMostStretches);
  return text;
}

}  // namespace clay::cli
