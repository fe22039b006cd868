#include "app/import/svg_transform.hpp"

#include "app/import/svg_style.hpp"
#include "core/lower_case.hpp"
#include "core/number_parsing.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <system_error>
#include <utility>

namespace clay::importing {
namespace {

struct Measure {
  double value = 0.0;
  std::string unit;  ///< in lower case
};

void skip(std::string_view& text, std::string_view characters) {
  text.remove_prefix(std::min(text.find_first_not_of(characters), text.size()));
}

/// The letters at the front, in lower case; also "%" and the digits of "translate3d".
std::string take_word(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '%';
  });
  const std::string_view word = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(word.size());
  return lower_case(word);
}

std::optional<Measure> take_measure(std::string_view& text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Measure measure;
  const auto [stop, problem] = from_chars(text.data(), text.data() + text.size(), measure.value);
  if (problem != std::errc() || !std::isfinite(measure.value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  // The next number may follow without a blank: only letters are a unit.
  if (!text.empty() &&
      (std::isalpha(static_cast<unsigned char>(text.front())) != 0 || text.front() == '%'))
    measure.unit = take_word(text);
  return measure;
}

std::optional<std::vector<Measure>> measures_of(std::string_view list) {
  std::vector<Measure> measures;
  for (skip(list, kSvgBlank); !list.empty(); skip(list, kSvgBlank)) {
    const auto measure = take_measure(list);
    if (!measure) return std::nullopt;
    measures.push_back(*measure);
    skip(list, kSvgBlank);
    if (!list.starts_with(',')) continue;
    list.remove_prefix(1);
    skip(list, kSvgBlank);
    if (list.empty()) return std::nullopt;
  }
  return measures;
}

enum class Quantity { number, length, angle };

/// Of one unit, in px or degrees; empty if it is not a unit of the quantity.
std::optional<double> size_of_unit(std::string_view unit, Quantity quantity) {
  constexpr double kInch = 96.0;
  constexpr std::pair<std::string_view, double> kLengths[] = {
      {"px", 1.0},          {"in", kInch},        {"cm", kInch / 2.54}, {"mm", kInch / 25.4},
      {"q", kInch / 101.6}, {"pt", kInch / 72.0}, {"pc", kInch / 6.0}};
  constexpr std::pair<std::string_view, double> kAngles[] = {
      {"deg", 1.0}, {"grad", 0.9}, {"rad", 180.0 / std::numbers::pi}, {"turn", 360.0}};
  if (unit.empty()) return 1.0;
  if (quantity == Quantity::length)
    for (const auto& [name, size] : kLengths)
      if (name == unit) return size;
  if (quantity == Quantity::angle)
    for (const auto& [name, size] : kAngles)
      if (name == unit) return size;
  return std::nullopt;
}

/// A function, with the number and the quantities of its arguments.
struct Function {
  std::string_view name;  ///< in lower case
  std::size_t fewest, most;
  Quantity first, others;
};

constexpr Function kFunctions[] = {{"matrix", 6, 6, Quantity::number, Quantity::number},
                                   {"translate", 1, 2, Quantity::length, Quantity::length},
                                   {"translatex", 1, 1, Quantity::length, Quantity::length},
                                   {"translatey", 1, 1, Quantity::length, Quantity::length},
                                   {"scale", 1, 2, Quantity::number, Quantity::number},
                                   {"scalex", 1, 1, Quantity::number, Quantity::number},
                                   {"scaley", 1, 1, Quantity::number, Quantity::number},
                                   {"rotate", 1, 3, Quantity::angle, Quantity::length},
                                   {"skew", 1, 2, Quantity::angle, Quantity::angle},
                                   {"skewx", 1, 1, Quantity::angle, Quantity::angle},
                                   {"skewy", 1, 1, Quantity::angle, Quantity::angle}};

/// The arguments in px and degrees; empty if one has another unit or their number is wrong.
std::optional<std::vector<double>> arguments_of(const Function& function, std::string_view list) {
  const auto measures = measures_of(list);
  if (!measures || measures->size() < function.fewest || measures->size() > function.most)
    return std::nullopt;
  std::vector<double> arguments;
  for (const Measure& measure : *measures) {
    const auto size =
        size_of_unit(measure.unit, arguments.empty() ? function.first : function.others);
    if (!size) return std::nullopt;
    arguments.push_back(measure.value * *size);
  }
  return arguments;
}

std::string function_text(std::string_view name, const std::vector<double>& arguments) {
  std::string text(name);
  for (std::size_t i = 0; i < arguments.size(); ++i)
    text.append(i == 0 ? "(" : " ").append(number_text(arguments[i]));
  return text + ")";
}

/// Empty if the attribute has no equivalent.
std::optional<std::string> written(std::string_view name, std::string_view list) {
  const auto* function = std::ranges::find(kFunctions, name, &Function::name);
  if (function == std::end(kFunctions)) return std::nullopt;
  const auto arguments = arguments_of(*function, list);
  if (!arguments || (name == "rotate" && arguments->size() == 2)) return std::nullopt;
  const double first = arguments->front();
  if (name == "translatex") return function_text("translate", {first, 0.0});
  if (name == "translatey") return function_text("translate", {0.0, first});
  if (name == "scalex") return function_text("scale", {first, 1.0});
  if (name == "scaley") return function_text("scale", {1.0, first});
  if (!name.starts_with("skew")) return function_text(name, *arguments);
  // Only CSS has skew(x, y): written as its matrix.
  const auto tangent = [](double degrees) { return std::tan(degrees * std::numbers::pi / 180.0); };
  const double second = arguments->size() > 1 ? arguments->back() : 0.0;
  return function_text("matrix", {1.0, tangent(name == "skewy" ? first : second),
                                  name == "skewy" ? 0.0 : tangent(first), 1.0, 0.0, 0.0});
}

tl::unexpected<Error> refused(std::string_view property, std::string_view expected,
                              std::string_view found) {
  constexpr std::size_t kLongest = 60;
  return failure(ErrorKind::bad_input, fmt::format("{}: expected {}, found {}", property, expected,
                                                   found.substr(0, kLongest)));
}

}  // namespace

std::vector<double> svg_numbers(std::string_view list) {
  std::vector<double> numbers;
  for (const Measure& measure : measures_of(list).value_or(std::vector<Measure>())) {
    if (!measure.unit.empty()) return {};
    numbers.push_back(measure.value);
  }
  return numbers;
}

std::string svg_scaled(std::string_view length, double factor) {
  std::string_view rest = length;
  skip(rest, kSvgBlank);
  const auto measure = take_measure(rest);
  return measure ? number_text(measure->value * factor) + measure->unit : std::string(length);
}

Result<std::string> svg_transform(std::string_view transform,
                                  const std::optional<std::string>& origin) {
  constexpr std::string_view kExpected =
      "matrix, translate, scale, rotate or skew, with lengths in px, mm, cm, in or pt and angles "
      "in deg, grad, rad or turn";
  std::string text;
  for (std::string_view rest = transform; !rest.empty();) {
    skip(rest, std::string(kSvgBlank) + ",");
    if (rest.empty()) break;
    const std::string_view found = rest;
    const std::string name = take_word(rest);
    skip(rest, kSvgBlank);
    const std::size_t end = rest.find(')');
    if (!rest.starts_with('(') || end == std::string_view::npos)
      return refused("transform", kExpected, found);
    const auto function = written(name, rest.substr(1, end - 1));
    rest.remove_prefix(end + 1);
    if (!function)
      return refused("transform", kExpected, found.substr(0, found.size() - rest.size()));
    text.append(text.empty() ? "" : " ").append(*function);
  }
  if (!origin) return text;
  const Function place{{}, 2, 2, Quantity::length, Quantity::length};
  const auto at = arguments_of(place, *origin);
  if (!at) return refused("transform-origin", "two lengths, such as 10px 20px", *origin);
  return function_text("translate", *at) + " " + text + " " +
         function_text("translate", {-at->front(), -at->back()});
}

}  // namespace clay::importing
