#pragma once
// The yielding of clay to a tool in it, for some rings at once: plain loops over arrays, compiled
// for two or four rows at a time, with operations that IEEE 754 defines exactly.

#include "claystack/engine/plan.hpp"

#include <array>
#include <cstddef>

namespace clay {

/// Rings that one tool is in. [mm]
struct Yielding {
  static constexpr std::size_t kMost = 32;
  std::array<double, kMost> wall;     ///< R - r before
  std::array<double, kMost> depth;    ///< of the tool as it stands, in the clay as it was; > 0
  std::array<double, kMost> advance;  ///< part of that since the last pose; below 0 on its way out
  std::array<double, kMost> since;    ///< part of the time in which the tool was at the ring
  std::array<double, kMost> target;   ///< wall that the tools on it leave in the end
  std::array<double, kMost> left;     ///< depth that is left

  /// Loops go over whole packs of four rows: those behind the last ring hold a ring that no tool is
  /// in.
  [[nodiscard]] static constexpr std::size_t filled_up(std::size_t count) noexcept {
    return (count + 3) / 4 * 4;
  }
  void fill_up(std::size_t count) noexcept {
    for (std::size_t k = count; k < filled_up(count); ++k) {
      depth[k] = advance[k] = 0.0;
      wall[k] = since[k] = target[k] = 1.0;
    }
  }
  void copy(std::size_t to, const Yielding& from, std::size_t k) noexcept {
    wall[to] = from.wall[k];
    depth[to] = from.depth[k];
    advance[to] = from.advance[k];
    since[to] = from.since[k];
    target[to] = from.target[k];
  }
};

/// d depth / dt = v - kappa (R - r) min(1, depth / yield depth), v the speed of the tool's surface.
///
/// Deeper than the yield depth the wall falls as exp(-kappa t); nearer to the surface depth
/// and wall fall together, a logistic curve about the depth at which the clay gives way as fast as
/// the tool comes. For a tool that stands still both are exact, so two half steps equal one step,
/// but for the series that gives the time between the two parts. For a moving tool the wall during
/// the step is replaced by its mean.
void yield(const RemovalPlan& plan, double dt_s, Yielding& rings, std::size_t count) noexcept;
/// The same where the result of a row must not depend on the other rows. In `yield` its last bits
/// do.
void yield_each(const RemovalPlan& plan, double dt_s, Yielding& rings, std::size_t count) noexcept;

}  // namespace clay
