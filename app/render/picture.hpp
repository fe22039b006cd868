#pragma once
// All contents of a frame as a plain value. Independent of OpenGL: any thread can make, keep and
// compare pictures. Lengths in mm, y up, the wheel head at y = 0.

#include "app/render/camera.hpp"
#include "core/material.hpp"

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace clay::render {

/// One or several rings: the same as servo::LiveProfile::Row.
struct Row {
  float outer_mm = 0.0f, inner_mm = 0.0f;  ///< 0 <= inner < outer; inner 0: no bore
  friend bool operator==(const Row&, const Row&) = default;
};

/// The wall thickness at either face of a row. Infinite if no face is opposite.
struct RowWall {
  float outer_mm = 0.0f;
  float inner_mm = 0.0f;  ///< for a row without a bore: of the floor on top of it
  friend bool operator==(const RowWall&, const RowWall&) = default;
};

/// The rows from `first_row` on, moved as a rigid body: rotated, then translated.
struct FallenView {
  std::size_t first_row = 0;
  glm::dmat4 place{1.0};  ///< from standing to resting place
  friend bool operator==(const FallenView&, const FallenView&) = default;
};

/// The clay, bottom to top in rows of equal height. Walls are drawn between the middles of
/// neighbouring rows; floors and lids lie between two rows.
struct PotView {
  std::vector<Row> rows;
  double height_mm = 0.0;        ///< of all rows together
  std::vector<RowWall> wall_mm;  ///< one per row; empty: unknown, no map
  std::optional<FallenView> fallen;
  friend bool operator==(const PotView&, const PotView&) = default;
};

/// The row at a height, of a pot that stands; null below and above it.
[[nodiscard]] const Row* row_at(const PotView& pot, double y_mm);
/// A bore begins at this radius: a narrower one is a dimple.
inline constexpr double kBoreMm = 2.0;
/// The clay under a bore: above the wheel, or above a hollow that was cut into the foot.
struct Floor {
  double bottom_mm = 0.0, top_mm = 0.0;
  [[nodiscard]] double thickness_mm() const noexcept { return top_mm - bottom_mm; }
};
/// Empty: no bore. A pot without a floor has one without thickness, on the wheel.
[[nodiscard]] std::optional<Floor> floor_of(const PotView& pot);

/// A body of revolution about a vertical axis through the HIP; two of them for a pinch.
struct ToolView {
  std::vector<glm::vec2> half_profile_mm;  ///< (f, t): radius at a height from the HIP; t ascending
  glm::dvec3 place_mm{0.0};                ///< the HIP
  std::optional<double> gap_mm;            ///< pinch: between the tools, on either side of the HIP
  bool contact = false;                    ///< highlights the touching side
  bool inside = false;      ///< touches the bore: highlights the side away from the axis
  glm::dvec3 force_n{0.0};  ///< on the hand [N]; drawn as an arrow of limited length
  friend bool operator==(const ToolView&, const ToolView&) = default;
};

/// Length of a force arrow [mm/N], and the force of its maximum length [N].
inline constexpr double kArrowMmPerN = 12.0, kArrowLimitN = 5.0;

enum class Theme { light, dark };

/// Additions of a picture to the geometry. `clay`: grooves and bands as hands leave them, and a rim
/// that looks rounded; none of it is in the pot. `geometry`: nothing.
enum class Style { clay, geometry };

/// The part of the pot removed to show its section.
enum class Cut { none, half, quarter };

/// Colours for the wall thickness: from 0 to `top_mm`, the same for every pot. Walls below
/// `limit_mm`, the thinnest that passes, are hatched in a separate colour. Drawn if the pot's
/// `wall_mm` is known.
struct WallMap {
  double limit_mm = 0.0;
  double top_mm = 10.0;
  /// The limit in words: as the user or the process states it, without the tolerance on it.
  double stated_mm = limit_mm;
  friend bool operator==(const WallMap&, const WallMap&) = default;
};

struct Picture {
  PotView pot;
  std::optional<ToolView> tool;
  Camera camera;
  Theme theme = Theme::light;
  Style style = Style::clay;
  Material material = kLeatherHard;
  Cut cut = Cut::none;
  /// Direction of the middle of the cut, like Camera::azimuth_rad; empty: towards the camera.
  std::optional<double> cut_azimuth_rad;
  std::optional<WallMap> wall_map;
  double wheel_turn_rad = 0.0;  ///< counterclockwise seen from above, of wheel and clay
  /// Of the wheel head; empty: the next standard size that holds the clay.
  std::optional<double> wheel_radius_mm;
  /// The clay and the tool without wheel, floor and background: the rest of the picture is
  /// transparent.
  bool alone = false;
  friend bool operator==(const Picture&, const Picture&) = default;
};

/// The default radius of the wheel head for a pot [mm].
[[nodiscard]] double wheel_radius_mm(const PotView& pot) noexcept;
[[nodiscard]] Extent extent_of(const PotView& pot) noexcept;

/// A camera that sees the whole pot, from a little above and to the right.
[[nodiscard]] Camera framed(const PotView& pot, double aspect, double covered = 0.0) noexcept;
/// The same view direction as `camera`: only target and distance change.
[[nodiscard]] Camera framed(const PotView& pot, double aspect, Camera camera) noexcept;

}  // namespace clay::render
