#pragma once
#include "claystack/export/smoothing.hpp"
#include "export/smoothing/piece_walls.hpp"

#include <cstddef>
#include <vector>

namespace clay::solid::inline smoothing {

/// The interfaces of a piece that became cuts for one reason, gathered into stretches.
class KeptStretches {
 public:
  explicit KeptStretches(const PieceWalls& piece) : piece_(piece) {}

  /// An interface, and the figure that was the reason; of several the least counts.
  void add(std::size_t interface, double figure);

  [[nodiscard]] bool empty() const noexcept { return least_.empty(); }

  /// A flag for each ring beside one of these interfaces.
  [[nodiscard]] std::vector<char> rings() const;

  /// Appends a report for each stretch. `walls_mm`, by ring, is what is there now, or empty.
  void report(KeptFor reason, const std::vector<double>& walls_mm,
              std::vector<KeptSteps>& reports) const;

 private:
  const PieceWalls& piece_;
  std::vector<double> least_;  ///< by interface; infinite where nothing was kept
};

/// A ring whose smoothed wall is thinner than it may be.
struct ThinRing {
  std::size_t ring = 0;
  double wall_mm = 0.0;
};

/// What is smoothed where, and how the wall guard takes it back, step by step: first the
/// simplification, then the smoothing. Every step takes something back for good, so that in the end
/// nothing is left but the steps as they are.
class SmoothingPlan {
 public:
  explicit SmoothingPlan(const PieceWalls& piece);

  [[nodiscard]] CutFlags& outer_cuts() noexcept { return cuts_.outer; }
  [[nodiscard]] CutFlags& bore_cuts() noexcept { return cuts_.bore; }
  [[nodiscard]] const Cuts& cuts() const noexcept { return cuts_; }

  /// For each ring, where `share_mm` is what is allowed at first.
  [[nodiscard]] std::vector<double> tolerances(double share_mm) const;

  /// Smaller tolerances about thin rings, given from the bottom up; in the end 0. False where
  /// there was none left to take back.
  bool refine(const std::vector<ThinRing>& thin);
  bool refine_everywhere();

  /// Cuts the interfaces of thin rings in both walls, and where these are cut already, the nearest
  /// of those about them. False when all are cut.
  bool keep_steps(const std::vector<ThinRing>& thin);

  /// Cuts the jumps whose chords change the volume most, until they account for `excess_over_pi`
  /// [mm^3] that smoothing has lost (below 0: gained). `moved_mm` is what giving it back by scaling
  /// would move, for the report. False when there are none.
  bool keep_jumps(double excess_over_pi, double moved_mm);

  [[nodiscard]] const KeptStretches& kept_for_wall() const noexcept { return thinned_; }
  [[nodiscard]] const KeptStretches& kept_for_volume() const noexcept { return jumps_; }

 private:
  [[nodiscard]] std::size_t reach_of(double wall_mm) const;
  [[nodiscard]] bool open(const WallRings& wall, const CutFlags& cut, std::size_t k) const;
  [[nodiscard]] bool open(std::size_t k) const;
  std::size_t next_open(std::size_t k);
  bool keep_steps(const ThinRing& thin);
  void cut(std::size_t k);
  [[nodiscard]] double chord_loss(std::size_t k) const;

  const PieceWalls& piece_;
  Cuts cuts_;
  std::vector<char> refinement_;   ///< of each ring's tolerance: how many times
  std::vector<std::size_t> next_;  ///< from each interface toward the next open one
  KeptStretches thinned_, jumps_;
};

}  // namespace clay::solid::inline smoothing
