#include "app/cli/quantity.hpp"

#include "core/number_parsing.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <system_error>

namespace clay::cli {
namespace {

std::string names_of(std::span<const Unit> units) {
  std::string names;
  for (const Unit& unit : units) names.append(names.empty() ? "" : ", ").append(unit.name);
  return names;
}

/// "from 0 to 10 mm"; of a length without limits nothing.
std::string limits_text(double low_mm, double high_mm) {
  if (low_mm == std::numeric_limits<double>::lowest()) return "";
  return fmt::format(" from {:g} to {:g} mm", low_mm, high_mm);
}

}  // namespace

std::optional<double> number_with_unit(std::string_view text, std::span<const Unit> units,
                                       std::string_view usual) {
  double number = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, problem] = from_chars(text.data(), end, number);
  if (problem != std::errc()) return {};
  std::string_view name(stop, static_cast<std::size_t>(end - stop));
  if (name.starts_with(' ')) name.remove_prefix(1);
  if (name.empty()) name = usual.empty() ? units.front().name : usual;
  const auto unit = std::ranges::find_if(units, [&](const Unit& one) {
    return one.name.size() == name.size() && ends_ignoring_case(name, one.name);
  });
  if (unit == units.end()) return {};
  return number * unit->factor;
}

Result<double> quantity_of(std::string_view text, std::span<const Unit> units) {
  constexpr double kMost = 1e9;
  const auto number = number_with_unit(text, units);
  if (number && *number > 0.0 && *number < kMost) return *number;
  return failure(ErrorKind::bad_input,
                 fmt::format("expected a number above 0 and below {:g} {} (units: {}), found {}",
                             kMost, units.front().name, names_of(units), text));
}

Result<double> length_of(std::string_view text, double low_mm, double high_mm) {
  const auto length = number_with_unit(text, kLengthUnits);
  // Not (length < low): NaN must fail.
  if (length && *length >= low_mm && *length <= high_mm) return *length;
  return failure(ErrorKind::bad_input,
                 fmt::format("expected a length{} ({}), found {}", limits_text(low_mm, high_mm),
                             names_of(kLengthUnits), text));
}

Error or_else(std::string_view word, const Error& error) {
  constexpr std::string_view kBegin = "expected ";
  return {error.kind, fmt::format("{}{} or {}", kBegin, word, error.message.substr(kBegin.size()))};
}

CLI::Validator length_within(double low_mm, double high_mm, OrNone zero) {
  return {[=](std::string& text) {
            const bool none = zero == OrNone::yes && number_with_unit(text, kLengthUnits) == 0.0;
            const auto length = none ? Result<double>(0.0) : length_of(text, low_mm, high_mm);
            if (!length)
              return (zero == OrNone::yes ? or_else("0", length.error()) : length.error()).message;
            text = fmt::format("{}", *length);
            return std::string();
          },
          ""};
}

}  // namespace clay::cli
