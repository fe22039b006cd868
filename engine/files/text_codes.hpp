#pragma once
// Text codes for numbers that not every JSON reader holds exactly.

#include "claystack/engine/clay.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace clay::files {

/// A 64-bit hash: 16 lower-case hexadecimal digits.
struct HashCode {
  static constexpr std::string_view kExpected = "16 lower-case hexadecimal digits";
  static std::string encode(std::uint64_t hash);
  static std::optional<std::uint64_t> decode(std::string_view text);
};

/// A wide count of at most 30 decimal digits: the sum of five such counts does not overflow.
struct DecimalCode {
  static constexpr std::string_view kExpected =
      "a text of 1 to 30 decimal digits without leading zeros";
  static std::string encode(WideQuanta count) { return clay::to_string(count); }
  static std::optional<WideQuanta> decode(std::string_view text);
};

/// The same for a count that may be negative.
struct SignedDecimalCode {
  static constexpr std::string_view kExpected =
      "a text of 1 to 30 decimal digits without leading zeros, or - and those, but not -0";
  static std::string encode(WideQuanta count) { return clay::to_string(count); }
  static std::optional<WideQuanta> decode(std::string_view text);
};

}  // namespace clay::files
