#pragma once
// Sizes and other figures as people read them, in the unit that the caller writes behind them.

#include <string>

namespace clay {

/// `number` with that many decimals, independent of the locale.
[[nodiscard]] std::string fixed(double number, int decimals);
/// A size for people: with this many decimals, and a small one with two significant digits, so that
/// nothing is "0.0 mm" wide.
[[nodiscard]] std::string size_text(double size, int decimals);
/// The same for a lower bound, rounded down: a wall of "at least 4.537 mm" is never thinner.
[[nodiscard]] std::string bound_text(double bound, int decimals);
/// The number of decimals, from `least` to 9, at which two figures print differently.
[[nodiscard]] int decimals_apart(double a, double b, int least);

}  // namespace clay
