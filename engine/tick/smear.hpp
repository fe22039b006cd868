#pragma once
// A wet finger evens out the surface that turns below it.

#include "claystack/engine/clay.hpp"
#include "engine/clay/stack_writer.hpp"
#include "engine/tick/band.hpp"

namespace clay {

struct Smearing {
  double surface_per_s = 0.0;  ///< speed of a surface of radius 1 under the tool: 2 pi x turns/s
  double yield_depth_mm = 0.25;
  double min_wall_mm = 0.0;
  /// A sponge also evens out the surface it touches: from deeper places to less deep ones.
  bool sponge = false;
  /// A sponge follows the slope of the surface.
  bool follows = false;
};

/// Diffusion of R^2 (of r^2 inside) along the pressed surface, which keeps the clay to the quantum:
/// between two places F = k W (O_i - O_j), k = D dt / distance^2, D = 0.012 mm times the surface's
/// speed, less where the tool barely touches. The window W reaches half of the contact's height
/// beyond it. No clay goes into the tool, and no wall becomes thinner than the minimum.
void smear(const Tool& tool, const ClayStack& stack, double hip_y, double dt_s,
           const Contact& contact, const Band& band, const Smearing& how,
           StackWriter& writer) noexcept;

}  // namespace clay
