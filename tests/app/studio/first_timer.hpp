#pragma once
// A simulated newcomer at the window: follows the path of the guide with the mouse, with a shaky
// hand, and uses nothing else on screen.

#include "claystack/engine/clay.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace clay::test {

struct FirstPot {
  double stroke_s = 0.0;  ///< time with the button pressed
  int strokes = 0;
  bool finished = false;  ///< all steps of the lesson
  bool fallen = false;
  bool ready = false;  ///< the verdict that the window shows
  std::string verdict;
  std::shared_ptr<const Pot> pot;
  double thinnest_mm = 0.0;
  double height_mm = 0.0, sample_height_mm = 0.0;
  double capacity_ml = 0.0, sample_capacity_ml = 0.0;
  /// Whether it is a pot, not a lump with a hole: its capacity is at least half of that of the
  /// sample.
  [[nodiscard]] bool is_pot() const { return capacity_ml >= 0.5 * sample_capacity_ml; }
};

/// Errors of the hand: each coordinate of each of 60 events per second deviates by `noise_mm` (one
/// standard deviation, correlated over 0.1 s); strokes at 20 to 45 mm/s; 0.4 s until the hand moves
/// after a press. `most_s`: stops after this time of strokes.
[[nodiscard]] FirstPot throw_first_pot(std::size_t sample, std::uint64_t seed, double noise_mm,
                                       double most_s = 240.0);

}  // namespace clay::test
