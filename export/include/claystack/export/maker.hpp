#pragma once
// Figures of a pot for its maker: size, weight, capacity, balance; computed from the section alone.

#include "claystack/core/result.hpp"
#include "claystack/export/section.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid::inline section {

// ---- clay ----------------------------------------------------------------------------

/// The largest accepted shrinkage, as a fraction of each length.
inline constexpr double kMostShrinkage = 0.5;
/// The largest accepted loss of water, and on ignition, as a fraction of the weight.
inline constexpr double kMostWeightLoss = 0.9;

/// Planning figures of a clay. Clays differ: weigh and measure a test tile.
struct ClayFigures {
  double density_g_cm3 = 1.9;  ///< wet
  /// Fraction of each length lost from thrown to fired; 0: not known, or not fired.
  double shrinkage = 0.0;
  /// Fraction of each length lost in drying; empty: half of `shrinkage`.
  std::optional<double> drying_shrinkage;
  double water = 0.20;          ///< fraction of the thrown weight lost in drying
  double ignition_loss = 0.09;  ///< fraction of the dry weight lost in firing

  /// Errors (bad_input) name the figure that is out of range; a drying shrinkage is at most the
  /// total.
  [[nodiscard]] Result<void> check() const;
};

/// The figures by name, in words: "shrinkage", "12 % of each length"; without shrinkage only the
/// density.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> assumptions_of(
    const ClayFigures& clay);

/// Default distance of the fill line below the brim [mm].
inline constexpr double kFillLineMm = 10.0;
/// Density of the contents: water [g/cm3].
inline constexpr double kContentsDensity = 1.0;

// ---- section as a body ---------------------------------------------------------------

/// Volume of a body of revolution, and the height of its centre of gravity.
struct RevolvedBody {
  double volume_mm3 = 0.0;
  double centre_mm = 0.0;  ///< height; 0 without volume
};

/// The clay: exact integrals over the frusta of the profile.
[[nodiscard]] RevolvedBody revolved_body(const Profile& profile) noexcept;

/// The room in the uppermost piece below `depth_mm` under its brim, if it is a cup; else empty. The
/// brim is the highest level of the piece. Assumes one bore at each height, as in every stack.
[[nodiscard]] RevolvedBody room_of(const Profile& profile, double depth_mm = 0.0) noexcept;

// ---- numbers -------------------------------------------------------------------------

struct PotSize {
  double diameter_mm = 0.0;
  double height_mm = 0.0;
  double foot_diameter_mm = 0.0;  ///< of the circle on which it stands
};

/// The pot wet, dry or fired.
struct PotState {
  PotSize size;
  double weight_g = 0.0;
  double capacity_ml = 0.0;  ///< to the brim
  double to_line_ml = 0.0;   ///< to the fill line
  double inside_cm2 = 0.0;   ///< surface from the brim down to the floor; 0 if it holds nothing
  double outside_cm2 = 0.0;  ///< the other surface, without the level part on which it stands
};

struct Balance {
  double centre_mm = 0.0;  ///< height of the centre of gravity above the foot
  /// Slope of the table at which the pot tips over the edge of its foot [deg]. The contents count
  /// as rigid: a liquid that flows to the lower side tips it earlier.
  double tipping_deg = 0.0;
};

/// All are of the section as written, which is the wet pot; shrinkage is even in all
/// directions.
struct MakerNumbers {
  ClayFigures clay;
  double fill_line_mm = 0.0;  ///< below the brim, of the pot in use
  PotState thrown;
  std::optional<PotState> dry, fired;  ///< if the shrinkage is known; without glaze
  /// The pot in use under its glaze, if it has an allowance for that; the weight is of the clay.
  std::optional<PotState> glazed;
  Balance empty;                ///< of the pot in use
  std::optional<Balance> full;  ///< to the brim; empty if it holds nothing
  std::string no_capacity;      ///< the reason why it holds nothing; empty: it does

  /// Fired, if the shrinkage is known; else wet.
  [[nodiscard]] const PotState& in_use() const noexcept { return fired ? *fired : thrown; }
};

/// Requires a profile that is not empty and valid figures.
[[nodiscard]] MakerNumbers maker_numbers(const Profile& profile, const ClayFigures& clay,
                                         double fill_line_mm = kFillLineMm);

/// Adds the figures under the glaze: those of `section`, the faces before they were set back.
void add_glaze(MakerNumbers& numbers, const Profile& section);

/// Of a collapsed pot, which has a size and a weight only: capacities, foot and balance are 0.
/// Requires valid figures.
[[nodiscard]] MakerNumbers fallen_numbers(const PotSize& size, double volume_mm3,
                                          const ClayFigures& clay,
                                          double fill_line_mm = kFillLineMm);

}  // namespace clay::solid::inline section
