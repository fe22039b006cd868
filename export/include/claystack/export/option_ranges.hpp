#pragma once
// The ranges of the options of an export: one definition for the library, the command line and the
// window.

#include "claystack/core/result.hpp"
#include "claystack/export/maker.hpp"
#include "claystack/export/solid.hpp"

#include <cstddef>
#include <string_view>

namespace clay::solid::inline job {

struct ExportOptions;

/// The name of an option in messages, its unit (empty: a count, or a fraction of 1) and its range,
/// both ends included.
struct OptionRange {
  std::string_view name, unit;
  double lowest = 0.0, highest = 0.0;
  bool or_zero = false;  ///< 0 is allowed, too: the part is absent
};

/// Float32 does not separate the points of a part that is smaller [mm].
inline constexpr double kSmallestPartMm = 1e-3;
/// The longest length that is not a radius of a fillet [mm].
inline constexpr double kLongestMm = 1e4;

inline constexpr OptionRange kToleranceRange{"tolerance", "mm", 1e-5, 10.0};
inline constexpr OptionRange kSmoothLengthRange{"smooth length", "mm", 0.0, kLongestMm};
inline constexpr OptionRange kMinWallRange{"minimum wall", "mm", 1e-6, kLongestMm};
inline constexpr OptionRange kLipFilletRange{"lip fillet", "mm", kSmallestPartMm, 1e3, true};
inline constexpr OptionRange kFloorFilletRange{"floor fillet", "mm", kSmallestPartMm, 1e3, true};
/// Of the fired glaze. On the written solid it is thicker by the shrinkage. The set-back is made
/// within the tolerance, so that there it is also at least kGlazeOfTolerance times that.
inline constexpr OptionRange kGlazeRange{"glaze allowance", "mm", kSmallestPartMm, 10.0, true};
inline constexpr double kGlazeOfTolerance = 0.1;
inline constexpr OptionRange kFootWidthRange{"foot ring width", "mm", kSmallestPartMm, kLongestMm};
inline constexpr OptionRange kFootDepthRange{"foot ring depth", "mm", kSmallestPartMm, kLongestMm};
inline constexpr OptionRange kFootDiameterRange{"foot ring diameter", "mm", kSmallestPartMm,
                                                kLongestMm};
inline constexpr OptionRange kSegmentsRange{"segments", "", kMinSegments, kMaxSegments};
/// The lowest limit of triangles: no pot has fewer.
inline constexpr std::size_t kFewestOfPot = 8;
inline constexpr OptionRange kMaxTrianglesRange{"max triangles", "", kFewestOfPot, kMaxTriangles};
inline constexpr OptionRange kDrainRange{"drain", "mm", kSmallestPartMm, kLongestMm};
inline constexpr OptionRange kWallSpacingRange{"wall spacing", "mm", 1e-5, kLongestMm};
inline constexpr OptionRange kShrinkageRange{"shrinkage", "", 0.0, kMostShrinkage};
inline constexpr OptionRange kFillLineRange{"fill line", "mm", 0.0, kLongestMm};

/// An error (bad_input) names the option, its range and the value.
[[nodiscard]] Result<void> check_range(const OptionRange& range, double value);

/// Checks every number of the options, and that of the clay and the process in them. Each entry of
/// this room calls it first. Errors as of `check_range`.
[[nodiscard]] Result<void> check_ranges(const ExportOptions& options);

}  // namespace clay::solid::inline job
