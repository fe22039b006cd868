#pragma once
// Wall thickness, computed from the profile alone.

#include "claystack/core/result.hpp"
#include "claystack/export/section.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline walls {

/// A wall between two points of the boundary. If it crosses the axis, `to` lies on the mirrored
/// half of the section: its rho is negative.
struct Wall {
  double thickness_mm = 0.0;
  ProfilePoint from, to;
  bool compact = false;  ///< the clay has no wall: this is the largest disc in it
};

/// Minimum wall thickness [mm] of the solid of revolution of a certified profile.
///
/// A wall is the clay between two points of the boundary that a disc in the section connects: it
/// touches the face at one point and passes through the other, and its diameter is the thickness,
/// |d|^2 / (d n) for the segment d between the points and the inward normal n. The segment lies in
/// clay at both ends, and the inward normals are more than 90 degrees apart. At a reentrant corner
/// the disc may touch in any direction between the two normals: there the thickness is the
/// distance. Across the axis, clay continues as its mirror image.
///
/// The boundary between the two points must be at least three diameters long, either way round.
/// So the clay continues on both sides of the disc: a flange counts where it is longer than it is
/// thick, and so does a lip. A shorter part is an edge, a step or a rounded end. There is no rule
/// by angle: two faces that meet in a wedge of 4 atan(1/6) = 37.8 degrees or less are thin where
/// they meet, and a blunter wedge is thin nowhere. A piece of clay in which no disc has that much
/// boundary, such as a round hoop, is as thick as the largest disc in it (to 0.1 %): the thickness
/// is never infinite.
///
/// For a polygon this minimum is exact up to rounding: for each pair of edges the disc is a convex
/// function of both places, and the length of the boundary a linear one.
///
/// Every rho is first multiplied by `rho_scale`: cos(pi / n) gives the wall of the n-gon revolve,
/// whose sectors are prisms over the scaled profile. The places are those of the unscaled profile.
[[nodiscard]] Wall min_wall(const Profile& profile, double rho_scale = 1.0);

/// `min_wall(profile).thickness_mm`.
[[nodiscard]] double min_wall_mm(const Profile& profile);

struct WallBounds {
  double lower_mm = 0.0, upper_mm = 0.0;
};

/// Bounds of the minimum wall of a solid whose sections are the profile with rho multiplied by
/// factors from `least_scale` to `greatest_scale`. A disc in a section is contained in a wider
/// one, and has more boundary there. So the lower bound is that of the narrowest section with the
/// boundary of the widest, and the upper bound is that of the widest section.
[[nodiscard]] WallBounds wall_bounds(const Profile& profile, double least_scale,
                                     double greatest_scale);

/// The kind of a boundary point, in the order of the polygon: the outer wall rises from the foot to
/// the rim, the rest belongs to the bore. A floor and a lid are its faces within 45 degrees of
/// level that reach the axis.
enum class WallFace : std::uint8_t { foot, outer, rim, bore, floor, lid };

/// The part of a section to which a wall belongs. It depends on the shorter path along the boundary
/// between the two points of its disc, without the axis. A lip contains the rim but not the foot in
/// a path of at most nine diameters of the disc; a flange contains neither. All else is wall:
/// floors, feet and stems too.
enum class WallPart : std::uint8_t { wall, lip, flange };

struct WallSample {
  double thickness_mm = 0.0;  ///< infinite if no point is opposite
  ProfilePoint at;
  ProfilePoint opposite;  ///< `at` if there is none; see `Wall::to`
  double arc_mm = 0.0;    ///< from the first vertex of the polygon, without edges on the axis
  std::size_t piece = 0;
  WallFace face = WallFace::outer;
  WallPart part = WallPart::wall;
};

inline constexpr std::size_t kMaxWallSamples = 100'000;

/// Thickness along every face, at the middles of equal parts of its edges, each at most
/// `spacing_mm` > 0 long. Above `kMaxWallSamples`, only every second, third, ... sample is kept. No
/// sample is thinner than `min_wall`, to its accuracy; as the spacing shrinks, the thinnest
/// converges to it. Where a wall ends, as at a lip, the discs have too little boundary: samples
/// there have the thickness of the nearest sample that is not at an end.
[[nodiscard]] std::vector<WallSample> wall_field(const Profile& profile, double spacing_mm);

