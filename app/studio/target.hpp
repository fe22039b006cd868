#pragma once
// The target profile: another pot, whose outline lies over the one on the wheel.

#include "app/render/picture.hpp"
#include "claystack/core/result.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace clay::studio {

struct Target {
  std::string name;  ///< of the file or the sample
  render::PotView view;
};
using SharedTarget = std::shared_ptr<const Target>;

/// A pot (.pot.json, .pot.cbor, .3mf), the current pot of a work, or a drawing of a section.
Result<SharedTarget> read_target(const std::filesystem::path& path);
Result<SharedTarget> sample_target(std::size_t sample);

/// How far a pot is from its target.
struct OffTarget {
  double mm = 0.0;                          ///< largest distance between the outlines
  double radius_mm = 0.0, height_mm = 0.0;  ///< where
  /// For each row of the pot, the larger distance of its two walls from the target's outline.
  std::vector<float> rows_mm;
};

/// Empty in a build without drawings, and for pots without clay.
[[nodiscard]] std::optional<OffTarget> off_target(const render::PotView& pot,
                                                  const render::PotView& target);

/// Distances up to which the window calls a pot equal to its target, and near to it [mm].
inline constexpr double kMatchesMm = 1.0, kNearMm = 3.0;

}  // namespace clay::studio
