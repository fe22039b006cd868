#pragma once
// If one of two tools is deeper in a wall, the wall is pushed to the other, never past the middle.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "engine/tick/band.hpp"
#include "engine/tick/removal.hpp"
#include "engine/tick/shift.hpp"
#include "engine/tool/tool_state.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace clay {

/// Limit of the motion of each ring between two tools, away from the tool that is deeper in it
/// [mm]: until the clay pushes back equally on both tools. So the energy of the overlap only falls.
/// Storage is reserved once.
class PushOver {
 public:
  /// Room for this number of rings.
  void reserve(std::size_t rings);
  /// Of the rings beside the tools, whose contacts have one candidate range.
  void measure(const Tool& tool, const ClayStack& stack, double hip_y,
               std::span<const ToolRemoval> removals) noexcept;

  [[nodiscard]] std::size_t from() const noexcept { return from_; }
  [[nodiscard]] std::size_t to() const noexcept { return from_ + count_; }
  /// Of a ring from() .. to()-1. A ring whose middle is beyond an end of the tools has no limit:
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

/// Sets `shift` for two tools, whose contacts have given way, and reduces the depths by it.
void centre(const StepPlan& plan, const ClayStack& stack, const ToolState& tool,
            const std::array<Band, 2>& bands, std::span<ToolRemoval> removals, WallRadii& walls,
            const RimLimit& rim, PushOver& over, Shift& shift) noexcept;

}  // namespace clay
