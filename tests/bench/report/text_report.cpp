#include "report/report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::bench {
namespace {

constexpr std::size_t kWidestCell = 60;

/// Characters, not bytes.
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
  std::string text = "\n  " + table.title + "\n ";
  for (std::size_t k = 0; k < widths.size(); ++k) {
    const bool right = !table.rows.empty() && k < table.rows[0].size() && is_number(table.rows[0][k]);
    text += " " + padded(heading(table.columns[k]), widths[k] + 1, right);
  }
  text += "\n";
  for (const auto& row : table.rows) {
    text += " ";
    for (std::size_t k = 0; k < std::min(row.size(), widths.size()); ++k)
      text += " " + padded(short_text(row[k]), widths[k] + 1, is_number(row[k]));
    text += "\n";
  }
  return table.note.empty() ? text : text + "  " + table.note + "\n";
}

}  // namespace

std::string text_of(const Section& section) {
  std::string text = section.title + (section.sound ? "" : "  (NOT SOUND)") + "\n" +
                     section.summary + "\n";
  std::size_t width = 0, about = 0;
  for (const Value& value : section.values) {
    width = std::max(width, letters(value.name));
    about = std::max(about, letters(value.about));
  }
  for (const Value& value : section.values) {
    text += "  " + padded(value.name, width, false) + padded(short_number(value.median), 12, true);
    text += value.spread == 0.0 ? padded("", 14, false)
                                : padded("  iqr " + short_number(value.spread), 14, false);
    text += "  " + value.about + "\n";
  }
  for (const Table& table : section.tables) text += text_of(table);
  return text;
}

}  // namespace clay::bench
