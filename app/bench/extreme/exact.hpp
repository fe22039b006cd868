#pragma once
// Exact numbers by Boost.Multiprecision, independent of the engine.

#include "claystack/engine/clay.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>

namespace clay::extreme {

using Count = boost::multiprecision::cpp_int;
using Exact = boost::multiprecision::cpp_rational;
using Fifty = boost::multiprecision::cpp_bin_float_50;  ///< 50 decimal digits

[[nodiscard]] inline Count count_of(WideQuanta q) {
  const bool negative = q < 0;
  __extension__ using Unsigned = unsigned __int128;
  const Unsigned size =
      negative ? Unsigned{0} - static_cast<Unsigned>(q) : static_cast<Unsigned>(q);
  Count count = static_cast<std::uint64_t>(size >> 64);
  count <<= 64;
  count += static_cast<std::uint64_t>(size);
  return negative ? -count : count;
}

/// Squared millimetres of a count of quanta.
[[nodiscard]] inline Exact mm2_of(const Count& quanta) { return Exact(quanta, Count(1) << 36); }

/// The square of a double, without rounding. `mm` is finite.
[[nodiscard]] inline Exact square_of(double mm) {
  const Exact value(mm);
  return value * value;
}

}  // namespace clay::extreme
