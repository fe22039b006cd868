#pragma once
// The section of a pot in the half-plane: the cut face on the right of the axis.

#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"

#include <cstddef>
#include <vector>

namespace clay::solid::inline section {

struct ProfilePoint {
  double rho = 0.0;  ///< distance from the axis [mm], >= 0
  double y = 0.0;    ///< height above the wheel head [mm]
  friend bool operator==(const ProfilePoint&, const ProfilePoint&) = default;
};

/// A closed polygon, counterclockwise in the (rho, y) plane, first point not repeated.
using Polygon = std::vector<ProfilePoint>;

/// One polygon for each piece of clay, bottom to top. Edges along rho = 0 lie inside the solid and
/// make no surface; every other edge sweeps one.
struct Profile {
  std::vector<Polygon> pieces;
  friend bool operator==(const Profile&, const Profile&) = default;
};

enum class Topology { solid, cup, tube, cavity };

struct Cavity {
  double bottom_mm = 0.0;
  double top_mm = 0.0;
  double volume_mm3 = 0.0;  ///< trapped volume: needs a drain hole
};

/// The shape of a piece: `solid` has no bore, `cup` is open at one end (or at both, with a floor
/// between), `tube` is open at both ends without a floor, `cavity` has a bore closed at both ends.
struct PieceShape {
  Topology topology = Topology::solid;
  std::size_t first_ring = 0;
  std::size_t last_ring = 0;
  std::vector<Cavity> cavities;
};

struct StackProfile {
  Profile profile;
  std::vector<PieceShape> shapes;  ///< one per piece
};

/// The steps of the stack, crown included, without points in the middle of a straight line. Rings
/// whose annuli do not overlap end a piece. Rings that touch in a circle only (outer radius of one
/// = inner radius of the next) are an error, because no solid has such an edge.
///
/// Steps narrower than `min_step_mm` become one vertex between the two radii; R^2 is averaged by
/// the heights on both sides, so the clay lost on one side is gained on the other. The volume
/// changes by less than pi H step^2 for a wall of height H. Steps onto the axis are kept.
Result<StackProfile> profile_of(const ClayStack& stack, double min_step_mm = 0.0);

/// Volume of the solid of revolution [mm^3], exact up to rounding (sum of frusta).
[[nodiscard]] double volume_of(const Profile& profile) noexcept;

}  // namespace clay::solid::inline section
