#pragma once
// A pot with fewer digits: what a printer cannot show need not be stored. See pot_file.hpp.

#include "claystack/engine/pot.hpp"
#include "claystack/engine/result.hpp"

namespace clay {

/// `pot` with every radius at the nearest multiple of `precision_mm`: whole nanometres, 1e-5 to
/// 1 mm. A bore less than half a step wide becomes one step: a bore stays a bore.
///
/// The result is a pot of its own: its ledger begins with the clay that it holds, nothing added,
/// trimmed or outside, and `Pot::rounding` keeps what it held before. Crown, collapse and model
/// stay as they are; the rim, which tells how to throw on, is gone. Rounded pots round again to the same precision or a coarser one.
///
/// Refuses, naming the ring, what would change the topology: a wall that would vanish, rings that
/// would no longer touch each other, an outer radius beyond the limits of ClayStack.
Result<Pot> rounded_pot(const Pot& pot, double precision_mm);

/// What rounding added to the clay (negative: took away) [mm^3]; 0 of a pot that is not rounded.
[[nodiscard]] double volume_change_mm3(const Pot& pot) noexcept;

}  // namespace clay