/// "outer", "bore", ...
[[nodiscard]] std::string_view name_of(WallFace face);
/// "wall", "lip" or "flange".
[[nodiscard]] std::string_view name_of(WallPart part);

/// The thinnest place of a part.
struct PartWall {
  WallPart part = WallPart::wall;
  double thickness_mm = 0.0;
  ProfilePoint at;
};

/// Of each part that the section has, in the order of WallPart. The part of `thinnest` has
/// `least_mm`, the minimum wall of the solid; the others have that of their thinnest sample.
[[nodiscard]] std::vector<PartWall> walls_by_part(const Profile& profile,
                                                  const std::vector<WallSample>& field,
                                                  const Wall& thinnest, double least_mm);
/// "wall 4.800 mm at a height of 128.8 mm, lip 5.112 mm at a height of 187.2 mm".
[[nodiscard]] std::string text_of(const std::vector<PartWall>& parts);

/// Maximum distance of consecutive samples in a table, along an edge.
inline constexpr double kWallTableSpacingMm = 0.5;

/// CSV with a header, for plots and spreadsheets; lengths in mm, thickness empty if no face is
/// opposite.
[[nodiscard]] std::string wall_table(const std::vector<WallSample>& field);

// ---- wall limits ---------------------------------------------------------------------
// The minimum walls required by the user or by a manufacturing process. Every figure names its
// source.

/// A process as people write it: "FDM (filament)" of "fdm"; the name of a custom one.
[[nodiscard]] std::string process_title(std::string_view name);

/// A minimum wall and its source.
struct WallLimit {
  /// Applies to objects whose width, depth and height add up to at most this, each of them with the
  /// allowance of a size.
  double up_to_size_sum_mm = std::numeric_limits<double>::infinity();
  double min_wall_mm = 0.0;
  std::string source;   ///< source of the figure
  std::string process;  ///< the process that requires it; empty: the user

  /// "Porcelain: SOURCE".
  [[nodiscard]] std::string asked_by() const;
  /// The thinnest wall that passes [mm], so that a wall drawn at the limit passes although facets
  /// and rings make it a little thinner: 0.1 % thinner; below 1 mm 0.001 mm, but at most 1 %.
  [[nodiscard]] double least_mm() const noexcept {
    return min_wall_mm - std::max(1e-3 * min_wall_mm, std::min(1e-3, 1e-2 * min_wall_mm));
  }
  [[nodiscard]] bool met_by(double wall_mm) const noexcept { return wall_mm >= least_mm(); }
};

/// The steepest underside that a process makes without support, from the vertical [deg].
struct OverhangLimit {
  double max_deg = 90.0;
  std::string source;

  /// So that an underside drawn at the limit passes although facets and rounding make it a little
  /// steeper: by up to 0.1 degrees.
  [[nodiscard]] bool met_by(double angle_deg) const noexcept { return angle_deg <= max_deg + 0.1; }
};

/// The smallest radius of edges: sharp ones chip.
struct EdgeLimit {
  double min_radius_mm = 0.0;
  std::string source;
};

/// A width, depth or height passes a limit of size up to this much above it [mm], so that a pot
/// drawn at the limit passes although facets and a grid make it a little larger.
inline constexpr double kSizeAllowanceMm = 0.1;

/// The sum by which a process chooses its minimum wall, of width, depth and height [mm].
[[nodiscard]] inline double size_sum_mm(const glm::dvec3& size_mm) noexcept {
  return size_mm.x + size_mm.y + size_mm.z;
}
/// Width, depth and height of a body of revolution that stands upright [mm].
[[nodiscard]] inline glm::dvec3 round_size_mm(double diameter_mm, double height_mm) noexcept {
  return {diameter_mm, diameter_mm, height_mm};
}

/// The largest object that a machine, a kiln or a service takes.
struct SizeLimit {
  double width_mm = 0.0, depth_mm = 0.0, height_mm = 0.0;
  std::string source;

