#pragma once
// What the export says of a pot: proved or not, where and why, how thick its walls are. A value
// that any thread can make; all figures are those of solid::run_export.

#include "app/studio/readings/subject.hpp"
#include "app/studio/settings.hpp"
#include "claystack/export/walls.hpp"

#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace clay::studio {

struct PotQuestion {
  Subject subject;
  std::string process;  ///< as solid::read_process has it; empty: none
  double tolerance_mm = 0.02;
};

struct Stretch {
  double from_mm = 0.0, to_mm = 0.0;
  friend bool operator==(const Stretch&, const Stretch&) = default;
};

/// A place that is worth a look, from a height to another [mm].
struct PotRemark {
  double from_mm = 0.0, to_mm = 0.0;
  std::string text;
};

struct PotCheck {
  bool live = false;  ///< of the outline in mid-stroke
  bool proved = false;
  std::string why_not;
  std::optional<double> fault_mm;  ///< the height that is at fault, where it is one
  std::vector<PotRemark> remarks;  ///< steps that were kept, closed cavities
  bool fallen = false;             ///< proved by the exact test of its triangles; no walls
  std::size_t triangles = 0;
  double tolerance_mm = 0.0;
  double counted_mm3 = 0.0, proved_mm3 = 0.0, volume_error_relative = 0.0;
  double least_wall_mm = 0.0;  ///< the solid is nowhere thinner
  double thinnest_mm = 0.0;    ///< of the section: the clay between two places (rho, y) [mm];
  glm::dvec2 thinnest_from{0.0}, thinnest_to{0.0};  ///< rho below 0 beyond the axis
  std::optional<solid::WallLimit> limit;
  std::vector<render::RowWall> walls;  ///< of equal parts of `height_mm`; empty: not known
  double height_mm = 0.0;
  double seconds = 0.0;  ///< it took

  [[nodiscard]] bool thin() const { return limit && !fallen && thinnest_mm < limit->min_wall_mm; }
};

[[nodiscard]] std::vector<std::string> process_names();

/// `given_up` as ExportOptions::cancelled: what then comes of it says nothing.
[[nodiscard]] PotCheck check_pot(const PotQuestion& question,
                                 const std::function<bool()>& given_up = {});

/// The walls for an outline of `rows` rows that is `height_mm` high now: each from the same height.
[[nodiscard]] std::vector<render::RowWall> walls_for(const PotCheck& check, std::size_t rows,
                                                     double height_mm);

/// Colours from 0 to 10 mm, whatever the pot; what the process does not bear is hatched.
[[nodiscard]] render::WallMap wall_map_of(const PotCheck& check);

/// Where walls are thinner than the process asks [mm of height], bottom to top.
[[nodiscard]] std::vector<Stretch> thin_stretches(const PotCheck& check);

/// "Thinnest 2.1 mm, 34.0 mm up; porcelain asks 3.0 mm: too thin".
[[nodiscard]] std::string wall_words(const PotCheck& check, LengthUnit unit);

}  // namespace clay::studio
