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

}  // namespace clay::solid::inline smoothing