  /// Whether an object of this width, depth and height fits upright, turned by 90 degrees if
  /// needed, with the allowance of a size.
  [[nodiscard]] bool fits(const glm::dvec3& size_mm) const noexcept;
};

struct ProcessLimits {
  std::string name;
  std::vector<WallLimit>
      walls;           ///< by increasing size; the last also applies to all larger objects
  bool fired = false;  ///< in a kiln, where a closed cavity bursts
  std::optional<OverhangLimit> overhang;
  std::optional<SizeLimit> size;
  std::optional<EdgeLimit> edges;

  /// Requires at least one wall.
  [[nodiscard]] const WallLimit& wall_for(double size_sum_mm) const noexcept;

  /// Of limits that a program made: the rules of a process file. Errors (bad_input) name the number
  /// that is out of range.
  [[nodiscard]] Result<void> check() const;
};

inline constexpr std::array<std::string_view, 5> kProcessNames{"fdm", "sla", "earthenware",
                                                               "stoneware", "porcelain"};

/// One of kProcessNames; any other name is an error that lists them.
Result<ProcessLimits> process_named(std::string_view name);

/// The smallest wall that any of kProcessNames allows [mm].
[[nodiscard]] double smallest_allowed_wall_mm();

/// JSON as in samples/schema/process.schema.json; errors name the file and the field.
Result<ProcessLimits> parse_process(std::string_view bytes, std::string_view file_name);

/// One of kProcessNames, or a file name ending in .json.
Result<ProcessLimits> read_process(const std::string& name);

/// The requirements on the walls of an object, before its size is known.
struct WallDemand {
  std::optional<double> min_wall_mm;
  std::optional<ProcessLimits> process;
  /// The source of `min_wall_mm` in reports, such as an option of a command.
  std::string min_wall_source = "requested minimum wall";

  /// For an object whose width, depth and height add up to this: the larger of both figures. Empty
  /// without requirements.
  [[nodiscard]] std::optional<WallLimit> for_size(double size_sum_mm) const;
};

// ---- overhang ------------------------------------------------------------------------

// The angle of a place on an underside, printed upright, is that of the face there [deg from the
// vertical: 0 for a wall, 90 for a ceiling]. If clay lies at most kOverhangDepthMm lower, it is
// that of the straight line down to it that is nearest to the vertical, if this is less and its
// tangent is at most kSteepestHeld. So each step of a staircase is held by those below it, and a
// ledge is held that is narrower than the depth times the tangent of the limit. The bed holds all
// that is at most kOverhangDepthMm above it. The overhang of a solid is the largest angle that
// places of kOverhangAreaMm2 together reach.

/// About two layers of a filament printer.
inline constexpr double kOverhangDepthMm = 0.5;
/// Tangent of 84.3 degrees: clay farther aside than 10 times the height does not hold a place.
inline constexpr double kSteepestHeld = 10.0;
/// Smaller undersides need no support.
inline constexpr double kOverhangAreaMm2 = 4.0;

struct Overhang {
  double angle_deg = 0.0;  ///< 0 without undersides
  ProfilePoint at;
};

/// Of the solid of revolution of a profile; the bed is its lowest level. Places are examined every
/// 0.004 mm of the section, less closely along more than 400 mm of undersides.
[[nodiscard]] Overhang steepest_overhang(const Profile& profile);

/// "overhang of 51.2 degrees at a height of 6.6 mm; FDM (filament): at most 45 without support
/// (SOURCE)". The process has a limit.
[[nodiscard]] std::string overhang_text(double angle_deg, double height_mm,
                                        const ProcessLimits& process);

/// "3.440 mm, expected at least 3.000 mm (SOURCE)".
[[nodiscard]] std::string wall_text(double thinnest_mm, const WallLimit& limit);

/// The same with the first few stretches of the section's faces that are too thin: "...; thinner:
/// bore from 64.0 to 137.2 mm of height, lip from 180.1 to 188.5 mm of height, ...".
[[nodiscard]] std::string thin_wall_text(const Profile& profile, double thinnest_mm,
                                         const WallLimit& limit);

}  // namespace clay::solid::inline walls
