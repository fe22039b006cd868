#pragma once
// Quality of a thrown pot: walls, steps, roughness, closed cavities.

#include "claystack/engine/clay.hpp"

namespace clay::bench {

struct PotMeasures {
  double height_mm = 0.0, width_mm = 0.0;
  double wall_mm = 0.0;  ///< mean, from 10 mm above the floor to the rim
  double wall_cv = 0.0;  ///< its standard deviation over the mean
  double thinnest_mm = 0.0;
  double roughness_um = 0.0;  ///< RMS against a Gaussian of 5 mm cut-off (ISO 16610-21)
  int ledges = 0;             ///< steps of more than 1 mm, steeper than 3
  double ledge_mm = 0.0;      ///< the largest
  double ledge_up_mm = 0.0;   ///< height of the largest
  int cavities = 0;           ///< closed bores
  double neck_mm = 0.0;       ///< minimum outer width above half of the height
  /// No closed cavity, no wall below 2 mm, no ledge of 2 mm.
  [[nodiscard]] bool printable() const {
    return cavities == 0 && thinnest_mm >= 2.0 && ledge_mm < 2.0;
  }
};

[[nodiscard]] PotMeasures measure(const ClayStack& stack);

}  // namespace clay::bench
