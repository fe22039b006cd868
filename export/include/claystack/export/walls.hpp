#pragma once
// How thick the clay is, from the profile alone.

#include "claystack/core/result.hpp"
#include "claystack/export/section.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline walls {

/// The clay between two points of the boundary. Across the axis `to` lies on the mirrored half of
/// the section: its rho is negative.
struct Wall {
  double thickness_mm = 0.0;
  ProfilePoint from, to;
};

/// Least thickness [mm] of what a certified profile sweeps, exact for its edges up to rounding
/// (and at the limit of the rule on ridges, below, up to the length of an edge).
///
/// Two points of a piece are opposite when the inward normals of their edges are more than 150
/// degrees apart and the straight way from the one to the other leaves into clay and arrives out
/// of clay; faces at 30 degrees or more to each other meet in an edge and are no wall. The
/// thickness between opposite points is the diameter of the least ball that touches the face at the
/// one and goes through the other: for a way d and a normal n, |d|^2 / (d n). At a reentrant corner
/// the ball may touch in every direction between the two normals: there it is the distance. Where
/// clay reaches the axis, balls about its points that touch an outside that leans by 30 degrees at
/// most count too (2R).
///
/// A flange is as thick as it is high, but what sticks out less than a quarter of that, such as a
/// step of a stack, is a ridge and no wall: the boundary around two opposite points must
/// measure 1.5 times the thickness between them, where half a circle would be pi / 2. As far as
/// both edges go on beyond the points, but no more than half the thickness, they count as well, so
/// that a lip is as thin as its very end.
///
/// Every rho is multiplied by `rho_scale` first: cos(pi / n) gives the wall of the n-gon revolve,
/// whose sectors are prisms over the profile scaled so. The places are the profile's own.
[[nodiscard]] Wall min_wall(const Profile& profile, double rho_scale = 1.0);

/// `min_wall(profile).thickness_mm`.
[[nodiscard]] double min_wall_mm(const Profile& profile);

/// What a place of the boundary is, seen along its polygon: the outer wall rises from the foot to
/// the rim, all else is the bore's. Floors look up and lids down, within 45 degrees.
enum class WallFace : std::uint8_t { foot, outer, rim, bore, floor, lid };

struct WallSample {
  double thickness_mm = 0.0;  ///< infinite where nothing is opposite
  ProfilePoint at;
  ProfilePoint opposite;  ///< `at` where nothing is; see `Wall::to`
  double arc_mm = 0.0;    ///< from the first vertex of the polygon, edges on the axis left out
  std::size_t piece = 0;
  WallFace face = WallFace::outer;
};

inline constexpr std::size_t kMaxWallSamples = 100'000;

/// Thickness along every face, at the middles of equal parts of its edges that are no longer than
/// `spacing_mm` > 0. Of more than `kMaxWallSamples`, every second, third, ... is kept. No sample is
/// thinner than `min_wall`, as exact as that is, and as the spacing shrinks the thinnest comes down
/// to it.
[[nodiscard]] std::vector<WallSample> wall_field(const Profile& profile, double spacing_mm);

/// "outer", "bore", ...
[[nodiscard]] std::string_view name_of(WallFace face);

/// Of the samples in a table: none is farther from the next along an edge.
inline constexpr double kWallTableSpacingMm = 0.5;

/// CSV with a header, for plots and spreadsheets; lengths in mm, thickness empty where nothing is
/// opposite.
[[nodiscard]] std::string wall_table(const std::vector<WallSample>& field);

// ---- wall limits ---------------------------------------------------------------------
// What the user, or a way of making things, asks of walls. Every figure says where it comes from.

/// The least wall that is asked for, and by whom.
struct WallLimit {
  /// Holds for objects whose width, depth and height add up to no more than this.
  double up_to_size_sum_mm = std::numeric_limits<double>::infinity();
  double min_wall_mm = 0.0;
  std::string source;   ///< whose figure it is
  std::string process;  ///< that asks for it; empty: the user does

  /// "porcelain: WHOSE FIGURE".
  [[nodiscard]] std::string asked_by() const;
};

struct ProcessLimits {
  std::string name;
  std::vector<WallLimit> walls;  ///< by rising size; the last holds for all larger objects too

  [[nodiscard]] const WallLimit& wall_for(double size_sum_mm) const noexcept;
};

inline constexpr std::array<std::string_view, 5> kProcessNames{"fdm", "sla", "earthenware",
                                                               "stoneware", "porcelain"};

/// One of kProcessNames; any other name is an error that lists them.
Result<ProcessLimits> process_named(std::string_view name);

/// JSON as in samples/schema/process.schema.json; errors name the file and the field.
Result<ProcessLimits> parse_process(std::string_view bytes, std::string_view file_name);

/// One of kProcessNames, or the file of that name, which ends in .json.
Result<ProcessLimits> read_process(const std::string& name);

/// What is asked of the walls of an object, before its size is known.
struct WallDemand {
  std::optional<double> min_wall_mm;
  std::optional<ProcessLimits> process;

  /// For an object whose width, depth and height add up to this: of both the larger figure. Nothing
  /// where nothing is asked.
  [[nodiscard]] std::optional<WallLimit> for_size(double size_sum_mm) const;
};

/// "3.440 mm, expected 3.000 mm at least (WHOSE FIGURE)".
[[nodiscard]] std::string wall_text(double thinnest_mm, const WallLimit& limit);

/// The same with the stretches of the section's faces that are too thin, the first few of them:
/// "...; thinner: bore from 64.0 to 137.2 mm of height, ...".
[[nodiscard]] std::string thin_wall_text(const Profile& profile, double thinnest_mm,
                                         const WallLimit& limit);

}  // namespace clay::solid::inline walls
