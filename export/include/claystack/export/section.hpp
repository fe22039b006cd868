#pragma once
// The section of a pot in the half-plane: what a knife would show, right of the axis.

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

/// One polygon for each piece of clay, bottom to top. Edges along rho = 0 lie inside the
/// solid and make no surface; every other edge sweeps one.
struct Profile {
  std::vector<Polygon> pieces;
  friend bool operator==(const Profile&, const Profile&) = default;
};

enum class Topology { solid, cup, tube, cavity };

struct Cavity {
  double bottom_mm = 0.0;
  double top_mm = 0.0;
  double volume_mm3 = 0.0;  ///< trapped: needs a drain hole
};

/// What a piece is: `solid` has no bore, `cup` is open at one end (or both, with a floor
/// between), `tube` is open right through. `cavity` has a bore that is closed at both ends.
struct PieceShape {
  Topology topology = Topology::solid;
  std::size_t first_ring = 0;
  std::size_t last_ring = 0;
  std::vector<Cavity> cavities;
};

struct StackProfile {
  Profile profile;
  std::vector<PieceShape> shapes;  ///< one for each piece
};

/// The steps of the stack as they are, crown included, with no point that three rings share
/// in line. Rings whose annuli do not overlap end a piece; rings that touch in a circle only
/// (outer radius of one = inner of the next) are an error, since no solid has such an edge.
///
/// Steps narrower than `min_step_mm` become one vertex between the two radii, where the clay
/// that one side loses is what the other gains: R^2 averaged by the heights on both sides. The
/// volume changes by less than pi H step^2 for a wall of height H. Steps onto the axis are kept.
Result<StackProfile> profile_of(const ClayStack& stack, double min_step_mm = 0.0);

/// Volume of the solid of revolution [mm^3], exact up to rounding (frusta).
[[nodiscard]] double volume_of(const Profile& profile) noexcept;

}  // namespace clay::solid::inline section
