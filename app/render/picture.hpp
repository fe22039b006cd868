#pragma once
// Everything that a frame shows, as a plain value. No OpenGL here: a picture can be made, kept and
// compared by any thread. Lengths in mm, y up, the wheel head at y = 0.

#include "app/render/camera.hpp"

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace clay::render {

/// A ring or some of them: the same as servo::LiveProfile::Row.
struct Row {
  float outer_mm = 0.0f, inner_mm = 0.0f;  ///< 0 <= inner < outer; inner 0: no bore
  friend bool operator==(const Row&, const Row&) = default;
};

/// How thick the clay is below either face of a row. Infinite where nothing is opposite.
struct RowWall {
  float outer_mm = 0.0f;
  float inner_mm = 0.0f;  ///< of a row without a bore: of the floor on top of it
  friend bool operator==(const RowWall&, const RowWall&) = default;
};

/// The rows from one on, moved as a rigid body: turned, then shifted.
struct FallenView {
  std::size_t first_row = 0;
  glm::dmat4 place{1.0};  ///< from where it stood to where it lies
  friend bool operator==(const FallenView&, const FallenView&) = default;
};

/// The clay, bottom to top in rows of equal height. Walls are drawn from the middle of a row to the
/// middle of the next; floors and lids lie between two rows.
struct PotView {
  std::vector<Row> rows;
  double height_mm = 0.0;        ///< of all rows together
  std::vector<RowWall> wall_mm;  ///< one for each row; empty: not known, no map
  std::optional<FallenView> fallen;
  friend bool operator==(const PotView&, const PotView&) = default;
};

/// A body of revolution about a vertical axis through the HIP; for a pinch two of them.
struct ToolView {
  std::vector<glm::vec2> half_profile_mm;  ///< (f, t): radius at a height from the HIP; t rises
  glm::dvec3 place_mm{0.0};                ///< the HIP
  std::optional<double> gap_mm;            ///< pinch: between the tools, on either side of the HIP
  bool contact = false;                    ///< lights the side that touches
  bool inside = false;      ///< it touches the bore: the side away from the axis is lit
  glm::dvec3 force_n{0.0};  ///< on the hand; drawn as an arrow of no more than kArrowLimit
  friend bool operator==(const ToolView&, const ToolView&) = default;
};

/// Length of the arrow of a force [mm/N], and the force that it grows to at most [N].
inline constexpr double kArrowMmPerN = 12.0, kArrowLimitN = 5.0;

enum class Theme { light, dark };

/// How much of the pot is taken away to show its section.
enum class Cut { none, half, quarter };

/// Colours for the thickness of walls: from 0 to `top_mm`, the same for every pot. What is below
/// `limit_mm` is hatched in a colour of its own. Drawn where the pot's `wall_mm` is known.
struct WallMap {
  double limit_mm = 0.0;
  double top_mm = 10.0;
  friend bool operator==(const WallMap&, const WallMap&) = default;
};

struct Picture {
  PotView pot;
  std::optional<ToolView> tool;
  Camera camera;
  Theme theme = Theme::light;
  Cut cut = Cut::none;
  /// Where the middle of the cut opens to, as Camera::azimuth_rad; nothing: to the camera.
  std::optional<double> cut_azimuth_rad;
  std::optional<WallMap> wall_map;
  double wheel_turn_rad = 0.0;  ///< counterclockwise from above, of wheel and clay
  /// Of the wheel head; nothing: the next of a row of sizes that holds the clay.
  std::optional<double> wheel_radius_mm;
  friend bool operator==(const Picture&, const Picture&) = default;
};

/// Radius of the wheel head that a pot is drawn on unless told otherwise [mm].
[[nodiscard]] double wheel_radius_mm(const PotView& pot) noexcept;

/// A camera that sees the whole pot, from a little above and to the right.
[[nodiscard]] Camera framed(const PotView& pot, double aspect) noexcept;
/// The same from where `camera` looks: only its target and distance change.
[[nodiscard]] Camera framed(const PotView& pot, double aspect, Camera camera) noexcept;

}  // namespace clay::render
