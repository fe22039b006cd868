#include "app/import/csv_columns.hpp"

#include "app/import/readers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

namespace clay::importing {
namespace {

constexpr std::array<std::pair<std::string_view, double>, 8> kUnits = {{{"mm", 1.0},
                                                                        {"cm", 10.0},
                                                                        {"m", 1000.0},
                                                                        {"in", 25.4},
                                                                        {"inch", 25.4},
                                                                        {"inches", 25.4},
                                                                        {"millimetres", 1.0},
                                                                        {"centimetres", 10.0}}};
constexpr std::array<std::string_view, 4> kRadii = {"radius", "r", "rho", "x"};
constexpr std::array<std::string_view, 2> kDiameters = {"diameter", "d"};
constexpr std::array<std::string_view, 4> kHeights = {"height", "h", "y", "z"};

template <std::size_t N>
bool among(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The words of a name in lower case: "Radius [mm]" and "radius_mm" have two.
std::vector<std::string> words_in(std::string_view text) {
  std::vector<std::string> words;
  bool open = false;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool part = std::isalnum(byte) != 0 || byte >= 0x80;
    if (part && !open) words.emplace_back();
    if (part) words.back() += static_cast<char>(std::tolower(byte));
    open = part;
  }
  return words;
}

}  // namespace

std::vector<std::string> csv_fields(std::string_view row) {
  char between = ' ';
  for (const char mark : {';', '\t', ','}) {
    if (row.find(mark) == std::string_view::npos) continue;
    between = mark;
    break;
  }
  std::vector<std::string> fields;
  while (true) {
    row = trimmed(row);
    const std::size_t end =
        std::min(between == ' ' ? row.find_first_of(" \t") : row.find(between), row.size());
    std::string_view field = trimmed(row.substr(0, end));
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
      field = trimmed(field.substr(1, field.size() - 2));
    fields.emplace_back(field);
    if (end == row.size()) return fields;
    row.remove_prefix(end + 1);
  }
}

Result<CsvColumns> csv_columns(const std::vector<std::string>& names) {
  std::optional<CsvColumn> radius, height;
  const auto refused = [&](std::string_view problem) {
    return failure(ErrorKind::bad_input,
                   fmt::format("expected columns named radius and height, with a unit mm, cm, m or "
                               "in, such as radius_mm, found \"{}\"{}",
                               fmt::join(names, ", "), problem));
  };
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::vector<std::string> words = words_in(names[i]);
    if (words.empty()) continue;
    const bool diameter = among(kDiameters, words.front());
    const bool wide = diameter || among(kRadii, words.front());
    if (!wide && !among(kHeights, words.front())) continue;
    CsvColumn column{i, diameter ? 0.5 : 1.0};
    for (std::size_t k = 1; k < words.size(); ++k) {
      const auto* const unit = std::find_if(
          kUnits.begin(), kUnits.end(), [&](const auto& known) { return known.first == words[k]; });
      if (unit == kUnits.end() || k > 1) return refused(" with another word than a unit");
      column.mm *= unit->second;
    }
    std::optional<CsvColumn>& target = wide ? radius : height;
    if (target) return refused(wide ? ", two of them radii" : ", two of them heights");
    target = column;
  }
  if (!radius || !height) return refused("");
  return CsvColumns{*radius, *height, names.size()};
}

}  // namespace clay::importing
