#include "core/size_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace clay {
namespace {

constexpr int kMostDecimals = 9;

std::string digits_of(double value, std::chars_format format, int digits) {
  std::array<char, 350> text{};  // 1e308 without an exponent has 309 digits
  return {text.data(),
          std::to_chars(text.data(), text.data() + text.size(), value, format, digits).ptr};
}

}  // namespace

std::string fixed(double number, int decimals) {
  return digits_of(number, std::chars_format::fixed, decimals);
}

std::string size_text(double size, int decimals) {
  const bool small = size != 0.0 && std::abs(size) < std::pow(10.0, 1 - decimals);
  return small ? digits_of(size, std::chars_format::general, 2) : fixed(size, decimals);
}

std::string bound_text(double bound, int decimals) {
  constexpr double kMost = kMostDecimals;
  if (bound > 0.0)  // at least two significant digits
    decimals = static_cast<int>(
        std::clamp(1.0 - std::floor(std::log10(bound)), static_cast<double>(decimals), kMost));
  const double scale = std::pow(10.0, decimals);
  // A bound that prints as itself stays, in spite of its rounding as a double.
  return fixed(std::floor(bound * scale * (1.0 + 1e-12)) / scale, decimals);
}

int decimals_apart(double a, double b, int least) {
  while (least < kMostDecimals && fixed(a, least) == fixed(b, least)) ++least;
  return least;
}

}  // namespace clay
