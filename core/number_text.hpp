#pragma once
// std::from_chars where the standard library has it for floating point; otherwise fast_float, which
// gives the same correctly rounded values.

#include <charconv>
#ifndef __cpp_lib_to_chars
#include <fast_float/fast_float.h>

#include <cmath>
#include <concepts>
#include <string_view>
#endif

namespace clay {

#ifdef __cpp_lib_to_chars
using std::from_chars;
#else
/// As std::from_chars: a number beyond the range of `Float` is an error (result_out_of_range) and
/// leaves `value` as it is.
template <std::floating_point Float>
std::from_chars_result from_chars(const char* first, const char* last, Float& value) noexcept {
  Float read{};
  const auto [end, error] = fast_float::from_chars(first, last, read);
  if (error != std::errc()) return {end, error};
  const std::string_view word(first, static_cast<std::size_t>(end - first));
  const std::string_view mantissa = word.substr(0, word.find_first_of("eE"));
  const bool named = word.find_first_of("nN") != std::string_view::npos;  // "inf", "nan"
  const bool vanished = read == 0 && mantissa.find_first_of("123456789") != std::string_view::npos;
  if ((std::isinf(read) && !named) || vanished) return {end, std::errc::result_out_of_range};
  value = read;
  return {end, std::errc()};
}
template <std::integral Integer>
std::from_chars_result from_chars(const char* first, const char* last, Integer& value) noexcept {
  return std::from_chars(first, last, value);
}
#endif

}  // namespace clay
