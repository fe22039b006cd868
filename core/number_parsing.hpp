#pragma once
// Reads numbers. std::from_chars where the standard library has it for floating point; otherwise
// fast_float, which gives the same correctly rounded values.

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#ifndef __cpp_lib_to_chars
#include <fast_float/fast_float.h>

#include <cmath>
#include <concepts>
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

/// The whole text as a number, as from_chars reads it; empty if it is not one, or does not fit.
template <class Number>
std::optional<Number> parse_number(std::string_view text) noexcept {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, problem] = from_chars(text.data(), end, value);
  if (problem != std::errc() || stop != end) return std::nullopt;
  return value;
}

/// "A between B": both as parse_number reads them.
template <class Number>
std::optional<std::pair<Number, Number>> two_numbers(std::string_view text, char between) noexcept {
  const std::size_t at = text.find(between);
  if (at == std::string_view::npos) return std::nullopt;
  const auto first = parse_number<Number>(text.substr(0, at));
  const auto second = parse_number<Number>(text.substr(at + 1));
  if (!first || !second) return std::nullopt;
  return std::pair(*first, *second);
}

}  // namespace clay
