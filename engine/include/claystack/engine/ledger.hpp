#pragma once
#include "claystack/engine/quanta.hpp"

namespace clay {

/// The account of every quantum of clay: initial + added = in the stack + trimmed + outside.
/// Normalised quanta (V / (pi h) in units of 2^-36 mm^2).
struct Ledger {
  WideQuanta initial = 0;  ///< in the stack when the scene began
  WideQuanta added = 0;    ///< put on since
  WideQuanta trimmed = 0;  ///< cut off by a trimming tool (the paper's chiselling)
  WideQuanta outside = 0;  ///< model `paper` only: excess not yet enough for a ring (section 5.1)

  /// Clay unaccounted for, given what the stack holds; 0 in a sound engine.
  [[nodiscard]] WideQuanta imbalance(WideQuanta in_stack) const noexcept {
    return in_stack + trimmed + outside - initial - added;
  }
  /// What the body itself lacks or has too much: the paper's volume error.
  [[nodiscard]] WideQuanta volume_error(WideQuanta in_stack) const noexcept {
    return in_stack + trimmed - initial - added;
  }
  friend bool operator==(const Ledger&, const Ledger&) = default;
};

}  // namespace clay
