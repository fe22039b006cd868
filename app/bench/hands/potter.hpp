#pragma once
// A simulated potter with human errors on a wheel of the engine.

#include "app/bench/hands/dice.hpp"
#include "claystack/engine/wheel.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace clay::bench {

/// A position of the hand: distance from the axis, height [mm].
struct Place {
  double out = 0.0, up = 0.0;
};

/// Errors of the hand: tremor of 0.3 mm (RMS) at 7 to 9 Hz, strokes at 20 to 60 mm/s, depth
/// misjudged by 30 % of the remainder, pulls that end at 80 to 102 % of the way to the rim and miss
/// the middle of the wall by 15 % of its thickness. The hand sends 60 events per second, as a mouse
/// does; straight lines connect them, and the wheel ticks at 1 kHz.
class Potter {
 public:
  Potter(Wheel& wheel, std::uint64_t seed);

  /// Opens the lump with a ball, down to a floor of this thickness.
  void open(double floor_mm = 8.0);
  void widen(double most_mm = 25.0);                 ///< in two passes
  void pull(double gap_mm, double target_mm = 0.0);  ///< gap of the fingers; target 0: the wall
  void belly(double depth_mm);
  void collar(double depth_mm, int passes = 4);
  void flare(double depth_mm);

  [[nodiscard]] double time_s() const { return time_s_; }
  [[nodiscard]] double tool_mm() const;
  /// Called for every tick.
  std::function<void(const Pose&, const StepReport&)> watch;

 private:
  struct Aim {
    double depth_mm = 0.0;
    int passes = 0;
    bool from_outside = false;
    double start = 0.0, end_low = 0.0,
           end_high = 0.0;               ///< in fractions of the height above the floor
    std::function<double(double)> bump;  ///< depth over that, 0 to 1
  };

  void stroke(const std::vector<Place>& path, double speed_mm_s, double gap_mm);
  void rise(Place from, double to_out, double part, double floor_mm, double speed_mm_s,
            double gap_mm);
  void aim(const Aim& aim);
  void tick(Place place, double gap_mm);
  [[nodiscard]] Place with_tremor(Place place, double at_s) const;
  [[nodiscard]] double height() const { return wheel_.stack().height_mm(); }
  [[nodiscard]] const Ring& ring_at(double up) const;
  [[nodiscard]] double middle_at(double up) const;
  [[nodiscard]] double floor_mm() const;
  double depth_error() { return dice_.between(0.7, 1.3); }
  double speed() { return dice_.between(20.0, 60.0); }

  Wheel& wheel_;
  Dice dice_;
  double time_s_ = 0.0;
  std::int64_t time_us_ = 0;
  std::array<double, 3> tremor_hz_{}, phase_out_{}, phase_up_{};
};

}  // namespace clay::bench
