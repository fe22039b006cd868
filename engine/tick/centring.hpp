#pragma once
// A wall that one of two tools is deeper in is pushed over to the other, never past the middle.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/tick.hpp"
#include "engine/tick/band.hpp"
#include "engine/tick/removal.hpp"
#include "engine/tick/shift.hpp"
#include "engine/tool/tool_state.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace clay {

/// How far each ring between two tools may be pushed over from the one that is deeper in it [mm]:
/// until both push back alike, for then the overlap with both loses energy all the way. Storage is
/// reserved once.
class PushOver {
 public:
  /// Room for this number of rings.
  void reserve(std::size_t rings);
  /// Of the rings beside the tools, whose contacts have one candidate range.
  void measure(const Tool& tool, const ClayStack& stack, double hip_y,
               std::span<const ToolRemoval> removals) noexcept;

  [[nodiscard]] std::size_t from() const noexcept { return from_; }
  [[nodiscard]] std::size_t to() const noexcept { return from_ + count_; }
  /// Of a ring from() .. to()-1. Nothing limits one whose middle is beyond an end of the tools:
  /// 1e300.
  [[nodiscard]] double inward_mm(std::size_t ring) const noexcept { return inward_[ring - from_]; }
  [[nodiscard]] double outward_mm(std::size_t ring) const noexcept {
    return outward_[ring - from_];
  }

 private:
  void measure(const Tool& tool, const ClayStack& stack, double hip_y,
               std::span<const ToolRemoval> removals, std::size_t first,
               std::size_t count) noexcept;

  std::size_t from_ = 0, count_ = 0;
  std::vector<double> inward_, outward_;  ///< whole packs
};

/// Lays `shift` for two tools, whose contacts have given way, and lessens the depths by it.
void centre(const StepPlan& plan, const ClayStack& stack, const ToolState& tool,
            const std::array<Band, 2>& bands, std::span<ToolRemoval> removals, WallRadii& walls,
            PushOver& over, Shift& shift) noexcept;

}  // namespace clay
