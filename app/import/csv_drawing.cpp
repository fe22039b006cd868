#include "app/import/readers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <utility>

namespace clay::importing {
namespace {

constexpr std::string_view kBetween = " \t,;";

/// Removes a number, and the separator after it, from the front.
std::optional<double> take_number(std::string_view& text) {
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  const std::size_t rest = text.find_first_not_of(kBetween);
  if (rest == 0) return std::nullopt;
  text.remove_prefix(std::min(rest, text.size()));
  return value;
}

std::optional<glm::dvec2> point_of(std::string_view row) {
  const auto radius = take_number(row);
  const auto height = radius ? take_number(row) : std::nullopt;
  if (!height || !row.empty()) return std::nullopt;
  return glm::dvec2{*radius, *height};
}

}  // namespace

Result<Drawing> read_csv(std::string_view text, const std::string& name) {
  // Spreadsheets write a byte order mark in UTF-8 tables.
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  Drawing drawing{{}, true};
  PointLimits limits;
  bool open = false;    // the last line may continue
  bool titled = false;  // the row before the first point was treated as column names
  std::size_t number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view row = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    row = trimmed(row.substr(0, row.find('#')));
    if (row.empty()) {
      open = false;
      continue;
    }
    const auto point = point_of(row);
    if (!point && drawing.lines.empty() && !std::exchange(titled, true) &&
        std::isalpha(static_cast<unsigned char>(row[0])) != 0)
      continue;
    if (!point)
      return failure(ErrorKind::bad_input,
                     fmt::format("{}:{}: expected a radius and a height in mm, found \"{}\"", name,
                                 number, row.substr(0, 40)));
    if (point->x < 0.0)
      return failure(ErrorKind::bad_input,
                     fmt::format("{}:{}: expected a radius of 0 mm or more, found {:g}", name,
                                 number, point->x));
    if (const std::string problem = limits.problem_with({&*point, 1}); !problem.empty())
      return failure(ErrorKind::bad_input, fmt::format("{}:{}: {}", name, number, problem));
    if (!open) drawing.lines.emplace_back();
    open = true;
    drawing.lines.back().points_mm.push_back(*point);
  }
  return drawing;
}

}  // namespace clay::importing
