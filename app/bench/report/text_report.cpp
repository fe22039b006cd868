#include "app/bench/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::bench {
namespace {

constexpr std::size_t kWidestCell = 60;

/// Counts characters, not bytes.
std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::size_t length = letters(text);
  const std::string blanks(width > length ? width - length : 0, ' ');
  return right ? blanks + text : text + blanks;
}

std::string heading(const Column& column) {
  return column.unit.empty() ? column.name
                             : std::string(column.name).append(" [").append(column.unit) + "]";
}

std::string text_of(const Table& table) {
  std::vector<std::size_t> widths;
  for (const Column& column : table.columns) widths.push_back(letters(heading(column)));
  for (const auto& row : table.rows)
    for (std::size_t k = 0; k < std::min(row.size(), widths.size()); ++k)
      widths[k] = std::max(widths[k], std::min(letters(short_text(row[k])), kWidestCell));
  std::string text = fmt::format("\n  {}\n ", table.title);
  for (std::size_t k = 0; k < widths.size(); ++k) {
    text.append(" ").append(padded(heading(table.columns[k]), widths[k] + 1, numeric(table, k)));
  }
  text += "\n";
  for (const auto& row : table.rows) {
    text += " ";
    for (std::size_t k = 0; k < std::min(row.size(), widths.size()); ++k)
      text.append(" ").append(padded(short_text(row[k]), widths[k] + 1, is_number(row[k])));
    text += "\n";
  }
  return table.note.empty() ? text : text + fmt::format("  {}\n", table.note);
}

}  // namespace

std::string text_of(const Section& section) {
  std::string text = fmt::format("{}\n{}\n", section.title, section.summary);
  for (const std::string& missed : section.missed) text += fmt::format("  NOT MET: {}\n", missed);
  std::size_t width = 0;
  for (const Value& value : section.values) width = std::max(width, letters(value.name));
  for (const Value& value : section.values) {
    const std::string iqr =
        value.spread == 0.0 ? "" : fmt::format("iqr {}", short_number(value.spread));
    text += fmt::format("  {}{}  {}  {}\n", padded(value.name, width, false),
                        padded(short_number(value.median), 10, true), padded(iqr, 12, false),
                        value.about);
  }
  for (const Table& table : section.tables) text += text_of(table);
  return text;
}

}  // namespace clay::bench
