#pragma once
#include "claystack/export/smoothing.hpp"
#include "export/smoothing/piece_walls.hpp"

#include <cstddef>
#include <vector>

namespace clay::solid::inline smoothing {

/// The interfaces of a piece that became cuts for one reason, grouped into stretches.
class KeptStretches {
 public:
  explicit KeptStretches(const PieceWalls& piece) : piece_(piece) {}

  /// Adds an interface with the value that caused the cut; the smallest of several is kept.
  void add(std::size_t interface, double figure);

  [[nodiscard]] bool empty() const noexcept { return least_.empty(); }

  /// A flag for each ring beside one of these interfaces.
  [[nodiscard]] std::vector<char> rings() const;

  /// Appends a report for each stretch. `walls_mm`: current wall by ring, or empty.
  void report(KeptFor reason, const std::vector<double>& walls_mm,
              std::vector<KeptSteps>& reports) const;

 private:
  const PieceWalls& piece_;
  std::vector<double> least_;  ///< by interface; infinite if not cut
};

/// A ring whose smoothed wall is too thin.
struct ThinRing {
  std::size_t ring = 0;
  double wall_mm = 0.0;
};

/// The current extent of smoothing. The wall guard undoes it step by step: first the
/// simplification, together with the length of the fairing, then the fairing, then the smoothing.
/// Every undo is permanent, so in the worst case only the steps remain.
class SmoothingPlan {
 public:
  /// `length_mm`: of the fairing; 0: none. Treads much narrower than it are marks of strokes and no
  /// corners, except where the fairing is undone. Nor are treads within the tolerance; 0: none.
  SmoothingPlan(const PieceWalls& piece, double length_mm, double tolerance_mm);

  [[nodiscard]] CutFlags& outer_cuts() noexcept { return cuts_.outer; }
  [[nodiscard]] CutFlags& bore_cuts() noexcept { return cuts_.bore; }
  [[nodiscard]] const Cuts& cuts() const noexcept { return cuts_; }

  /// The tolerance of each ring; `share_mm`: the initial one.
  [[nodiscard]] std::vector<double> tolerances(double share_mm) const;

  /// Those that may cause a thin wall: the cause is at most as far away as the wall is thick.
  [[nodiscard]] RingRange rings_around(const ThinRing& thin) const;

  /// The length of the fairing of each ring: halved each time that the tolerance is reduced, and 0
  /// where the fairing is undone. Empty without fairing.
  [[nodiscard]] std::vector<double> lengths() const;

  /// Reduces the tolerances around thin rings, given from the bottom up, finally to 0. False if
  /// they all are 0 already.
  bool refine(const std::vector<ThinRing>& thin);
  bool refine_everywhere();

  /// Undoes the fairing around thin rings, twice as far each time, so that the rounds grow with the
  /// logarithm of the number of rings. False if there is none.
  bool use_chords(const std::vector<ThinRing>& thin);
  bool use_chords_everywhere();

  /// Cuts the interfaces of thin rings in both walls, or the nearest uncut ones around them. False
  /// if all are cut.
  bool keep_steps(const std::vector<ThinRing>& thin);

  /// Cuts the jumps whose chords change the volume most, until they account for `excess_over_pi`
  /// [mm^3] that smoothing has lost (negative: gained). `moved_mm`: displacement that compensation
  /// by scaling would need, for the report. False if there are no such jumps.
  bool keep_jumps(double excess_over_pi, double moved_mm);

  [[nodiscard]] const KeptStretches& kept_for_wall() const noexcept { return thinned_; }
  [[nodiscard]] const KeptStretches& kept_for_volume() const noexcept { return jumps_; }

  /// Appends the stretches in which the length was reduced.
  void report(std::vector<ShortenedFairing>& reports) const;

 private:
  [[nodiscard]] std::size_t reach_of(double wall_mm) const;
  [[nodiscard]] bool open(const WallRings& wall, const CutFlags& cut, std::size_t k) const;
  [[nodiscard]] bool open(std::size_t k) const;
  std::size_t next_open(std::size_t k);
  bool keep_steps(const ThinRing& thin);
  void cut(std::size_t k);
  [[nodiscard]] double chord_loss(std::size_t k) const;
  void keep_marks_beside(std::size_t ring);

  const PieceWalls& piece_;
  double length_mm_;
  Cuts cuts_;
  Cuts marks_;                     ///< corners without fairing; empty without it
  std::vector<char> chords_;       ///< a flag for each ring; empty without fairing
  std::size_t chord_reach_ = 0;    ///< rings around thin ones, in addition to their thickness
  std::vector<char> refinement_;   ///< number of reductions of each ring's tolerance
  std::vector<std::size_t> next_;  ///< for each interface, a link towards the next open one
  KeptStretches thinned_, jumps_;
};

}  // namespace clay::solid::inline smoothing
