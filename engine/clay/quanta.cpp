#include "claystack/engine/clay.hpp"

#include <algorithm>

namespace clay {

std::string to_string(WideQuanta q) {
  __extension__ using Unsigned = unsigned __int128;
  const bool negative = q < 0;
  Unsigned rest = negative ? Unsigned{0} - static_cast<Unsigned>(q) : static_cast<Unsigned>(q);
  std::string digits;
  do {
    digits.push_back(static_cast<char>('0' + static_cast<int>(rest % 10)));
    rest /= 10;
  } while (rest != 0);
  if (negative) digits.push_back('-');
  std::reverse(digits.begin(), digits.end());
  return digits;
}

}  // namespace clay
