#include "app/import/csv_columns.hpp"

#include "app/import/readers.hpp"

#include "core/lower_case.hpp"
#include "core/text.hpp"

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
constexpr std::array<std::string_view, 5> kRadii = {"radius", "r", "rho", "x", "halbmesser"};
constexpr std::array<std::string_view, 3> kDiameters = {"diameter", "d", "durchmesser"};
// The escapes are of Windows-1252, in which German spreadsheets write tables.
constexpr std::array<std::string_view, 9> kHeights = {
    "height", "h", "y", "z", "höhe", "hÖhe", "hoehe", "h\xF6he", "h\xD6he"};
constexpr std::array<std::string_view, 5> kOuter = {"outer", "outside", "außen", "aussen",
                                                    "au\xDF"
                                                    "en"};
constexpr std::array<std::string_view, 3> kInner = {"inner", "inside", "innen"};

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
    if (part) words.back() += lower_case(c);
    open = part;
  }
  return words;
}

/// The words of a column's name, with "in" before a unit left out ("radius in mm"), and a German
/// compound such as "innendurchmesser" as two words.
std::vector<std::string> words_of_column(std::string_view name) {
  std::vector<std::string> words = words_in(name);
  if (words.size() > 2 && words[words.size() - 2] == "in") words.erase(words.end() - 2);
  const auto split_after = [&](std::string_view side) {
    if (words.empty() || words[0].size() <= side.size() || !words[0].starts_with(side)) return;
    words.insert(words.begin() + 1, words[0].substr(side.size()));
    words[0].resize(side.size());
  };
  for (const std::string_view side : kOuter) split_after(side);
  for (const std::string_view side : kInner) split_after(side);
  return words;
}

enum class Kind { other, radius, inner, height };

struct NamedColumn {
  Kind kind = Kind::other;
  CsvColumn column;
  bool unit_known = true;
};

/// The kind and unit of the `index`-th column, by its name.
NamedColumn column_of(std::string_view name, std::size_t index) {
  const std::vector<std::string> words = words_of_column(name);
  NamedColumn result{Kind::other, {index, 1.0}, true};
  if (words.empty()) return result;
  const bool within = among(kInner, words.front());
  const std::size_t noun = within || among(kOuter, words.front()) ? 1 : 0;
  if (noun >= words.size()) return result;
  const bool diameter = among(kDiameters, words[noun]);
  if (diameter || among(kRadii, words[noun]))
    result.kind = within ? Kind::inner : Kind::radius;
  else if (noun == 0 && among(kHeights, words[noun]))
    result.kind = Kind::height;
  if (result.kind == Kind::other || noun + 1 == words.size()) {
    if (diameter) result.column.mm = 0.5;
    return result;
  }
  const auto* const unit = std::find_if(kUnits.begin(), kUnits.end(), [&](const auto& known) {
    return known.first == words[noun + 1];
  });
  result.unit_known = unit != kUnits.end() && noun + 2 == words.size();
  if (result.unit_known) result.column.mm = (diameter ? 0.5 : 1.0) * unit->second;
  return result;
}

/// The file that `export NAME.csv` writes.
bool wall_table(const std::vector<std::string>& names) {
  const auto has = [&](std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  return has("thickness_mm") && has("opposite_rho_mm");
}

/// The end of the first field; a field in quotes may contain the mark. `mark`: the separator; ' '
/// stands for blanks and tabs.
std::size_t end_of_field(std::string_view row, char mark) {
  const std::size_t first = std::min(row.find_first_not_of(" \t"), row.size());
  std::size_t from = 0;
  if (row.substr(first).starts_with('"')) {
    const std::size_t close = row.find('"', first + 1);
    if (close != std::string_view::npos) from = close;
  }
  return std::min(mark == ' ' ? row.find_first_of(" \t", from) : row.find(mark, from), row.size());
}

}  // namespace

std::vector<std::string> csv_fields(std::string_view row) {
  char between = ' ';
  for (const char mark : {';', '\t', ','}) {
    if (end_of_field(trimmed(row), mark) == trimmed(row).size()) continue;
    between = mark;
    break;
  }
  if (between == ' ') row = trimmed(row);  // otherwise a row may begin or end with an empty field
  std::vector<std::string> fields;
  while (true) {
    const std::size_t end = end_of_field(row, between);
    std::string_view field = trimmed(row.substr(0, end));
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
      field = trimmed(field.substr(1, field.size() - 2));
    fields.emplace_back(field);
    if (end == row.size()) return fields;
    row.remove_prefix(end + 1);
    if (between == ' ') row = trimmed(row);  // several blanks count as one separator
  }
}

Result<CsvColumns> csv_columns(const std::vector<std::string>& names) {
  std::optional<CsvColumn> radius, inner, height;
  constexpr std::size_t kMostShown = 160;
  const auto refused = [&](std::string_view problem) {
    return failure(
        ErrorKind::bad_input,
        fmt::format("expected columns named radius and height, with a unit mm, cm, m or "
                    "in, such as radius_mm, found \"{}\"{}",
                    shown(fmt::format("{}", fmt::join(names, ", ")), kMostShown), problem));
  };
  if (wall_table(names))
    return refused(
        ": the walls of a pot, as export writes them, which are not an outline; the layer "
        "\"section\" of the .svg or .dxf that export writes is one");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const NamedColumn named = column_of(names[i], i);
    if (named.kind == Kind::other) continue;
    if (!named.unit_known) return refused(" with another word than a unit");
    std::optional<CsvColumn>& target = named.kind == Kind::height  ? height
                                       : named.kind == Kind::inner ? inner
                                                                   : radius;
    if (target)
      return refused(named.kind == Kind::height ? ", two of them heights" : ", two of them radii");
    target = named.column;
  }
  if (!radius || !height) return refused("");
  return CsvColumns{*radius, *height, inner, names.size()};
}

}  // namespace clay::importing
