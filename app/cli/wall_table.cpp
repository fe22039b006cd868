#include "app/cli/wall_table.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>

namespace clay::cli {

std::string_view name_of(solid::WallFace face) {
  constexpr std::array<std::string_view, 6> kNames{"foot", "outer", "rim", "bore", "floor", "lid"};
  return kNames.at(static_cast<std::size_t>(face));
}

std::string wall_table(const std::vector<solid::WallSample>& field) {
  std::string text = "piece,face,arc_mm,rho_mm,y_mm,thickness_mm,opposite_rho_mm,opposite_y_mm\n";
  for (const solid::WallSample& s : field) {
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

}  // namespace clay::cli
